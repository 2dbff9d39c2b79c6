#include "cases/compressibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "cases/derived.hpp"
#include "cases/inlet.hpp"
#include "cases/opening.hpp"

namespace puffin::cases {
namespace {

constexpr double most_change = 0.005;  // of the density
constexpr double most_tau = 1.0;       // walls and fast changes are inaccurate above
constexpr double turbulent = 2300.0;   // Reynolds number above which friction is not laminar

/// Per patch: whether the air rubs on it.
std::vector<char> resting_walls(const Case& c, const Surface& s) {
  std::vector<char> rests;
  for (const std::string& name : s.patches.names) rests.push_back(is_resting_wall(c.air, name));
  return rests;
}

double area_of_walls(const Surface& s, const std::vector<char>& rests) {
  double area = 0.0;
  for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t)
    if (rests[s.patches.of_triangle[t]]) area += s.mesh.area(static_cast<int>(t));
  return area;
}

/// Length [m] of the patch's edges that it shares with triangles of resting walls.
double edge_beside_walls(const Surface& s, int patch, const std::vector<char>& rests) {
  const auto& mesh = s.mesh;
  std::set<std::pair<int, int>> border;  // directed edges of the patch
  const auto each_edge = [&](auto&& body) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) body(s.patches.of_triangle[t], mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
  };
  each_edge([&](int p, int a, int b) {
    if (p == patch) border.insert({a, b});
  });
  double length = 0.0;
  each_edge([&](int p, int a, int b) {
    if (p != patch && rests[p] && border.count({b, a}) > 0) length += (mesh.vertices[a] - mesh.vertices[b]).norm();
  });
  return length;
}

/// 8 mu U/D on all resting walls, for the inlet where that is most.
double laminar_friction(const Case& c, const Surface& s) {
  const std::vector<char> rests = resting_walls(c, s);
  const double walls = area_of_walls(s, rests);
  const AreaOf area_of = inlet_areas(c.air, s);
  double most = 0.0;
  for (const Boundary& b : c.air.boundaries) {
    const int patch = s.patches.find(b.patch);
    if (b.type != BoundaryType::velocity_inlet || patch < 0) continue;
    Air alone = c.air;
    alone.boundaries = {b};
    const double area = area_of(b.patch), speed = largest_mean_speed(alone, c.stop.time, area_of);
    const double edge = edge_beside_walls(s, patch, rests);
    if (!(edge > 0.0) || !(speed > 0.0)) continue;
    const double diameter = 4.0 * area / edge;
    if (reynolds(c.air, speed, diameter) > turbulent) continue;
    most = std::max(most, 8.0 * c.air.viscosity * speed / diameter * walls / area);
  }
  return most;
}

/// Difference of the pressures at the outlets; 0 where the flow is turbulent, in a passage of 4 volume/wall area.
double laminar_pressures_apart(const Case& c, const Surface& s, double speed) {
  const std::vector<char> rests = resting_walls(c, s);
  const double walls = area_of_walls(s, rests);
  if (walls > 0.0 && reynolds(c.air, speed, 4.0 * s.volume / walls) > turbulent) return 0.0;
  double low = 0.0, high = 0.0;
  bool first = true;
  for (const Boundary& b : c.air.boundaries) {
    if (b.type != BoundaryType::pressure_outlet) continue;
    low = first ? b.pressure : std::min(low, b.pressure);
    high = first ? b.pressure : std::max(high, b.pressure);
    first = false;
  }
  return high - low;
}

}  // namespace

double common_pressure(const Case& c) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Boundary& b : c.air.boundaries)
    if (b.type == BoundaryType::pressure_outlet) low = std::min(low, b.pressure), high = std::max(high, b.pressure);
  if (low > high) return 0.0;
  return std::max(low, 0.0) + std::min(high, 0.0);
}

double expected_pressure_difference(const Case& c, const Surface& surface, double reference_speed) {
  return std::max(laminar_friction(c, surface), laminar_pressures_apart(c, surface, reference_speed));
}

LatticeSpeed lattice_speed(const Case& c, const Surface& surface, double reference_speed) {
  LatticeSpeed result{c.numerics.lattice_speed, {}};
  const double drop = expected_pressure_difference(c, surface, reference_speed);
  const auto change = [&](double u_lb) {
    return 3.0 * drop / c.air.density * (u_lb / reference_speed) * (u_lb / reference_speed);
  };
  char text[320];
  if (c.numerics.time_step == TimeStepRule::given) {
    const double dx = cell_size(c.numerics, surface.volume);
    const double range = change(reference_speed * c.numerics.time_step_seconds / dx);
    if (range <= most_change) return result;
    std::snprintf(
        text, sizeof text,
        "about %.3g Pa between the ends change the density by %.2g %% with a time_step of %.3g s: speeds err by as "
        "much; \"fixed\" would take %.3g s (0.5 %%)",
        drop, 100.0 * range, c.numerics.time_step_seconds,
        c.numerics.time_step_seconds * std::sqrt(most_change / range));
    result.warning = text;
    return result;
  }
  const double range = change(result.value);
  const double dx = cell_size(c.numerics, surface.volume);
  const double viscous = 3.0 * c.air.viscosity / c.air.density / (reference_speed * dx);  // tau - 1/2 over u_lb
  const double tau = 0.5 + viscous * result.value;
  if (const double calm = (most_tau - 0.5) / viscous; tau > most_tau && change(calm) <= most_change) {
    std::snprintf(text, sizeof text,
                  "so slow and viscous a flow would have tau = %.3g at lattice_speed %.3g, and walls are inaccurate "
                  "above 1: the run takes %.3g (tau 1)",
                  tau, result.value, calm);
    result.value = calm;
    result.warning = text;
    return result;
  }
  if (range <= most_change) return result;
  const double tame = result.value * std::sqrt(most_change / range);
  std::snprintf(
      text, sizeof text,
      "about %.3g Pa between the ends would change the density by %.2g %% at lattice_speed %.3g: the run takes "
      "%.3g (0.5 %%)",
      drop, 100.0 * range, result.value, tame);
  result.value = tame;
  result.warning = text;
  return result;
}

}  // namespace puffin::cases
