#include "dem/gather.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "dem/chains.hpp"
#include "dem/first_touch.hpp"
#include "dem/meeting.hpp"
#include "dem/parts.hpp"
#include "dem/placed_contact.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;
constexpr std::size_t carriers_a_part = 512;  // shared among threads
// A neighbour list should serve this many steps at the present speeds: as many as leave a carrier `most_neighbours`,
// beyond which looking at them in every step costs more than a new list. The last leaves room for a second try.
constexpr double steps_of_budget[] = {8.0, 4.0, 2.0, 1.1};
constexpr double most_neighbours = 100.0;

bool moves(const State& state, std::int32_t i) { return state.carriers.rest[i] == Rest::awake; }

/// Nearest approach of two centres on straight courses within the step, less the sum of radii [m].
double course_gap(double duration, const Carriers& all, std::int32_t i, std::int32_t j) {
  const Vector3d p = all.position[i] - all.position[j], w = all.velocity[i] - all.velocity[j];
  const double pw = p.dot(w), w2 = w.squaredNorm();
  const double time = pw < 0.0 ? std::min(duration, -pw / w2) : 0.0;
  return (p + time * w).norm() - all.radius[i] - all.radius[j];
}

/// True if a wall may be touched within the step.
bool may_touch_wall(double duration, const Vector3d& x, const Vector3d& v, const Vector3d& a, double radius,
                    double margin, const WallCache& cache) {
  const double way = v.norm() * duration;
  for (const WallPlane& plane : cache.planes) {
    const double gap = plane.gap(x, radius) - margin;
    if (gap <= placed_gap && v.isZero(0.0)) return true;  // placed there: it may hang
    if (gap < 0.0 || first_zero(gap, plane.normal.dot(v), plane.normal.dot(a), duration) <= duration) return true;
    if (way > largest_trust * radius && gap < way) return true;
  }
  return false;
}

std::int32_t root(std::vector<std::int32_t>& parent, std::int32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

void unite(std::vector<std::int32_t>& parent, std::int32_t i, std::int32_t j) {
  i = root(parent, i), j = root(parent, j);
  if (i != j) parent[std::max(i, j)] = std::min(i, j);
}

/// Pairs whose straight courses, widened by the margins, come together.
void find_pairs(double duration, const State& state, Gathering& g) {
  const Carriers& all = state.carriers;
  const Neighbours& near = state.neighbours;
  const std::size_t parts = (g.awake.size() + carriers_a_part - 1) / carriers_a_part;
  if (g.part_pairs.size() < parts) g.part_pairs.resize(parts);
  in_parts(g.awake.size(), carriers_a_part, [&](std::size_t part, std::size_t first, std::size_t last) {
    auto& pairs = g.part_pairs[part];
    pairs.clear();
    for (std::size_t k = first; k < last; ++k) {
      const std::int32_t i = g.awake[k];
      const Vector3d x = all.position[i], v = all.velocity[i];
      for (std::int32_t e = near.begin[i]; e < near.begin[i + 1]; ++e) {
        const std::int32_t j = near.list[e];
        const bool free = moves(state, j);
        if (free && j < i) continue;
        const double margin = g.margin[i] + (free ? g.margin[j] : 0.0);
        const Vector3d p = x - all.position[j], w = v - all.velocity[j];
        const double reach = all.radius[i] + all.radius[j] + margin;
        const double p2 = p.squaredNorm(), pw = p.dot(w), w2 = w.squaredNorm();
        if (w2 == 0.0) {  // placed there: they may hang
          if (p2 > (reach + placed_gap) * (reach + placed_gap)) continue;
        } else if (p2 > reach * reach) {
          if (pw >= 0.0) continue;
          const double time = std::min(duration, -pw / w2);
          if (p2 + time * (2.0 * pw + time * w2) > reach * reach) continue;
        }
        pairs.push_back({i, j});
      }
    }
  });
  g.pairs.clear();
  for (std::size_t p = 0; p < parts; ++p) g.pairs.insert(g.pairs.end(), g.part_pairs[p].begin(), g.part_pairs[p].end());
}

/// What contacts of this step may do to the courses: widens the margins of the carriers that will meet something.
bool widen_margins(double duration, const Rules& rules, const State& state, Gathering& g) {
  const Carriers& all = state.carriers;
  const double e = 1.0 + rules.carrier.restitution + rules.carrier.largest_friction();
  g.blows.resize(g.pairs.size());
  in_parts(g.pairs.size(), 4 * carriers_a_part, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const auto [i, j] = g.pairs[k];
      const Vector3d p = all.position[i] - all.position[j], w = all.velocity[i] - all.velocity[j];
      const double reach = all.radius[i] + all.radius[j];
      const double time = std::max(0.0, first_touch(p, w, Vector3d::Zero(), reach, duration));
      g.blows[k] = 0.0;
      if (!(time <= duration)) continue;
      const Vector3d q = p + time * w;
      g.blows[k] = std::max(0.0, e * std::max(0.0, -q.dot(w) / q.norm()) * (duration - time));
    }
  });
  bool widened = false;
  for (std::size_t k = 0; k < g.pairs.size(); ++k) {
    if (g.blows[k] == 0.0) continue;
    const auto [i, j] = g.pairs[k];
    const bool free = moves(state, j);
    const double share = free ? all.mass[j] / (all.mass[i] + all.mass[j]) : 1.0;
    g.margin[i] += share * g.blows[k];
    if (free) g.margin[j] += (1.0 - share) * g.blows[k];
    widened = true;
  }
  std::atomic<bool> by_contacts = false;
  in_parts(g.awake.size(), carriers_a_part, [&](std::size_t, std::size_t first, std::size_t last) {
    bool some = false;
    for (std::size_t k = first; k < last; ++k) {
      const std::int32_t i = g.awake[k];
      for_each_contact(state, i, [&](std::int32_t place) {
        const Contact& c = state.contacts[place];
        const Vector3d w = c.b >= 0 ? Vector3d(all.velocity[c.a] - all.velocity[c.b]) : all.velocity[c.a];
        g.margin[i] += (w.norm() + std::abs(c.normal_force) / std::sqrt(c.stiffness * all.mass[i])) * duration;
        some = true;
      });
    }
    if (some) by_contacts = true;
  });
  return widened || by_contacts;
}

}  // namespace

void predict(double duration, const Rules& rules, const Walls& walls, std::span<const Load> loads, State& state,
             Gathering& g) {
  const Carriers& all = state.carriers;
  const std::size_t n = all.size();
  g.awake.clear();
  for (std::size_t i = 0; i < n; ++i)
    if (all.rest[i] == Rest::awake) g.awake.push_back(static_cast<std::int32_t>(i));
  g.acceleration.resize(n), g.margin.resize(n), g.at_wall.resize(n);
  g.parent.resize(n), g.cluster_of.resize(n), g.local_of.resize(n);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, g.awake.size(), 128), [&](const auto& range) {
    thread_local std::vector<WallTouch> touches;
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const std::int32_t i = g.awake[k];
      const Load& load = loads[i];
      g.acceleration[i] =
          rules.gravity + (load.drag * (load.air_velocity - all.velocity[i]) + load.force) / all.mass[i];
      const double bend = 0.5 * g.acceleration[i].norm() * duration * duration;
      g.margin[i] = bend;
      const double travel = all.velocity[i].norm() * duration + bend;
      look_at_walls(walls, all.position[i], all.radius[i], travel, touches, state.walls[i]);
      g.at_wall[i] = may_touch_wall(duration, all.position[i], all.velocity[i], g.acceleration[i], all.radius[i], 0.0,
                                    state.walls[i]);
    }
  });
}

bool neighbours_suffice(double duration, const State& state, const Gathering& g) {
  const Neighbours& near = state.neighbours;
  if (!near.valid) return false;
  for (const std::int32_t i : g.awake) {
    const double left = near.budget[i] - state.carriers.velocity[i].norm() * duration - g.margin[i];
    if (left < 0.0 || (state.carriers.position[i] - near.built_at[i]).squaredNorm() > left * left) return false;
  }
  return true;
}

void renew_neighbours(double duration, const Rules& rules, const Gathering& g, State& state) {
  const Carriers& all = state.carriers;
  double diameter = 0.0;
  for (const double r : all.radius) diameter += 2.0 * r / static_cast<double>(all.size());
  std::vector<double>& budget = state.neighbours.budget;
  for (const double steps : steps_of_budget) {
    budget.assign(all.size(), 0.5 * rules.integration.skin * diameter);
    for (const std::int32_t i : g.awake) budget[i] += steps * (all.velocity[i].norm() * duration + g.margin[i]);
    if (expected_neighbours(all, budget, g.awake) <= most_neighbours) break;
  }
  build(all, state.neighbours);
  ++state.statistics.rebuilds;
}

void give_back(Gathering& g) {
  constexpr std::size_t few = 16, several = 8;
  for (std::size_t c = 0; c < g.clusters.size(); ++c) {
    const std::size_t members = c < g.used ? static_cast<std::size_t>(g.member_begin[c + 1] - g.member_begin[c]) : 0;
    if (g.clusters[c].bodies.capacity() > std::max(few, several * members)) g.clusters[c] = Cluster{};
  }
}

void find_clusters(double duration, const Rules& rules, const State& state, Gathering& g) {
  find_pairs(duration, state, g);
  if (widen_margins(duration, rules, state, g)) {
    find_pairs(duration, state, g);
    const Carriers& all = state.carriers;
    for (const std::int32_t i : g.awake)
      if (!g.at_wall[i])
        g.at_wall[i] = may_touch_wall(duration, all.position[i], all.velocity[i], g.acceleration[i], all.radius[i],
                                      g.margin[i], state.walls[i]);
  }
  // Unite.
  std::vector<std::uint8_t>& busy = g.at_wall;
  for (const std::int32_t i : g.awake) {
    g.parent[i] = i;
    if (state.first_contact[i] >= 0 || !rules.integration.free_flight) busy[i] = 1;
  }
  for (const auto& [i, j] : g.pairs) {
    busy[i] = 1;
    if (moves(state, j)) busy[j] = 1, unite(g.parent, i, j);
  }
  for (const std::int32_t i : g.awake)
    for_each_contact(state, i, [&](std::int32_t place) {
      const Contact& c = state.contacts[place];
      if (c.b >= 0 && moves(state, c.a) && moves(state, c.b)) unite(g.parent, c.a, c.b);
    });
  // Number the clusters in the order of their first member; sort members and pairs into them.
  g.member_begin.assign(1, 0);
  g.used = 0;
  for (const std::int32_t i : g.awake) {
    g.cluster_of[i] = -1;
    if (!busy[i]) continue;
    const std::int32_t r = root(g.parent, i);
    g.cluster_of[i] = r == i ? static_cast<std::int32_t>(g.used++) : g.cluster_of[r];
    if (r == i) g.member_begin.push_back(0);
    g.local_of[i] = g.member_begin[g.cluster_of[i] + 1]++;
  }
  for (std::size_t c = 0; c < g.used; ++c) g.member_begin[c + 1] += g.member_begin[c];
  g.members.resize(g.member_begin[g.used]);
  for (const std::int32_t i : g.awake)
    if (g.cluster_of[i] >= 0) g.members[g.member_begin[g.cluster_of[i]] + g.local_of[i]] = i;
  g.pair_begin.assign(g.used + 1, 0);
  for (const auto& [i, j] : g.pairs) ++g.pair_begin[g.cluster_of[i] + 1];
  for (std::size_t c = 0; c < g.used; ++c) g.pair_begin[c + 1] += g.pair_begin[c];
  g.pair_order.resize(g.pairs.size());
  std::vector<std::int32_t> next(g.pair_begin.begin(), g.pair_begin.end() - 1);
  for (std::size_t p = 0; p < g.pairs.size(); ++p)
    g.pair_order[next[g.cluster_of[g.pairs[p][0]]]++] = static_cast<std::int32_t>(p);
  if (g.clusters.size() < g.used) g.clusters.resize(g.used);
  give_back(g);
}

bool guess_held(double duration, State& state, Gathering& g) {
  const Carriers& all = state.carriers;
  bool held = true;
  std::vector<std::int32_t> loose;
  for (std::size_t c = 0; c < g.used; ++c) {
    Cluster& cluster = g.clusters[c];
    for (std::size_t b = 0; b < cluster.bodies.size(); ++b) {
      const BodyRecord& record = cluster.records[b];
      const std::int32_t i = record.carrier;
      if (record.sleeper && record.disturbed) {
        wake(i, state);
        held = false;
      }
      if (cluster.disturbed || (record.fixed && !record.stuck)) continue;
      if (record.deviation2 > g.margin[i] * g.margin[i]) {
        loose.push_back(i);
        g.margin[i] = std::sqrt(record.deviation2);
      }
      const double budget = state.neighbours.budget[i];
      if ((vec(cluster.bodies[b].x) - state.neighbours.built_at[i]).squaredNorm() > budget * budget)
        state.neighbours.valid = false, held = false;
    }
  }
  if (!held) return false;
  const auto listed = [&](std::int32_t i, std::int32_t j) {
    const std::array<std::int32_t, 2> pair = moves(state, j)
                                                 ? std::array<std::int32_t, 2>{std::min(i, j), std::max(i, j)}
                                                 : std::array<std::int32_t, 2>{i, j};
    return std::binary_search(g.pairs.begin(), g.pairs.end(), pair);
  };
  for (const std::int32_t i : loose) {
    for (std::int32_t e = state.neighbours.begin[i]; e < state.neighbours.begin[i + 1]; ++e) {
      const std::int32_t j = state.neighbours.list[e];
      const double margin = g.margin[i] + (moves(state, j) ? g.margin[j] : 0.0);
      if (course_gap(duration, all, i, j) < margin && !listed(i, j)) held = false;
    }
  }
  return held;
}

}  // namespace puffin::dem
