#include "dem/ticks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "dem/contact_step.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;
constexpr double never = std::numeric_limits<double>::infinity();

/// The highest level whose step is at most `step`.
int level_of(double step, double tick, int highest) {
  const double ratio = step / tick * (1.0 + 1e-9);
  int level = 0;
  while (level < highest && ratio >= 2 << level) ++level;
  return level;
}

void set_level(std::int32_t index, int level, const Ticks& ticks, Cluster& cluster) {
  Touch& touch = cluster.touches[index];
  touch.level = level;
  touch.planned = (1 << level) * ticks.length;
  cluster.due[level].push_back(index);
}

/// Touches of each body, as a list of lists.
void list_touches(Cluster& cluster) {
  std::vector<std::int32_t>&begin = cluster.beside_begin, &list = cluster.beside;
  begin.assign(cluster.bodies.size() + 1, 0);
  for (const Touch& touch : cluster.touches) {
    ++begin[touch.a + 1];
    if (touch.b >= 0) ++begin[touch.b + 1];
  }
  for (std::size_t b = 0; b < cluster.bodies.size(); ++b) begin[b + 1] += begin[b];
  list.resize(begin.back());
  std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < cluster.touches.size(); ++i) {
    list[next[cluster.touches[i].a]++] = static_cast<std::int32_t>(i);
    if (cluster.touches[i].b >= 0) list[next[cluster.touches[i].b]++] = static_cast<std::int32_t>(i);
  }
}

/// A body was hit: the pairs around it must be looked at as often as the new contact.
void warn_others(std::int32_t body, int level, const Ticks& ticks, Cluster& cluster) {
  if (cluster.bodies[body].fixed) return;
  if (cluster.beside_begin.empty() || cluster.beside_of != cluster.touches.size()) {
    list_touches(cluster);
    cluster.beside_of = cluster.touches.size();
  }
  for (std::int32_t n = cluster.beside_begin[body]; n < cluster.beside_begin[body + 1]; ++n) {
    const std::int32_t other = cluster.beside[n];
    const Touch& touch = cluster.touches[other];
    if (touch.live() || touch.lost || touch.level <= level) continue;
    set_level(other, level, ticks, cluster);
  }
}

/// Ticks of half the length.
void halve(int& now, Ticks& ticks, Cluster& cluster) {
  ticks.length *= 0.5, ticks.count *= 2.0;
  now *= 2, ticks.last *= 2, ++ticks.levels;
  cluster.due.resize(std::max<std::size_t>(cluster.due.size(), ticks.levels + 1));
  for (int level = ticks.levels; level > 0; --level) cluster.due[level].swap(cluster.due[level - 1]);
  for (Touch& touch : cluster.touches) ++touch.level;
}

/// Loads for `h`, then a drift of `tick`.
void push_and_drift(double h, double tick, Cluster& cluster) {
  for (Body& body : cluster.bodies) {
    if (body.fixed) continue;
    body.v += h * body.push;
    body.w += h * body.turn;
    body.drag_impulse += h * body.drag_force;
    body.x += tick * body.v;
  }
}

constexpr double kicks_in_stiffest = 4.0;  // longest step of a soft contact, in those of the stiffest on its bodies

/// The step of a touch, with regard to the other contacts of its bodies.
double own_step(const Touch& touch, const Cluster& cluster) {
  if (!touch.live()) return touch.step;
  double stiffest = cluster.bodies[touch.a].contact_step;
  if (touch.b >= 0) stiffest = std::min(stiffest, cluster.bodies[touch.b].contact_step);
  return std::min(touch.step, std::max(kicks_in_stiffest * stiffest, touch.contact_step));
}

}  // namespace

double shortest_step(double longest, const Cluster& cluster) {
  double least = longest;
  for (const Touch& touch : cluster.touches) least = std::min(least, touch.step);
  return least;
}

double longest_meeting(double longest, const Cluster& cluster) {
  double time = longest;
  for (const Body& body : cluster.bodies)
    if (body.load.drag * body.inverse_mass * time > 0.1) time = 0.1 / (body.load.drag * body.inverse_mass);
  return time;
}

Ticks plan(double least, double remaining, double look, Cluster& cluster) {
  Ticks ticks;
  ticks.count = std::max(1.0, std::ceil(remaining / least * (1.0 - 1e-12)));
  ticks.length = remaining / ticks.count;
  double longest = 0.0;  // of the live contacts: if all want the same, there is nothing to gain
  for (const Touch& touch : cluster.touches)
    if (touch.live()) longest = std::max(longest, own_step(touch, cluster));
  const double end = std::min(look, longest * (1.0 + 1e-9));
  while (2 * ticks.last <= most_ticks && 2 * ticks.last <= ticks.count && 2 * ticks.last * ticks.length <= end)
    ticks.last *= 2, ++ticks.levels;
  cluster.due.resize(std::max<std::size_t>(cluster.due.size(), ticks.levels + 1));
  for (auto& list : cluster.due) list.clear();
  for (std::size_t i = 0; i < cluster.touches.size(); ++i)
    if (!cluster.touches[i].lost)
      set_level(static_cast<std::int32_t>(i),
                level_of(own_step(cluster.touches[i], cluster), ticks.length, ticks.levels), ticks, cluster);
  return ticks;
}

void run_levels(double time, double remaining, const Rules& rules, Ticks& ticks, Cluster& cluster) {
  for (const Touch& touch : cluster.touches) kick(0.5 * touch.planned, touch, cluster);
  std::vector<std::int32_t>& due = cluster.due_now;
  double push_time = 0.5 * ticks.length;
  for (int now = 1;; ++now) {
    push_and_drift(push_time, ticks.length, cluster);
    if (now >= ticks.last) return;
    const int highest = std::countr_zero(static_cast<unsigned>(now));
    due.clear();
    for (int level = 0; level <= highest; ++level) {
      for (const std::int32_t i : cluster.due[level])
        if (cluster.touches[i].level == level && !cluster.touches[i].lost) due.push_back(i);
      cluster.due[level].clear();
    }
    const double present = time + now * ticks.length, before = ticks.length;
    for (const std::int32_t i : due)
      for (const std::int32_t side : {cluster.touches[i].a, cluster.touches[i].b}) {
        if (side < 0 || cluster.bodies[side].fixed) continue;
        cluster.bodies[side].kick = 0.5 * before * cluster.bodies[side].push;
        cluster.bodies[side].twist = 0.5 * before * cluster.bodies[side].turn;
      }
    for (const std::int32_t i : due) {
      Touch& touch = cluster.touches[i];
      touch.elapsed = touch.live() ? touch.planned : present - touch.looked_at;
      foresee(touch, cluster);
    }
    for (const std::int32_t i : due)
      look_at(i, cluster.touches[i].elapsed, present, remaining - now * ticks.length, rules, cluster);
    if (cluster.disturbed) return;
    cluster.looks += static_cast<std::int64_t>(due.size());
    cluster.looks_saved -= static_cast<std::int64_t>(due.size());
    for (const std::int32_t i : due) {
      const Touch& touch = cluster.touches[i];
      for (const std::int32_t side : {touch.a, touch.b})
        if (side >= 0) cluster.bodies[side].kick = cluster.bodies[side].twist = Vector3d::Zero();
      kick(0.5 * touch.elapsed, touch, cluster);
    }
    for (const std::int32_t i : due)
      while (cluster.touches[i].step < ticks.length * (1.0 - 1e-6) && ticks.levels < 24) halve(now, ticks, cluster);
    for (const std::int32_t i : due) {
      Touch& touch = cluster.touches[i];
      const int aligned = std::min(ticks.levels, std::countr_zero(static_cast<unsigned>(now)));
      set_level(i, level_of(own_step(touch, cluster), ticks.length, std::min(touch.level, aligned)), ticks, cluster);
      kick(0.5 * touch.planned, touch, cluster);
    }
    for (const std::int32_t i : due) {
      const Touch& touch = cluster.touches[i];
      if (!touch.live() || touch.memory.time_start < present - touch.elapsed) continue;
      for (const std::int32_t side : {touch.a, touch.b})
        if (side >= 0) warn_others(side, touch.level, ticks, cluster);
    }
    push_time = 0.5 * (before + ticks.length);
  }
}

void look_at(std::size_t index, double h, double time, double horizon, const Rules& rules, Cluster& cluster) {
  bool live = false;
  const double step = evaluate(index, h, time, horizon, rules, cluster, live);
  Touch& touch = cluster.touches[index];
  touch.step = step;
  touch.looked_at = time;
  if (!live) return;
  for (const std::int32_t side : {touch.a, touch.b})
    if (side >= 0) cluster.bodies[side].contact_step = std::min(cluster.bodies[side].contact_step, touch.contact_step);
}

void foresee(const Touch& touch, Cluster& cluster) {
  if (!touch.live()) return;
  const double h = 0.5 * touch.planned;
  Body& a = cluster.bodies[touch.a];
  a.kick += (h * a.inverse_mass) * touch.memory.force;
  a.twist += (h * a.inverse_inertia) * touch.torque_a;
  if (touch.b < 0) return;
  Body& b = cluster.bodies[touch.b];
  b.kick -= (h * b.inverse_mass) * touch.memory.force;
  b.twist += (h * b.inverse_inertia) * touch.torque_b;
}

void kick(double h, const Touch& touch, Cluster& cluster) {
  if (!touch.live()) return;
  Body& a = cluster.bodies[touch.a];
  a.v += (h * a.inverse_mass) * touch.memory.force;
  a.w += (h * a.inverse_inertia) * touch.torque_a;
  if (touch.b < 0) return;
  Body& b = cluster.bodies[touch.b];
  b.v -= (h * b.inverse_mass) * touch.memory.force;
  b.w += (h * b.inverse_inertia) * touch.torque_b;
}

}  // namespace puffin::dem
