#include "dem/cluster.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "dem/contact_step.hpp"
#include "dem/first_touch.hpp"
#include "dem/free_flight.hpp"
#include "dem/ticks.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;
constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::int64_t most_steps = 50'000'000;  // something must be wrong
constexpr double longest_way_near_walls = 0.2;   // in radii, between two looks

/// Every touch, when all levels meet: `h` [s] after they met last (0: the present state is asked for), at `time`;
/// the last tick was `tick`. Completes the sub-steps of all, and renews what is kept for the whole cluster. Returns
/// whether anything touches.
bool evaluate_all(double h, double tick, double time, double horizon, const Rules& rules, Cluster& cluster) {
  cluster.fastest = 0.0;
  for (Body& body : cluster.bodies) {
    cluster.fastest = std::max(cluster.fastest, body.v.squaredNorm());
    body.contact_step = never;
    body.kick = body.twist = Vector3d::Zero();
    if (body.fixed) continue;
    if (h == 0.0) continue;
    body.kick = 0.5 * tick * body.push;
    body.twist = 0.5 * tick * body.turn;
  }
  cluster.fastest = std::sqrt(cluster.fastest);
  if (h > 0.0)
    for (Touch& touch : cluster.touches) foresee(touch, cluster);
  bool live = false;
  for (std::size_t i = 0; i < cluster.touches.size(); ++i) {
    Touch& touch = cluster.touches[i];
    const bool was_live = touch.live();
    touch.elapsed = h == 0.0 ? 0.0 : was_live ? touch.planned : std::min(h, time - touch.looked_at);
    look_at(i, touch.elapsed, time, horizon, rules, cluster);
    live = live || touch.live();
  }
  cluster.looks += static_cast<std::int64_t>(cluster.touches.size());
  for (Body& body : cluster.bodies) body.force = body.torque = Vector3d::Zero();
  for (const Touch& touch : cluster.touches) {
    if (!touch.live()) continue;
    Body& a = cluster.bodies[touch.a];
    a.force += touch.memory.force, a.torque += touch.torque_a;
    if (touch.b < 0) continue;
    Body& b = cluster.bodies[touch.b];
    b.force -= touch.memory.force, b.torque += touch.torque_b;
  }
  for (Body& body : cluster.bodies) {
    if (body.sleeper) {
      const Vector3d change = body.imbalance + body.force;
      if (change.squaredNorm() > body.limit * body.limit) body.disturbed = cluster.disturbed = true;
    }
    if (body.fixed) continue;
    body.drag_force = body.load.drag * (body.load.air_velocity - body.v - body.kick);
    body.acceleration = (body.force + body.drag_force + body.steady) * body.inverse_mass;
    body.kick = body.twist = Vector3d::Zero();
    body.push = body.inverse_mass * (body.drag_force + body.steady);
    body.turn = body.inverse_inertia * body.load.torque;
    if (h == 0.0) continue;
    body.v += 0.5 * tick * body.push;
    body.w += 0.5 * tick * body.turn;
    body.drag_impulse += 0.5 * tick * body.drag_force;
  }
  if (h > 0.0)
    for (const Touch& touch : cluster.touches) kick(0.5 * touch.elapsed, touch, cluster);
  return live;
}

/// All bodies in free flight for h.
void fly(double h, Cluster& cluster) {
  for (Body& body : cluster.bodies) {
    if (body.fixed) continue;
    const double inertia = body.inverse_inertia > 0.0 ? 1.0 / body.inverse_inertia : never;
    const Flight end = free_flight(body.x, body.v, body.w, body.mass, inertia, body.load, body.steady, h);
    body.x = end.position, body.v = end.velocity, body.w = end.spin;
    body.drag_impulse += end.drag_impulse;
    body.kick = body.twist = Vector3d::Zero();
  }
}

/// Time until the first touch of anything, at most `horizon`, while nothing is live.
double time_of_flight(double horizon, const Cluster& cluster) {
  double first = horizon;
  for (const Touch& touch : cluster.touches) {
    if (touch.lost) continue;
    const Body& a = cluster.bodies[touch.a];
    if (touch.b >= 0) {
      const Body& b = cluster.bodies[touch.b];
      first = std::min(first, first_touch(a.x - b.x, a.v - b.v, a.acceleration - b.acceleration, touch.reach, first));
    } else {
      const Vector3d& n = touch.plane.normal;
      first = std::min(first, first_zero(touch.plane.gap(a.x, a.radius), n.dot(a.v), n.dot(a.acceleration), first));
    }
  }
  return first;
}

/// Largest time that no body may exceed without looking at the walls again.
double time_to_look(double horizon, const Cluster& cluster) {
  double time = horizon;
  for (std::size_t i = 0; i < cluster.bodies.size(); ++i) {
    const Body& body = cluster.bodies[i];
    if (body.fixed) continue;
    const WallCache& cache = cluster.walls[i];
    const double speed = body.v.norm();
    double way = cache.clear - body.radius - (body.x - cache.asked_at).norm();
    if (!cache.planes.empty()) way = std::min(way, longest_way_near_walls * body.radius);
    way = std::max(way, 0.01 * body.radius);
    if (speed * time > way) time = way / speed;
  }
  return time;
}

void look_again(double time, double remaining, const Rules& rules, const Walls& walls, Cluster& cluster) {
  for (std::size_t i = 0; i < cluster.bodies.size(); ++i) {
    Body& body = cluster.bodies[i];
    if (body.fixed) continue;
    WallCache& cache = cluster.walls[i];
    double radius = cache.clear - body.radius;
    if (!cache.planes.empty()) radius = std::min(radius, cache.trust);
    if ((body.x - cache.asked_at).squaredNorm() <= radius * std::abs(radius)) continue;
    look_at_walls(walls, body.x, body.radius, body.v.norm() * remaining, cluster.scratch, cache);
    match_walls(static_cast<std::int32_t>(i), time, rules, cluster);
  }
}

void note_deviations(double elapsed, Cluster& cluster) {
  for (Body& body : cluster.bodies) {
    if (body.fixed && !body.stuck) continue;
    const double d2 = (body.x - body.start - elapsed * body.course).squaredNorm();
    if (d2 > body.deviation * body.deviation) body.deviation = std::sqrt(d2);
  }
}

}  // namespace

void Cluster::clear() {
  bodies.clear(), touches.clear(), begun.clear(), ended.clear();
  body_steps = looks = looks_saved = 0;
  beside_begin.clear();
  largest_overlap = 0.0;
  disturbed = false;
}

void integrate(double time, double duration, const Rules& rules, const Walls& walls, Cluster& cluster) {
  const std::int64_t moving =
      std::count_if(cluster.bodies.begin(), cluster.bodies.end(), [](const Body& body) { return !body.fixed; });
  double elapsed = 0.0;
  bool live = evaluate_all(0.0, 0.0, time, duration, rules, cluster);
  std::int64_t taken = 0;
  while (elapsed < duration && !cluster.disturbed) {
    const double remaining = duration - elapsed;
    double h, tick = 0.0;
    if (!live) {
      h = time_of_flight(time_to_look(remaining, cluster), cluster);
      fly(h, cluster);
      ++taken;
    } else {
      const double least = shortest_step(remaining, cluster);
      const double look = time_to_look(longest_meeting(std::min(remaining, most_ticks * least), cluster), cluster);
      Ticks ticks = plan(std::min(least, look), remaining, look, cluster);
      h = ticks.last == ticks.count ? remaining : ticks.last * ticks.length;
      run_levels(time + elapsed, remaining, rules, ticks, cluster);
      tick = ticks.length;
      taken += ticks.last;
      cluster.body_steps += moving * (ticks.last - 1);
      cluster.looks_saved += static_cast<std::int64_t>(cluster.touches.size()) * (ticks.last - 1);
    }
    if (taken > most_steps)
      throw std::runtime_error("dem: more than " + std::to_string(most_steps) + " sub-steps in one step of " +
                               std::to_string(duration) + " s, with carrier " + std::to_string(cluster.bodies[0].id) +
                               "; give shorter steps or a larger max_overlap");
    elapsed = h == remaining ? duration : elapsed + h;
    look_again(time + elapsed, duration - elapsed, rules, walls, cluster);
    live = evaluate_all(live ? h : 0.0, tick, time + elapsed, std::max(duration - elapsed, h), rules, cluster);
    note_deviations(elapsed, cluster);
    cluster.body_steps += moving;
  }
  for (const Touch& touch : cluster.touches)
    if (touch.live()) note_overlap(touch, cluster);
}

}  // namespace puffin::dem
