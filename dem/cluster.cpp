#include "dem/cluster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "dem/adhesion_spread.hpp"
#include "dem/contact_step.hpp"
#include "dem/first_touch.hpp"
#include "dem/free_flight.hpp"
#include "dem/friction.hpp"
#include "dem/linear_contact.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;
constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::int64_t most_steps = 50'000'000;  // something must be wrong
constexpr double longest_way_near_walls = 0.2;   // in radii, between two looks
constexpr double rayleigh_part = 0.2;            // of the Rayleigh time: the longest sub-step of a Hertz contact

/// Contact forces of all touches, then the accelerations; returns the largest next sub-step. `live`: something touches.
double evaluate_all(double h, double time, double horizon, const Rules& rules, Cluster& cluster, bool& live) {
  for (Body& body : cluster.bodies) body.force = body.torque = Vector3d::Zero();
  live = false;
  cluster.fastest = 0.0;
  for (const Body& body : cluster.bodies) cluster.fastest = std::max(cluster.fastest, body.v.squaredNorm());
  cluster.fastest = std::sqrt(cluster.fastest);
  double step = horizon;
  for (std::size_t i = 0; i < cluster.touches.size(); ++i)
    step = std::min(step, evaluate(i, h, time, step, rules, cluster, live));
  for (Body& body : cluster.bodies) {
    if (body.sleeper) {
      const Vector3d change = body.imbalance + body.force;
      if (change.squaredNorm() > body.limit * body.limit) body.disturbed = cluster.disturbed = true;
    }
    if (body.fixed) continue;
    body.drag_force = body.load.drag * (body.load.air_velocity - body.v - body.kick);
    body.acceleration = (body.force + body.drag_force + body.steady) * body.inverse_mass;
    body.turning = (body.torque + body.load.torque) * body.inverse_inertia;
    if (body.load.drag > 0.0) step = std::min(step, 0.1 / (body.load.drag * body.inverse_mass));
  }
  return step;
}

/// Sub-step h: opening half kick and drift. The closing half kick follows the forces.
void kick_and_drift(double h, Cluster& cluster) {
  for (Body& body : cluster.bodies) {
    if (body.fixed) continue;
    body.kick = 0.5 * h * body.acceleration;
    body.twist = 0.5 * h * body.turning;
    body.v += body.kick;
    body.w += body.twist;
    body.drag_impulse += 0.5 * h * body.drag_force;
    body.x += h * body.v;
  }
}

void closing_kick(double h, Cluster& cluster) {
  for (Body& body : cluster.bodies) {
    if (body.fixed) continue;
    body.v += 0.5 * h * body.acceleration;
    body.w += 0.5 * h * body.turning;
    body.drag_impulse += 0.5 * h * body.drag_force;
    body.kick = body.twist = Vector3d::Zero();
  }
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
  body_steps = 0;
  largest_overlap = 0.0;
  disturbed = false;
}

Touch& add_touch(std::int32_t a, std::int32_t b, const Rules& rules, Cluster& cluster) {
  Touch& touch = cluster.touches.emplace_back();
  touch.a = a, touch.b = b;
  const Body& first = cluster.bodies[a];
  if (b >= 0) {
    const Body& second = cluster.bodies[b];
    const Spread& spread = rules.carrier.spread;
    const double strength = std::sqrt(adhesion_factor(spread.seed, first.id, spread.sigma) *
                                      adhesion_factor(spread.seed, second.id, spread.sigma));
    touch.pair = pair_law(rules.carrier, first.radius, first.single_radius, second.radius, second.single_radius,
                          1.0 / (first.inverse_mass + second.inverse_mass), strength);
    if (rules.carrier.hertz)
      touch.pair.longest_step = rayleigh_part * rules.carrier.rayleigh *
                                std::sqrt(std::min(first.mass / first.radius, second.mass / second.radius));
    touch.reach = first.radius + second.radius;
  } else {
    const Spread& spread = rules.wall.spread;
    touch.pair = pair_law(rules.wall, first.radius, first.single_radius, never, never, first.mass,
                          adhesion_factor(spread.seed, first.id, spread.sigma));
    if (rules.wall.hertz)
      touch.pair.longest_step = rayleigh_part * rules.wall.rayleigh * std::sqrt(first.mass / first.radius);
    touch.reach = first.radius;
    touch.next_wall = cluster.bodies[a].first_wall;
    cluster.bodies[a].first_wall = static_cast<std::int32_t>(cluster.touches.size()) - 1;
  }
  return touch;
}

void set_dashpots(const Rules& rules, Touch& touch) {
  const SurfaceLaw& law = touch.b >= 0 ? rules.carrier : rules.wall;
  const double k = touch.memory.stiffness, mass = touch.pair.mass;
  touch.eta = 2.0 * law.zeta * std::sqrt(mass * k);
  touch.eta_pull = 2.0 * law.zeta * std::sqrt(mass * touch.pair.pull_stiffness);
  if (!law.hertz) touch.memory.slip_stiffness = law.tangential_ratio * k;
  touch.eta_slip = slip_dashpot(law, rules.rotation, mass, touch.memory.slip_stiffness);
}

void match_walls(std::int32_t b, double time, const Rules& rules, Cluster& cluster) {
  constexpr double same_side = 0.8;  // cosine: the normal of one place turns by less between two looks
  const std::vector<WallPlane>& planes = cluster.walls[b].planes;
  const std::int32_t old = cluster.bodies[b].first_wall;
  if (planes.empty() && old < 0) return;
  std::uint64_t taken = 0;  // bits in the order of the chain
  for (const WallPlane& plane : planes) {
    std::int32_t best = -1;
    int best_bit = 0, bit = 0;
    double nearest = same_side;
    for (std::int32_t i = old; i >= 0; i = cluster.touches[i].next_wall, ++bit) {
      const Touch& touch = cluster.touches[i];
      if (touch.lost || bit > 63 || (taken >> bit & 1)) continue;
      const bool live = touch.memory.phase != ContactPhase::free;
      const double cosine = plane.normal.dot(live ? touch.memory.normal : touch.plane.normal);
      if (cosine > nearest) nearest = cosine, best = i, best_bit = bit;
    }
    if (best >= 0) {
      taken |= std::uint64_t{1} << best_bit;
      cluster.touches[best].plane = plane;
      cluster.touches[best].idle_until = 0.0;
    } else {
      add_touch(b, -1, rules, cluster).plane = plane;
    }
  }
  int bit = 0;
  for (std::int32_t i = old; i >= 0; i = cluster.touches[i].next_wall, ++bit) {
    Touch& touch = cluster.touches[i];
    if (touch.lost || (bit <= 63 && (taken >> bit & 1))) continue;
    if (touch.memory.phase != ContactPhase::free) end_contact(time, cluster, touch);
    touch.lost = true;
  }
}

void integrate(double time, double duration, const Rules& rules, const Walls& walls, Cluster& cluster) {
  bool live = false;
  const std::int64_t moving =
      std::count_if(cluster.bodies.begin(), cluster.bodies.end(), [](const Body& body) { return !body.fixed; });
  double elapsed = 0.0;
  double step = evaluate_all(0.0, time, duration, rules, cluster, live);
  std::int64_t taken = 0;
  while (elapsed < duration && !cluster.disturbed) {
    if (++taken > most_steps)
      throw std::runtime_error("dem: more than " + std::to_string(most_steps) + " sub-steps in one step of " +
                               std::to_string(duration) + " s, with carrier " + std::to_string(cluster.bodies[0].id) +
                               "; give shorter steps or a larger max_overlap");
    const double remaining = duration - elapsed;
    double h = time_to_look(std::min(step, remaining), cluster);
    if (!live) {
      h = time_of_flight(time_to_look(remaining, cluster), cluster);
      fly(h, cluster);
    } else {
      h = remaining / std::ceil(remaining / h * (1.0 - 1e-12));
      kick_and_drift(h, cluster);
    }
    elapsed = h == remaining ? duration : elapsed + h;
    look_again(time + elapsed, duration - elapsed, rules, walls, cluster);
    const bool flew = !live;
    step = evaluate_all(flew ? 0.0 : h, time + elapsed, std::max(duration - elapsed, h), rules, cluster, live);
    if (!flew) closing_kick(h, cluster);
    note_deviations(elapsed, cluster);
    cluster.body_steps += moving;
  }
  for (const Touch& touch : cluster.touches)
    if (touch.memory.phase != ContactPhase::free) note_overlap(touch, cluster);
}

}  // namespace puffin::dem
