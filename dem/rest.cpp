#include "dem/rest.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "dem/meeting.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;
constexpr double still_force = 0.05;  // of what holds
constexpr double still_way = 1e-6;    // in radii
// Without rolling resistance a sphere on fewer than three places rolls off under any load: it sleeps only if almost
// nothing moves it. The drift that is slept through is then a hundredth of wake_change * mu * (F_n + F0) / m.
constexpr double free_rolling = 0.01;

/// What holds one body, over its contacts.
struct Grip {
  double hold = std::numeric_limits<double>::infinity();  // [N]
  double use = 0.0;
  int contacts = 0;
};

}  // namespace

void wake_by_load(const Rules& rules, std::span<const Load> loads, State& state) {
  const Carriers& all = state.carriers;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all.rest[i] != Rest::asleep) continue;
    const RestMemory& rest = state.rest[i];
    const Load& load = loads[i];
    const double limit = rules.integration.wake_change * rest.hold;
    const Vector3d change =
        load.drag * load.air_velocity + load.force + all.mass[i] * rules.gravity - rest.load + rest.contact_change;
    const double twist = limit * all.radius[i];
    if (change.squaredNorm() > limit * limit || (load.torque - rest.torque).squaredNorm() > twist * twist)
      wake(i, state);
  }
}

void settle(const Rules& rules, const Cluster& cluster, State& state) {
  if (!rules.integration.sleep) return;
  thread_local std::vector<Grip> grips;
  grips.assign(cluster.bodies.size(), Grip{});
  for (const Touch& touch : cluster.touches) {
    if (touch.memory.phase == ContactPhase::free) continue;
    for (const std::int32_t side : {touch.a, touch.b}) {
      if (side < 0) continue;
      Grip& grip = grips[side];
      grip.hold = std::min(grip.hold, touch.memory.hold);
      grip.use = std::max(grip.use, touch.memory.use);
      ++grip.contacts;
    }
  }
  for (std::size_t b = 0; b < cluster.bodies.size(); ++b) {
    const Body& body = cluster.bodies[b];
    const BodyRecord& record = cluster.records[b];
    RestMemory& rest = state.rest[record.carrier];
    if (record.sleeper) {
      rest.contact_change = record.imbalance + vec(body.force) - (record.steady + record.drag_force - rest.load);
      continue;
    }
    if (record.fixed) continue;
    Grip grip = grips[b];
    const double rolling = std::max(rules.carrier.rolling, rules.wall.rolling);
    if (rules.rotation && grip.contacts < 3) grip.hold *= std::clamp(rolling, free_rolling, 1.0);
    const Vector3d net = vec(body.force) + record.drag_force + record.steady;
    const double energy = 2.0 * still_way * body.radius * grip.hold * body.inverse_mass;  // of stopping, per mass
    const bool still =
        grip.contacts > 0 && grip.hold > 0.0 && grip.use <= rules.integration.sleep_use &&
        net.norm() <= still_force * grip.hold &&
        vec(body.v).squaredNorm() + 0.4 * body.radius * body.radius * vec(body.w).squaredNorm() <= energy;
    rest.steps_at_rest = still ? rest.steps_at_rest + 1 : 0;
    if (rest.steps_at_rest < std::int64_t{rest.patience} * rules.integration.sleep_steps) continue;
    const std::int32_t i = record.carrier;
    state.carriers.rest[i] = Rest::asleep;
    rest.asleep_since = state.statistics.steps;
    state.carriers.velocity[i] = state.carriers.spin[i] = Vector3d::Zero();
    rest.load = record.drag * record.air_velocity + record.steady;
    rest.contact_force = vec(body.force);
    rest.contact_change = Vector3d::Zero();
    rest.torque = record.torque;
    rest.hold = grip.hold;
  }
}

}  // namespace puffin::dem
