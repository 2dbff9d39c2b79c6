#include "dem/advance.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "dem/chains.hpp"
#include "dem/failure.hpp"
#include "dem/free_flight.hpp"
#include "dem/gather.hpp"
#include "dem/meeting.hpp"
#include "dem/parts.hpp"
#include "dem/rest.hpp"

namespace puffin::dem {
namespace {

constexpr std::size_t clusters_unasked = 64;  // between two questions whether to stop

using Eigen::Vector3d;

void refuse(double duration, const Models& models, std::span<const Load> loads, const State& state) {
  if (!(duration > 0.0) || !std::isfinite(duration))
    throw std::invalid_argument("dem: advance() over " + std::to_string(duration) + " s; give a time > 0");
  if (loads.size() != state.carriers.size())
    throw std::invalid_argument("dem: " + std::to_string(loads.size()) + " loads for " +
                                std::to_string(state.carriers.size()) + " carriers; give one load a carrier");
  check(models);
}

/// Carriers outside all clusters.
void fly_freely(double duration, const Rules& rules, std::span<const Load> loads, const Gathering& g, State& state) {
  Carriers& all = state.carriers;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, g.awake.size(), 256), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const std::int32_t i = g.awake[k];
      if (g.cluster_of[i] >= 0) continue;
      const double inertia = 0.4 * all.mass[i] * all.radius[i] * all.radius[i];
      const Flight end = free_flight(all.position[i], all.velocity[i], all.spin[i], all.mass[i], inertia, loads[i],
                                     loads[i].force + all.mass[i] * rules.gravity, duration);
      all.position[i] = end.position;
      all.velocity[i] = end.velocity;
      if (rules.rotation) all.spin[i] = end.spin;
      state.drag_impulse[i] = end.drag_impulse;
      state.rest[i].steps_at_rest = 0;
    }
  });
}

/// Writes a cluster back: carriers, contacts, events.
void commit(const Rules& rules, Cluster& cluster, State& state, Events& events) {
  Carriers& all = state.carriers;
  for (std::size_t b = 0; b < cluster.bodies.size(); ++b) {
    const Body& body = cluster.bodies[b];
    const BodyRecord& record = cluster.records[b];
    if (record.fixed && !record.stuck) continue;
    const std::int32_t i = record.carrier;
    std::swap(state.walls[i], cluster.walls[b]);
    all.position[i] = vec(body.x), all.velocity[i] = vec(body.v), all.spin[i] = vec(body.w);
    state.drag_impulse[i] = record.drag_impulse;
    if (record.stuck) all.rest[i] = Rest::stuck;
  }
  in_parts(cluster.touches.size(), 1024, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const Touch& touch = cluster.touches[t];
      if (touch.place < 0 || !cluster.alive[t]) continue;
      Contact& c = state.contacts[touch.place];
      const std::int32_t next_a = c.next_a, next_b = c.next_b;
      c = touch.memory;
      c.next_a = next_a, c.next_b = next_b;
    }
  });
  for (std::size_t t = 0; t < cluster.touches.size(); ++t) {
    const Touch& touch = cluster.touches[t];
    if (touch.place >= 0 && !cluster.alive[t]) unlink(touch.place, state);
    if (touch.place < 0 && cluster.alive[t]) link(touch.memory, state);
  }
  settle(rules, cluster, state);
  events.begun.insert(events.begun.end(), cluster.begun.begin(), cluster.begun.end());
  events.ended.insert(events.ended.end(), cluster.ended.begin(), cluster.ended.end());
  state.statistics.contact_steps += cluster.body_steps;
  state.statistics.largest_overlap = std::max(state.statistics.largest_overlap, cluster.largest_overlap);
}

/// Before a step too: a search with a place that is no number would look outside its arrays.
void require_finite(std::span<const Load> loads, const State& state) {
  const Carriers& all = state.carriers;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all.rest[i] == Rest::awake &&
        !(all.position[i].allFinite() && all.velocity[i].allFinite() && all.spin[i].allFinite() &&
          loads[i].force.allFinite() && loads[i].air_velocity.allFinite() && std::isfinite(loads[i].drag)))
      throw Failure(all.id[i], "has left the finite numbers at t =", state.time);
}

}  // namespace

void advance(double duration, const Models& models, const Walls& walls, std::span<const Load> loads, State& state,
             Events& events) {
  refuse(duration, models, loads, state);
  const Rules rules(models);
  thread_local Gathering g;  // scratch: kept for its memory alone

  std::fill(state.drag_impulse.begin(), state.drag_impulse.end(), Vector3d::Zero());
  wake_by_load(rules, loads, state);
  require_finite(loads, state);
  predict(duration, rules, walls, loads, state, g);
  for (bool first = true;; first = false) {
    if (!g.awake.empty()) {
      if (!neighbours_suffice(duration, state, g)) renew_neighbours(duration, rules, g, state);
      find_clusters(duration, rules, state, g);
    } else {
      g.used = 0;
    }
    Gathering& gathering = g;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, g.used, 1), [&](const auto& range) {
      for (std::size_t c = range.begin(); c < range.end(); ++c) {
        if (c % clusters_unasked == clusters_unasked - 1 && models.asked_to_stop && models.asked_to_stop())
          throw Interrupted();
        fill(c, state.time, rules, loads, state, gathering);
        integrate(state.time, duration, rules, walls, gathering.clusters[c]);
      }
    });
    state.statistics.clusters += static_cast<std::int64_t>(g.used);
    if (!first) state.statistics.repeated += static_cast<std::int64_t>(g.used);
    const std::int64_t wakes = state.statistics.wakes;
    if (guess_held(duration, state, g)) break;
    if (state.statistics.wakes != wakes) {  // more carriers are awake: predict them too, keeping the wider margins
      const std::vector<double> margins = g.margin;
      const std::vector<std::int32_t> before = g.awake;
      predict(duration, rules, walls, loads, state, g);
      for (const std::int32_t i : before) g.margin[i] = std::max(g.margin[i], margins[i]);
    }
  }
  const std::size_t in_clusters = g.awake.empty() ? 0 : g.members.size();
  if (g.awake.empty()) g.members.clear();
  fly_freely(duration, rules, loads, g, state);
  for (std::size_t c = 0; c < g.used; ++c) commit(rules, g.clusters[c], state, events);
  state.time += duration;
  ++state.statistics.steps;
  state.statistics.free_flights += static_cast<std::int64_t>(g.awake.size() - in_clusters);
  state.statistics.sleeping_steps += static_cast<std::int64_t>(state.carriers.size() - g.awake.size());
  require_finite(loads, state);
}

}  // namespace puffin::dem
