#include "coupling/drag_limit.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "coupling/stencil_loop.hpp"

namespace puffin::coupling {

void limit_drag(const Stencils& stencils, double interval, const Scale& scale, Spreader& spreader,
                std::span<double> scratch, std::span<double> beta, double most) {
  spreader.smooth(stencils, beta, std::numeric_limits<double>::infinity(), scratch);
  const double per_beta = interval / scale.cell_mass();
  for_each_stencil(stencils, [&](const Stencil& stencil) {
    double& g = scratch[stencil.carrier];
    g *= per_beta;
    beta[stencil.carrier] /= std::max(1.0, g / most);
  });
}

void limit_drag_beside_walls(const Stencils& stencils, double interval, const Scale& scale, Spreader& spreader,
                             std::span<double> loads, std::span<double> beta, std::span<double> excess, double most) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  std::vector<double> more(loads.size(), 0.0);
  limit_drag(stencils, interval, scale, spreader, loads, beta, unlimited);
  limit_drag(stencils, interval, scale, spreader, more, excess, unlimited);
  for_each_stencil(stencils, [&](const Stencil& stencil) {
    const int p = stencil.carrier;
    const double asked = beta[p] + excess[p];
    if (!(loads[p] + more[p] > most) || !(asked > 0.0)) return;
    beta[p] /= std::max(1.0, loads[p] / most);
    if (more[p] > 0.0) excess[p] *= std::clamp((most - loads[p]) / more[p], 0.0, 1.0);
    const double still = std::max(1.0, (beta[p] + excess[p]) / asked * (loads[p] + more[p]) / most);
    beta[p] /= still, excess[p] /= still;
  });
}

double load_bound(double largest_fraction, std::span<const double> beta, std::span<const double> solid_volume,
                  double interval, const Scale& scale) {
  double densest = 0.0;
  for (std::size_t p = 0; p < beta.size(); ++p) densest = std::max(densest, beta[p] / solid_volume[p]);
  return largest_fraction * densest * interval / scale.density;
}

}  // namespace puffin::coupling
