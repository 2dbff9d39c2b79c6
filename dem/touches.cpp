// The touches of a cluster: the numbers of each pair, and which wall place is which.

#include <cmath>
#include <limits>

#include "dem/adhesion_spread.hpp"
#include "dem/cluster.hpp"
#include "dem/contact_step.hpp"
#include "dem/friction.hpp"

namespace puffin::dem {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double rayleigh_part = 0.2;  // of the Rayleigh time: the longest sub-step of a Hertz contact

}  // namespace

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

}  // namespace puffin::dem
