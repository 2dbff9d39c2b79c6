#include "coupling/divergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace puffin::coupling {

void report_bad_cell(const lbm::Air& air, const Scale& scale, double time) {
  // The kernel saw a cell before its collision and we look after it: if none is out of range now, the one nearest to it
  // is named, and that it is no more than this.
  struct Found {
    double part = -1.0, speed = 0.0, density = 1.0;
    Vec3 x = Vec3::Zero();
  } found;
  for (const auto& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const auto m = lbm::moments_at(air, run.first + n);
      const double speed = std::sqrt(m.ux * m.ux + m.uy * m.uy + m.uz * m.uz);
      double part = std::max(speed / lbm::speed_limit, std::abs(m.density_excess) / 0.5);
      if (!std::isfinite(speed + m.density_excess)) part = std::numeric_limits<double>::infinity();
      if (found.part < 1.0 && part > found.part)
        found = {part, speed, 1.0 + m.density_excess, air.rows.centre(run.first + n)};
    }
  diverge(
      "the air diverged at step %lld (t = %.6g s): %s at [%.5g, %.5g, %.5g] m: "
      "speed %.4g (limit %.2g) and density %.4g in lattice units; %.4g m/s. Likely causes: lattice_speed too "
      "high, dx too coarse for the narrowest gap, or an inlet faster than the reference speed",
      static_cast<long long>(air.steps), time,
      found.part < 1.0 ? "a cell was out of range before its collision; nearest to it now is that"
                       : "cells out of range, the first",
      found.x[0], found.x[1], found.x[2], found.speed, lbm::speed_limit, found.density, scale.velocity(found.speed));
}

}  // namespace puffin::coupling
