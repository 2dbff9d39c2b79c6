// Copies one cluster out of the state.

#include <algorithm>

#include "dem/chains.hpp"
#include "dem/gather.hpp"
#include "dem/meeting.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;

void add_body(std::int32_t i, const Rules& rules, const Load& load, const State& state, Cluster& cluster) {
  const Carriers& all = state.carriers;
  Body& body = cluster.bodies.emplace_back();
  BodyRecord& record = cluster.records.emplace_back();
  record.carrier = i, record.id = all.id[i];
  record.fixed = all.rest[i] != Rest::awake;
  record.sleeper = all.rest[i] == Rest::asleep;
  body.radius = all.radius[i], record.single_radius = all.single_radius[i];
  record.mass = all.mass[i], record.single_mass = all.single_mass(i);
  body.inverse_mass = body.inverse_inertia = 0.0;
  if (!record.fixed) {
    body.inverse_mass = 1.0 / record.mass;
    if (rules.rotation) body.inverse_inertia = 1.0 / (0.4 * record.mass * body.radius * body.radius);
  }
  vec(body.x) = record.start = all.position[i];
  record.course = record.fixed ? Vector3d(Vector3d::Zero()) : all.velocity[i];
  vec(body.v) = record.course;
  vec(body.w) = record.fixed ? Vector3d(Vector3d::Zero()) : all.spin[i];
  record.turning = record.drag_impulse = record.imbalance = Vector3d::Zero();
  vec(body.kick) = vec(body.twist) = vec(body.force) = vec(body.torque) = Vector3d::Zero();
  record.drag = load.drag, record.air_velocity = load.air_velocity, record.torque = load.torque;
  record.steady = load.force + record.mass * rules.gravity;
  record.drag_force = load.drag * (load.air_velocity - record.course);
  record.load_size = record.steady.norm() + record.drag_force.norm();
  record.acceleration = (record.drag_force + record.steady) * body.inverse_mass;
  if (record.sleeper) {
    const RestMemory& rest = state.rest[i];
    record.imbalance = record.steady + record.drag_force - rest.load + contact_force(state, i) - rest.contact_force;
    record.limit = rules.integration.wake_change * rest.hold;
  }
}

}  // namespace

void fill(std::size_t index, double time, const Rules& rules, std::span<const Load> loads, const State& state,
          Gathering& g) {
  Cluster& cluster = g.clusters[index];
  cluster.clear();
  const std::int32_t *first = g.members.data() + g.member_begin[index],
                     *last = g.members.data() + g.member_begin[index + 1];
  cluster.walls.resize(std::max(cluster.walls.size(), static_cast<std::size_t>(last - first)));
  for (const std::int32_t* m = first; m < last; ++m) {
    cluster.walls[cluster.bodies.size()] = state.walls[*m];
    add_body(*m, rules, loads[*m], state, cluster);
  }

  // Fixed partners follow, each once.
  thread_local std::vector<std::int32_t> local;
  local.resize(std::max(local.size(), state.carriers.size()), -1);
  std::vector<std::int32_t> fixed;
  const auto body = [&](std::int32_t i) {
    if (state.carriers.rest[i] == Rest::awake) return g.local_of[i];
    if (local[i] < 0) {
      local[i] = static_cast<std::int32_t>(cluster.bodies.size());
      fixed.push_back(i);
      add_body(i, rules, loads[i], state, cluster);
    }
    return local[i];
  };

  for (const std::int32_t* m = first; m < last; ++m)
    for_each_contact(state, *m, [&](std::int32_t place) {
      const Contact& c = state.contacts[place];
      const bool awake_a = state.carriers.rest[c.a] == Rest::awake;
      const std::int32_t owner = awake_a ? c.a : c.b;  // the contact of two awake carriers is taken once, by its a
      if (owner != *m) return;
      const std::int32_t b = c.b >= 0 ? body(c.b) : -1;
      const std::int32_t added = add_touch(body(c.a), b, rules, cluster);
      restore_contact(added, c, rules, cluster);
      Touch& touch = cluster.touches[added];
      touch.place = place;
      for (const std::int32_t side : {touch.a, touch.b})
        if (side >= 0 && cluster.records[side].sleeper)
          cluster.records[side].imbalance -= side == touch.a ? c.force : Vector3d(-c.force);
    });
  for (std::int32_t p = g.pair_begin[index]; p < g.pair_begin[index + 1]; ++p) {
    const auto& pair = g.pairs[g.pair_order[p]];
    const std::int32_t i = pair[0], j = pair[1];
    bool live = false;
    for_each_contact(state, i, [&](std::int32_t place) {
      const Contact& c = state.contacts[place];
      live = live || (c.a == i && c.b == j) || (c.a == j && c.b == i);
    });
    if (live) continue;
    const std::int32_t b = body(j);
    add_touch(g.local_of[i], b, rules, cluster);
  }
  list_shares(cluster);
  for (std::int32_t b = 0; b < last - first; ++b) match_walls(b, time, rules, cluster);
  for (const std::int32_t i : fixed) local[i] = -1;
}

}  // namespace puffin::dem
