#include "lbm/eddy_diffusion.hpp"

#include <cmath>

#include "lbm/collision.hpp"
#include "lbm/scalars/run_faces.hpp"

namespace puffin::lbm {

void find_eddy_viscosity(const Air& air, double tau0, std::vector<double>& viscosity) {
  viscosity.assign(air.rows.slots(), 0.0);
  std::visit(
      [&]<class T>(const Populations<T>& p) {
        for_each_chunk(air.rows, [&](int, const Chunk& chunk) {
          for (int r = chunk.first_run; r < chunk.last_run; ++r) {
            const Run& run = air.rows.runs()[r];
            for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) {
              double g[19];
              for (int i = 0; i < d3q19::q; ++i) g[i] = p.arrived(run, s, i);
              const double none[3] = {0, 0, 0};
              auto h = hydrodynamics<false>([&](auto i) { return g[i]; }, none);
              remove_trace(h.pi);
              double norm = 0.0;  // |Pi|^2
              for (int n = 0; n < 6; ++n) norm += (n < 3 ? 1.0 : 2.0) * h.pi[n] * h.pi[n];
              const double les = static_cast<double>(air.les[s]) * h.inverse_rho;
              viscosity[s] = (std::sqrt(tau0 * tau0 + les * std::sqrt(norm)) - tau0) / 6.0;
            }
          }
        });
      },
      air.populations);
}

void find_eddy_diffusion(const Air& air, double tau0, double schmidt, FaceFluxes& fluxes) {
  std::vector<double> viscosity;
  find_eddy_viscosity(air, tau0, viscosity);
  const auto& images = air.rows.periodic_images();
  for (const auto& [ghost, cell] : images) viscosity[ghost] = viscosity[cell];
  for (int d = 0; d < 3; ++d) {
    auto& eddy = fluxes.eddy[d];
    eddy.assign(air.rows.slots(), 0.0);
    for_each_chunk(air.rows, [&](int, const Chunk& chunk) {
      for (int r = chunk.first_run; r < chunk.last_run; ++r) {
        const Run& run = air.rows.runs()[r];
        const std::ptrdiff_t high = offset_high(run, d);
        for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
          if (fluxes.open[d][s] == 1) eddy[s] = 0.5 * (viscosity[s] + viscosity[s + high]) / schmidt;
      }
    });
    for (const auto& [ghost, cell] : images) eddy[ghost] = eddy[cell];
  }
}

}  // namespace puffin::lbm
