#include "tools/puffin/lattice_limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "lbm/moments.hpp"

namespace puffin::tools {

constexpr double most = 0.05;  // of the density: speeds are then wrong by up to as much
constexpr double good = 0.02;  // what the remedy aims at

double density_range(const cases::Simulation& s) {
  if (!s.state.air || s.state.air->steps == 0) return 0.0;
  const auto& air = *s.state.air;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      if (!air.is_fluid(run.first + n)) continue;
      const double excess = lbm::moments_at(air, run.first + n).density_excess;
      low = std::min(low, excess), high = std::max(high, excess);
    }
  return std::max(0.0, high - low);
}

std::vector<std::string> lattice_warnings(const cases::Simulation& s) {
  std::vector<std::string> list;
  char text[320];
  if (const double range = density_range(s); range > most) {
    std::snprintf(
        text, sizeof text,
        "the density of the lattice's air differs by %.0f %% from place to place at the end (%.3g Pa): speeds "
        "and pressure drops err by up to as much; with numerics.lattice_speed = %.2g it would be %.0f %%",
        100.0 * range, s.state.scale.pressure_difference(range), s.lattice_speed * std::sqrt(good / range),
        100.0 * good);
    list.emplace_back(text);
  }
  if (s.state.air && s.state.air->steps > 0 && s.state.extremes.min_tau > 1.0) {
    std::snprintf(text, sizeof text,
                  "tau is %.3g or more throughout: walls and fast changes are inaccurate above 1; lower "
                  "numerics.lattice_speed or dx, or raise numerics.reference_speed",
                  s.state.extremes.min_tau);
    list.emplace_back(text);
  }
  return list;
}

}  // namespace puffin::tools
