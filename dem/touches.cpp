// The list of touches of a cluster: how it is filled, and how walls come and go.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/adhesion_spread.hpp"
#include "dem/cluster.hpp"
#include "dem/contact_step.hpp"
#include "dem/first_touch.hpp"
#include "dem/friction.hpp"
#include "dem/meeting.hpp"

namespace puffin::dem {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double rayleigh_part = 0.2;  // of the Rayleigh time: the longest sub-step of a Hertz contact

SpringLaw springs_of(const SurfaceLaw& law, const Rules& rules) {
  SpringLaw s{};
  s.stick = law.stick, s.slip = law.slip, s.limit = law.limit;
  s.slip_speed = law.slip_speed, s.limit_speed = law.limit_speed;
  s.zeta = law.zeta;
  s.rotation = rules.rotation, s.hertz = law.hertz;
  // the tangential spring with its smaller effective mass (2/7 m*) may be the faster one
  double fastest = std::max(1.0, rules.rotation ? 3.5 * law.tangential_ratio : law.tangential_ratio);
  if (law.hertz) fastest *= (1.0 + 2.0 * law.zeta) * (1.0 + 2.0 * law.zeta);  // its dashpot sets in as overlap^(1/4)
  s.step_factor = std::numbers::pi / (std::sqrt(fastest) * rules.integration.steps_per_contact);
  s.quiet_factor = rules.integration.steps_per_contact / 8.0;
  return s;
}

/// What tells a body and a wall from other pairs.
PairNumbers numbers_at_wall(const Body& body, const BodyRecord& record, const Rules& rules) {
  PairNumbers numbers;
  numbers.wall = true;
  numbers.radius_a = body.radius, numbers.single_a = record.single_radius;
  numbers.radius_b = numbers.single_b = never;
  numbers.strength = adhesion_factor(rules.wall.spread.seed, record.id, rules.wall.spread.sigma);
  numbers.inverse_mass = 1.0 / record.mass;
  numbers.lightest = record.mass / body.radius;
  return numbers;
}

/// The last pair's numbers, if they are these too; else new ones.
std::int32_t pair_numbers(const PairNumbers& wanted, const Rules& rules, Cluster& cluster) {
  const std::size_t from = cluster.pairs.size() < 2 ? 0 : cluster.pairs.size() - 2;  // one of carriers, one of the wall
  for (std::size_t i = from; i < cluster.pairs.size(); ++i) {
    const PairNumbers& p = cluster.pairs[i];
    if (p.wall == wanted.wall && p.radius_a == wanted.radius_a && p.radius_b == wanted.radius_b &&
        p.single_a == wanted.single_a && p.single_b == wanted.single_b && p.inverse_mass == wanted.inverse_mass &&
        p.strength == wanted.strength && p.lightest == wanted.lightest)
      return static_cast<std::int32_t>(i);
  }
  PairNumbers& p = cluster.pairs.emplace_back(wanted);
  const SurfaceLaw& law = rules.law(p.wall);
  p.law = pair_law(law, p.radius_a, p.single_a, p.radius_b, p.single_b, 1.0 / p.inverse_mass, p.strength);
  if (law.hertz) p.law.longest_step = rayleigh_part * law.rayleigh * std::sqrt(p.lightest);
  PairConstants& c = cluster.constants.emplace_back();
  c.reach = p.wall ? p.radius_a : p.radius_a + p.radius_b;
  c.share = p.wall ? 1.0 : p.radius_a / c.reach;
  c.inverse_mass = 1.0 / p.law.mass;
  c.knee = law.stiffness > 0.0 ? 5.0 * p.law.allowed : p.law.allowed;  // a given stiffness is left alone longer
  c.pull_off = p.law.pull_off, c.well = p.law.well, c.pull_stiffness = p.law.pull_stiffness;
  c.eta_pull = 2.0 * law.zeta * std::sqrt(p.law.mass * p.law.pull_stiffness);
  c.pull_step = allowed_step(rules.springs(p.wall), p.law, p.law.pull_stiffness);
  return static_cast<std::int32_t>(cluster.pairs.size()) - 1;
}

}  // namespace

Rules::Rules(const Models& models)
    : carrier(models.carrier),
      wall(models.wall),
      gravity(models.gravity),
      rotation(models.rotation),
      on_wall(models.on_wall),
      integration(models.integration),
      asked_to_stop(models.asked_to_stop),
      carrier_springs(springs_of(carrier, *this)),
      wall_springs(springs_of(wall, *this)) {}

void Cluster::clear() {
  bodies.clear(), records.clear(), touches.clear();
  springs.clear(), alive.clear(), pulls.clear(), pairs.clear(), constants.clear();
  begun.clear(), ended.clear();
  body_steps = 0;
  largest_overlap = 0.0;
  disturbed = false;
}

double allowed_step(const SpringLaw& law, const PairLaw& pair, double stiffness) {
  return std::min(law.step_factor * std::sqrt(pair.mass / stiffness), pair.longest_step);
}

std::int32_t add_touch(std::int32_t a, std::int32_t b, const Rules& rules, Cluster& cluster) {
  const auto index = static_cast<std::int32_t>(cluster.touches.size());
  Touch& touch = cluster.touches.emplace_back();
  touch.a = a, touch.b = b;
  const BodyRecord& first = cluster.records[a];
  PairNumbers wanted = numbers_at_wall(cluster.bodies[a], first, rules);
  if (b >= 0) {
    const BodyRecord& second = cluster.records[b];
    const Spread& spread = rules.carrier.spread;
    wanted.wall = false;
    wanted.radius_b = cluster.bodies[b].radius, wanted.single_b = second.single_radius;
    wanted.strength = adhesion_factor(spread.seed, first.id, spread.sigma);
    if (spread.sigma != 0.0)
      wanted.strength = std::sqrt(wanted.strength * adhesion_factor(spread.seed, second.id, spread.sigma));
    wanted.inverse_mass = cluster.bodies[a].inverse_mass + cluster.bodies[b].inverse_mass;
    wanted.lightest = std::min(first.mass / wanted.radius_a, second.mass / wanted.radius_b);
  } else {
    touch.next_wall = first.first_wall;
    cluster.records[a].first_wall = index;
  }
  touch.pair = pair_numbers(wanted, rules, cluster);

  const int l = index % Springs::lanes;
  if (l == 0) {
    Springs& fresh = cluster.springs.emplace_back();
    std::fill(std::begin(fresh.phase), std::end(fresh.phase), lane::lost);
    std::fill(std::begin(fresh.a), std::end(fresh.a), 0);
    std::fill(std::begin(fresh.b), std::end(fresh.b), 0);
    std::fill(std::begin(fresh.pair), std::end(fresh.pair), touch.pair);
    fresh.one_pair = 1;
    cluster.pulls.resize(cluster.pulls.size() + Springs::lanes, Pull{});
  }
  Springs& s = cluster.springs.back();
  s.a[l] = a, s.b[l] = b;
  s.pair[l] = touch.pair;
  if (touch.pair != s.pair[0]) s.one_pair = 0;
  s.phase[l] = lane::free;
  cluster.alive.push_back(0);
  cluster.pulls[index].share = cluster.constants[touch.pair].share;
  s.idle_until = s.latest = 0.0;
  return index;
}

void set_dashpots(std::size_t index, const Rules& rules, Cluster& cluster) {
  const Touch& touch = cluster.touches[index];
  const SurfaceLaw& law = rules.law(touch.b < 0);
  const PairLaw& pair = cluster.pairs[touch.pair].law;
  Springs& s = cluster.block(index);
  const int l = static_cast<int>(index) % Springs::lanes;
  const double k = s.stiffness[l];
  s.eta[l] = 2.0 * law.zeta * std::sqrt(pair.mass * k);
  s.push_step[l] = allowed_step(rules.springs(touch.b < 0), pair, k);
  if (!law.hertz) s.slip_stiffness[l] = law.tangential_ratio * k;
  s.eta_slip[l] = slip_dashpot(law, rules.rotation, pair.mass, s.slip_stiffness[l]);
}

void restore_contact(std::int32_t index, const Contact& memory, const Rules& rules, Cluster& cluster) {
  Touch& touch = cluster.touches[index];
  touch.memory = memory;
  touch.plane.normal = memory.normal;
  Springs& s = cluster.block(index);
  const int l = index % Springs::lanes;
  s.phase[l] = static_cast<double>(memory.phase);
  cluster.alive[index] = 1;
  s.stiffness[l] = memory.stiffness, s.offset[l] = memory.offset;
  s.slip_stiffness[l] = memory.slip_stiffness, s.knee_stiffness[l] = memory.knee_stiffness;
  for (int d = 0; d < 3; ++d) s.slip[d][l] = memory.slip[d];
  s.spring[l] = s.dashpot[l] = s.limit[l] = 0.0;
  s.max_force[l] = memory.max_force, s.max_overlap[l] = memory.max_overlap;
  set_dashpots(index, rules, cluster);
}

void store_contact(std::size_t index, const Rules& rules, Cluster& cluster) {
  Touch& touch = cluster.touches[index];
  Contact& c = touch.memory;
  const Springs& s = cluster.block(index);
  const int l = static_cast<int>(index) % Springs::lanes;
  c.phase = static_cast<ContactPhase>(s.phase[l]);
  c.stiffness = s.stiffness[l], c.offset = s.offset[l];
  c.slip_stiffness = s.slip_stiffness[l], c.knee_stiffness = s.knee_stiffness[l];
  for (int d = 0; d < 3; ++d) c.slip[d] = s.slip[d][l];
  c.force = vec(cluster.pulls[index].force);
  c.normal_force = s.spring[l] + s.dashpot[l];
  c.max_force = s.max_force[l], c.max_overlap = s.max_overlap[l];
  const Body* b = touch.b >= 0 ? &cluster.bodies[touch.b] : nullptr;
  c.normal = meet(touch, cluster.constants[touch.pair], cluster.bodies[touch.a], b).normal;
  // What holds it, and how much of that is in use.
  const double tangential = (c.force - c.normal * c.normal_force).norm(), limit = s.limit[l];
  c.use = limit > 0.0 ? std::min(1.0, tangential / limit) : 1.0;
  c.use = std::max(c.use, touch.rolling_use);
  const double pull = cluster.pairs[touch.pair].law.largest_pull();
  const bool held =
      pull > 0.0 && (c.phase == ContactPhase::bonded || rules.law(touch.b < 0).attraction != Attraction::well);
  c.hold = std::min(limit, held ? pull : s.spring[l]);
  if (held) c.use = std::max(c.use, std::max(0.0, -s.spring[l]) / pull);
}

void list_shares(Cluster& cluster) {
  cluster.share_begin.assign(cluster.bodies.size() + 1, 0);
  for (const Touch& touch : cluster.touches)
    if (touch.b >= 0) ++cluster.share_begin[touch.a + 1], ++cluster.share_begin[touch.b + 1];
  for (std::size_t i = 0; i < cluster.bodies.size(); ++i) cluster.share_begin[i + 1] += cluster.share_begin[i];
  cluster.shares.resize(cluster.share_begin.back());
  std::vector<std::int32_t> next(cluster.share_begin.begin(), cluster.share_begin.end() - 1);
  for (std::size_t i = 0; i < cluster.touches.size(); ++i) {
    const Touch& touch = cluster.touches[i];
    if (touch.b < 0) continue;
    cluster.shares[next[touch.a]++] = {static_cast<std::int32_t>(i), false};
    cluster.shares[next[touch.b]++] = {static_cast<std::int32_t>(i), true};
  }
}

void match_walls(std::int32_t b, double time, const Rules& rules, Cluster& cluster) {
  constexpr double same_side = 0.8;  // cosine: the normal of one place turns by less between two looks
  const std::vector<WallPlane>& planes = cluster.walls[b].planes;
  const std::int32_t old = cluster.records[b].first_wall;
  if (planes.empty() && old < 0) return;
  const auto lost = [&](std::int32_t i) { return cluster.block(i).phase[i % Springs::lanes] == lane::lost; };
  std::uint64_t taken = 0;  // bits in the order of the chain
  for (const WallPlane& plane : planes) {
    std::int32_t best = -1;
    int best_bit = 0, bit = 0;
    double nearest = same_side;
    for (std::int32_t i = old; i >= 0; i = cluster.touches[i].next_wall, ++bit) {
      if (lost(i) || bit > 63 || (taken >> bit & 1)) continue;
      const double cosine = plane.normal.dot(cluster.touches[i].plane.normal);
      if (cosine > nearest) nearest = cosine, best = i, best_bit = bit;
    }
    if (best >= 0) {
      taken |= std::uint64_t{1} << best_bit;
      cluster.touches[best].plane = plane;
      cluster.block(best).idle_until = 0.0;
    } else {
      const std::int32_t added = add_touch(b, -1, rules, cluster);
      cluster.touches[added].plane = plane;
    }
  }
  int bit = 0;
  for (std::int32_t i = old; i >= 0; i = cluster.touches[i].next_wall, ++bit) {
    if (lost(i) || (bit <= 63 && (taken >> bit & 1))) continue;
    if (cluster.live(i)) end_contact(time, i, cluster);
    cluster.block(i).phase[i % Springs::lanes] = lane::lost;
  }
}

double step_in_flight(const Rules& rules, Cluster& cluster) {
  double step = never;
  for (std::size_t i = 0; i < cluster.bodies.size(); ++i) {
    const BodyRecord& record = cluster.records[i];
    if (record.fixed) continue;
    const PairNumbers wanted = numbers_at_wall(cluster.bodies[i], record, rules);
    const PairLaw& pair = cluster.pairs[pair_numbers(wanted, rules, cluster)].law;
    const double k = first_stiffness(rules.wall, pair, vec(cluster.bodies[i].v).norm(), record.load_size, pair.allowed);
    step = std::min(step, allowed_step(rules.wall_springs, pair, k));
  }
  return step;
}

double time_of_flight(double horizon, const Cluster& cluster) {
  double first = horizon;
  for (std::size_t i = 0; i < cluster.touches.size(); ++i) {
    const Springs& s = cluster.block(i);
    const std::size_t l = i % Springs::lanes;
    if (s.phase[l] == lane::lost) continue;
    const Touch& touch = cluster.touches[i];
    const Body& a = cluster.bodies[touch.a];
    const Eigen::Vector3d acceleration = cluster.records[touch.a].acceleration;
    if (touch.b >= 0) {
      const Body& b = cluster.bodies[touch.b];
      first = std::min(first, first_touch(vec(a.x) - vec(b.x), vec(a.v) - vec(b.v),
                                          acceleration - cluster.records[touch.b].acceleration,
                                          cluster.constants[touch.pair].reach, first));
    } else {
      const Eigen::Vector3d& n = touch.plane.normal;
      first =
          std::min(first, first_zero(touch.plane.gap(vec(a.x), a.radius), n.dot(vec(a.v)), n.dot(acceleration), first));
    }
  }
  return first;
}

}  // namespace puffin::dem
