#include "lbm/scalars/sub_step.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace puffin::lbm {

namespace {

/// The most steps that explicit diffusion allows inside a sweep, see sweep.hpp: with nu = steps * rate, the air never
/// below half,
///   faces * steps * diffusivity <= (1 - nu)^2 * least_air / 2.
double explicit_steps(const ScalarLaw& law, double diffusivity, double rate, double least_air) {
  const bool half_cells = law.wall == WallRule::absorb ||
                          std::any_of(law.fixed.begin(), law.fixed.end(), [](const auto& v) { return v.has_value(); });
  const double b = (half_cells ? 4.0 : 2.0) * diffusivity / (0.5 * least_air);
  const double p = 2.0 * rate + b;
  return 2.0 / (p + std::sqrt(std::max(p * p - 4.0 * rate * rate, 0.0)));
}

}  // namespace

double largest_eddy(const FaceFluxes& fluxes) {
  double largest = 0.0;
  for (const auto& faces : fluxes.eddy)
    for (const double e : faces) largest = std::max(largest, e);
  return largest;
}

SubStep plan_sub_step(const StepLimit& limit, const ScalarOptions& options, const std::vector<int>& moving, double eddy,
                      double share, double remaining) {
  const double longest = std::min({limit.steps, share, remaining});
  SubStep p{longest, false, std::vector<bool>(options.scalar.size(), false)};
  for (const int k : moving) {
    const ScalarLaw& law = options.scalar[k];
    if (law.diffusivity + eddy == 0.0) continue;
    const double rate = options.cfl / limit.steps;
    double allowed = explicit_steps(law, law.diffusivity + eddy, rate, limit.least_air);
    if (1.5 * allowed < longest && law.diffusivity > 0.0) {
      p.any_implicit = p.implicit[k] = true;
      if (eddy == 0.0) continue;
      allowed = explicit_steps(law, eddy, rate, limit.least_air);  // its eddy part stays in the sweeps
    }
    p.steps = std::min(p.steps, allowed);
  }
  const double pieces = std::ceil(remaining / p.steps * (1.0 - 1e-12));
  if (!(pieces < 1e4))
    throw std::runtime_error("scalars: the air's mass fluxes would empty a cell; is the flow still sound?");
  p.steps = remaining / std::max(pieces, 1.0);
  return p;
}

}  // namespace puffin::lbm
