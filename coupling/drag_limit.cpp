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

}  // namespace puffin::coupling
