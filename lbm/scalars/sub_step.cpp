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

/// The direction that allows the longest pairs around it.
int middle_of_pairs(const StepLimit& whole) {
  return static_cast<int>(std::max_element(whole.pair.begin(), whole.pair.end()) - whole.pair.begin());
}

}  // namespace

double largest_eddy(const FaceFluxes& fluxes) {
  double largest = 0.0;
  for (const auto& faces : fluxes.eddy)
    for (const double e : faces) largest = std::max(largest, e);
  return largest;
}

StepsAllowed allowed_steps(const StepLimit& whole, const ScalarOptions& options, const std::vector<int>& moving,
                           double eddy) {
  StepsAllowed allowed{whole.steps, whole.pair[middle_of_pairs(whole)]};
  const double rate = options.cfl / allowed.pair;
  for (const int k : moving) {
    const ScalarLaw& law = options.scalar[k];
    const double diffusivity = law.diffusivity + eddy;
    // In the middle a pair takes all of its steps at once.
    if (diffusivity > 0.0)
      allowed.pair = std::min(allowed.pair, explicit_steps(law, diffusivity, rate, whole.least_air));
  }
  return allowed;
}

double cost_in_sweeps(const Pieces& pieces) { return (pieces.pairs ? 5.5 : 3.5) * pieces.count; }

Pieces pieces_of(double steps, const StepsAllowed& allowed) {
  const auto count = [steps](double longest) { return std::max(1.0, std::ceil(steps / longest * (1.0 - 1e-12))); };
  const Pieces singles{count(allowed.single), false}, pairs{count(allowed.pair), true};
  return cost_in_sweeps(pairs) < cost_in_sweeps(singles) ? pairs : singles;
}

Cut cut_update(double steps, const StepLimit& whole, const StepsAllowed& allowed) {
  const Pieces pieces = pieces_of(steps, allowed);
  Cut cut{std::nullopt, steps / pieces.count};
  if (pieces.pairs) cut.middle = middle_of_pairs(whole);
  return cut;
}

std::vector<Stroke> strokes(const Cut& cut, double steps, bool reversed) {
  if (!cut.middle) {
    if (reversed) return {{2, steps}, {1, steps}, {0, steps}};
    return {{0, steps}, {1, steps}, {2, steps}};
  }
  const int c = *cut.middle, a = c == 0 ? 1 : 0, b = c == 2 ? 1 : 2;
  const double half = 0.5 * steps;
  return {{a, half}, {b, half}, {c, steps}, {b, half}, {a, half}};
}

SubStep plan_sub_step(const StepLimit& limit, const ScalarOptions& options, const std::vector<int>& moving, double eddy,
                      const Cut& cut, double remaining) {
  const double by_flow = cut.middle ? limit.pair[*cut.middle] : limit.steps;
  const double longest = std::min({by_flow, cut.share, remaining});
  SubStep p{longest, false, std::vector<bool>(options.scalar.size(), false)};
  for (const int k : moving) {
    const ScalarLaw& law = options.scalar[k];
    if (law.diffusivity + eddy == 0.0) continue;
    const double rate = options.cfl / by_flow;
    double allowed = explicit_steps(law, law.diffusivity + eddy, rate, limit.least_air);
    if (!cut.middle && 1.5 * allowed < longest && law.diffusivity > 0.0) {
      p.any_implicit = p.implicit[k] = true;
      if (eddy == 0.0) continue;
      allowed = explicit_steps(law, eddy, rate, limit.least_air);  // its eddy part stays in the sweeps
    }
    p.steps = std::min(p.steps, allowed);
  }
  const double pieces = std::ceil(remaining / p.steps * (1.0 - 1e-12));
  if (!(pieces < 1e4))
    throw std::runtime_error(
        "scalars: the air's mass fluxes would empty a cell: the flow is no longer sound, or a frozen field crosses a "
        "closed patch");
  p.steps = remaining / std::max(pieces, 1.0);
  return p;
}

}  // namespace puffin::lbm
