#include "coupling/drag_limit.hpp"

#include <algorithm>
#include <limits>

#include "coupling/stencil_loop.hpp"

namespace puffin::coupling {

void limit_drag(const Stencils& stencils, double interval, const Scale& scale, Spreader& spreader,
                std::span<double> scratch, std::span<double> beta) {
  spreader.smooth(stencils, beta, std::numeric_limits<double>::infinity(), scratch);
  const double per_beta = interval / scale.cell_mass();
  for_each_stencil(stencils, [&](const Stencil& stencil) {
    double& g = scratch[stencil.carrier];
    g *= per_beta;
    beta[stencil.carrier] /= std::max(1.0, g);
  });
}

double load_bound(double largest_fraction, std::span<const double> beta, std::span<const double> solid_volume,
                  double interval, const Scale& scale) {
  double densest = 0.0;
  for (std::size_t p = 0; p < beta.size(); ++p) densest = std::max(densest, beta[p] / solid_volume[p]);
  return largest_fraction * densest * interval / scale.density;
}

}  // namespace puffin::coupling
