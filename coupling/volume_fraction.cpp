#include "coupling/volume_fraction.hpp"

#include "coupling/stencil_loop.hpp"

namespace puffin::coupling {

double solid_fraction(const Stencils& stencils, std::span<const double> solid_volume, double dx, Spreader& spreader,
                      std::span<double> fraction) {
  const double cell = dx * dx * dx;
  const double largest = spreader.smooth(stencils, solid_volume, largest_solid_fraction * cell, fraction);
  for_each_stencil(stencils, [&](const Stencil& stencil) { fraction[stencil.carrier] /= cell; });
  return largest / cell;
}

}  // namespace puffin::coupling
