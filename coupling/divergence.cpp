#include "coupling/divergence.hpp"

#include <cmath>

namespace puffin::coupling {

void report_bad_cell(const lbm::Air& air, const Scale& scale, double time) {
  for (const auto& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const auto m = lbm::moments_at(air, run.first + n);
      const double speed = std::sqrt(m.ux * m.ux + m.uy * m.uy + m.uz * m.uz);
      if (speed < lbm::speed_limit && std::abs(m.density_excess) < 0.5) continue;
      const Vec3 x = air.rows.centre(run.first + n);
      diverge(
          "the air diverged at step %lld (t = %.6g s): cells out of range, the first at [%.5g, %.5g, %.5g] m: "
          "speed %.4g (limit %.2g) and density %.4g in lattice units; %.4g m/s. Likely causes: lattice_speed too "
          "high, dx too coarse for the narrowest gap, or an inlet faster than the reference speed",
          static_cast<long long>(air.steps), time, x[0], x[1], x[2], speed, lbm::speed_limit, 1.0 + m.density_excess,
          scale.velocity(speed));
    }
  diverge("the air diverged at step %lld (t = %.6g s): a cell was out of range", static_cast<long long>(air.steps),
          time);
}

}  // namespace puffin::coupling
