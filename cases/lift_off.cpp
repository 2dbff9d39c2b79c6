#include "cases/lift_off.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "dem/surface_law.hpp"

namespace puffin::cases {
namespace {

constexpr double wall = std::numeric_limits<double>::infinity();

/// The slip at which `count` carriers together feel `force`: drag grows with the slip, so halving finds it.
double slip_of(const coupling::Models& m, double diameter, double count, double force) {
  if (!(force > 0.0)) return 0.0;
  const auto drag = [&](double slip) {
    return count * slip * coupling::drag_coefficient(m.drag, m.air, diameter, slip, 0.0);
  };
  double high = 1.0;
  while (drag(high) < force)
    if ((high *= 2.0) > 1e6) return std::numeric_limits<double>::infinity();
  double low = 0.0;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (drag(middle) < force ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

LiftOff lift_off(const coupling::Models& m, double diameter, double count) {
  const dem::SurfaceLaw law(m.carriers.wall);
  const double r = 0.5 * diameter, parcel = r * std::cbrt(count);
  return {slip_of(m, diameter, 1.0, dem::pair_law(law, r, r, wall, wall, 1.0).largest_pull()),
          slip_of(m, diameter, count, dem::pair_law(law, parcel, r, wall, wall, 1.0).largest_pull())};
}

std::string parcel_bias(const Carriers& c, const coupling::Models& m) {
  const LiftOff slip = lift_off(m, c.diameter, static_cast<double>(c.parcel));
  if (!(slip.single > 0.0 && std::isfinite(slip.single)))  // nothing to lift off from, or nothing that lifts
    return "one tracked body stands for " + std::to_string(c.parcel) + " carriers";
  const char* scaling = c.adhesion.parcel_scaling == ParcelScaling::ddpm     ? "ddpm"
                        : c.adhesion.parcel_scaling == ParcelScaling::energy ? "energy"
                                                                             : "mass";
  char text[400];
  std::snprintf(text, sizeof text,
                "one tracked body stands for %lld carriers. With %s scaling the air must pass a parcel on a wall at "
                "%.3g m/s to pull with the force of its adhesion, a single carrier at %.3g m/s: the threshold of "
                "lift-off is %.2f times that of single carriers",
                static_cast<long long>(c.parcel), scaling, slip.parcel, slip.single, slip.parcel / slip.single);
  return text;
}

}  // namespace puffin::cases
