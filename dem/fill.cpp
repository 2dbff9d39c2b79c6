// Copies one cluster out of the state.

#include <algorithm>

#include "dem/chains.hpp"
#include "dem/gather.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;

Body body_of(std::int32_t i, const Rules& rules, const Load& load, const State& state) {
  const Carriers& all = state.carriers;
  Body body;
  body.carrier = i, body.id = all.id[i];
  body.fixed = all.rest[i] != Rest::awake;
  body.sleeper = all.rest[i] == Rest::asleep;
  body.radius = all.radius[i], body.single_radius = all.single_radius[i];
  body.mass = all.mass[i], body.single_mass = all.single_mass(i);
  if (!body.fixed) {
    body.inverse_mass = 1.0 / body.mass;
    if (rules.rotation) body.inverse_inertia = 1.0 / (0.4 * body.mass * body.radius * body.radius);
  }
  body.x = body.start = all.position[i];
  body.v = body.course = body.fixed ? Vector3d(Vector3d::Zero()) : all.velocity[i];
  body.w = body.fixed ? Vector3d(Vector3d::Zero()) : all.spin[i];
  body.kick = body.twist = body.turning = body.drag_impulse = body.imbalance = Vector3d::Zero();
  body.force = body.torque = Vector3d::Zero();
  body.load = load;
  body.steady = load.force + body.mass * rules.gravity;
  body.drag_force = load.drag * (load.air_velocity - body.v);
  body.load_size = body.steady.norm() + body.drag_force.norm();
  body.acceleration = (body.drag_force + body.steady) * body.inverse_mass;
  if (body.sleeper) {
    const RestMemory& rest = state.rest[i];
    body.imbalance = body.steady + body.drag_force - rest.load + contact_force(state, i) - rest.contact_force;
    body.limit = rules.integration.wake_change * rest.hold;
  }
  return body;
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
    cluster.bodies.push_back(body_of(*m, rules, loads[*m], state));
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
      cluster.bodies.push_back(body_of(i, rules, loads[i], state));
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
      Touch& touch = add_touch(body(c.a), b, rules, cluster);
      touch.place = place;
      touch.memory = c;
      set_dashpots(rules, touch);
      for (const std::int32_t side : {touch.a, touch.b})
        if (side >= 0 && cluster.bodies[side].sleeper)
          cluster.bodies[side].imbalance -= side == touch.a ? c.force : Vector3d(-c.force);
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
  for (std::int32_t b = 0; b < last - first; ++b) match_walls(b, time, rules, cluster);
  for (const std::int32_t i : fixed) local[i] = -1;
}

}  // namespace puffin::dem
