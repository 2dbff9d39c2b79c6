#include "lbm/scalars/max_steps.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lbm/scalars/advance_scalars.hpp"
#include "lbm/scalars/run_faces.hpp"

namespace puffin::lbm {

namespace {

/// Outflow and net outflow of one cell through its two faces in direction d, per air step.
struct Outflow {
  double out, net;
};

Outflow outflow(const FaceFluxes& fluxes, int d, std::ptrdiff_t s, std::ptrdiff_t low) {
  const double high_flux = fluxes.open[d][s] != 0 ? fluxes.mass[d][s] : 0.0;
  const double low_flux = fluxes.open[d][s + low] != 0 ? fluxes.mass[d][s + low] : 0.0;
  return {std::max(high_flux, 0.0) + std::max(-low_flux, 0.0), high_flux - low_flux};
}

/// The largest demand 1/n of a run on the number of steps, and its least air.
std::array<double, 2> demand(const Run& run, const FaceFluxes& fluxes, const std::vector<double>& air, double cfl) {
  double most = 0.0, least_air = std::numeric_limits<double>::infinity();
  const std::ptrdiff_t low[3] = {offset_low(run, 0), offset_low(run, 1), offset_low(run, 2)};
  for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) {
    const Outflow x = outflow(fluxes, 0, s, low[0]), y = outflow(fluxes, 1, s, low[1]),
                  z = outflow(fluxes, 2, s, low[2]);
    const double sweeps = std::max({x.out, z.out, y.out + cfl * std::max(x.net, z.net), z.out + cfl * (x.net + y.net),
                                    x.out + cfl * (z.net + y.net)});
    const double between = std::max({x.net, z.net, x.net + y.net, z.net + y.net});
    const double theta = air[s];
    most = std::max(most, std::max(sweeps, 2.0 * cfl * between) / theta);
    least_air = std::min(least_air, theta);
  }
  return {most, least_air};
}

}  // namespace

StepLimit step_limit(const Rows& rows, const FaceFluxes& fluxes, const std::vector<double>& air, double cfl,
                     const std::vector<std::uint8_t>& computed) {
  const auto& chunks = rows.chunks();
  std::vector<std::array<double, 2>> worst(chunks.size(), {0.0, std::numeric_limits<double>::infinity()});
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    for (int r = chunks[c].first_run; r < chunks[c].last_run; ++r) {
      if (!computed.empty() && !computed[r]) continue;
      const auto found = demand(rows.runs()[r], fluxes, air, cfl);
      worst[c] = {std::max(worst[c][0], found[0]), std::min(worst[c][1], found[1])};
    }
  });
  StepLimit limit{0.0, std::numeric_limits<double>::infinity()};
  double most = 0.0;
  for (const auto& [rate, least] : worst) {
    most = std::max(most, rate);
    limit.least_air = std::min(limit.least_air, least);
  }
  limit.steps = most > 0.0 ? cfl / most : std::numeric_limits<double>::infinity();
  return limit;
}

double max_steps(const Rows& rows, const FaceFluxes& fluxes, double cfl) {
  if (!(cfl > 0.0 && cfl < 1.0)) throw std::invalid_argument("the CFL number of the scalars must lie between 0 and 1");
  return step_limit(rows, fluxes, fluxes.density, cfl, {}).steps;
}

}  // namespace puffin::lbm
