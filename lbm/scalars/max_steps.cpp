#include "lbm/scalars/max_steps.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lbm/scalars/advance_scalars.hpp"
#include "lbm/scalars/run_faces.hpp"
#include "lbm/scalars/sweep.hpp"

namespace puffin::lbm {

LimitRun faces_of(const Run& run, const FaceFluxes& fluxes, const double* air_of_run, double cfl) {
  LimitRun faces{run.count, {}, {}, {}, air_of_run, cfl};
  for (int d = 0; d < 3; ++d) {
    faces.mass[d] = fluxes.mass[d].data() + run.first;
    if (!fluxes.drift[d].empty()) faces.drift[d] = fluxes.drift[d].data() + run.first;
    faces.open[d] = fluxes.open[d].data() + run.first;
    faces.low[d] = offset_low(run, d);
  }
  return faces;
}

void find_limits(const Rows& rows, const FaceFluxes& fluxes, const std::vector<double>& air, double cfl,
                 const std::vector<std::uint8_t>& computed, std::vector<LimitFound>& of_run) {
  static const SweepKernel kernel = select_sweep();
  const auto& chunks = rows.chunks();
  of_run.resize(rows.runs().size());
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    for (int r = chunks[c].first_run; r < chunks[c].last_run; ++r) {
      if (!computed.empty() && !computed[r]) continue;
      const Run& run = rows.runs()[r];
      of_run[r] = kernel.limit(faces_of(run, fluxes, air.data() + run.first, cfl));
    }
  });
}

StepLimit strictest(const std::vector<LimitFound>& of_run, double cfl, const std::vector<std::uint8_t>& computed) {
  constexpr double none = std::numeric_limits<double>::infinity();
  StepLimit limit{none, {none, none, none}, none};
  double most = 0.0;
  std::array<double, 3> pair{};
  for (std::size_t r = 0; r < of_run.size(); ++r) {
    if (!computed.empty() && !computed[r]) continue;
    most = std::max(most, of_run[r].demand);
    for (int c = 0; c < 3; ++c) pair[c] = std::max(pair[c], of_run[r].pair[c]);
    limit.least_air = std::min(limit.least_air, of_run[r].least_air);
  }
  if (most > 0.0) limit.steps = cfl / most;
  for (int c = 0; c < 3; ++c)
    if (pair[c] > 0.0) limit.pair[c] = 2.0 * cfl / pair[c];
  return limit;
}

double max_steps(const Rows& rows, const FaceFluxes& fluxes, double cfl) {
  if (!(cfl > 0.0 && cfl < 1.0)) throw std::invalid_argument("the CFL number of the scalars must lie between 0 and 1");
  std::vector<LimitFound> limits;
  find_limits(rows, fluxes, fluxes.density, cfl, {}, limits);
  return strictest(limits, cfl, {}).steps;
}

}  // namespace puffin::lbm
