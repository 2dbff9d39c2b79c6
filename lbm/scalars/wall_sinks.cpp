#include "lbm/scalars/wall_sinks.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace puffin::lbm {

void take_at_walls(const FaceFluxes& fluxes, double steps, const std::vector<int>& scalars, ScalarFields& fields,
                   ScalarBudget& budget) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, fluxes.sinks.size(), 512), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const auto& [slot, rate] = fluxes.sinks[n];
      if (!(rate > 0.0)) continue;
      const double part = -std::expm1(-rate * steps);
      for (const int k : scalars) {
        double& amount = fields.amount[k][slot];
        if (!(amount > 0.0)) continue;
        const double before = amount;
        amount = before - part * before;
        budget.absorbed_at[k][slot] += before - amount;
      }
    }
  });
}

}  // namespace puffin::lbm
