#include "coupling/divergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lbm/collision.hpp"

namespace puffin::coupling {

namespace {

/// What the kernel saw in a cell in the last step: a collision moves neither mass nor momentum (but for the force of
/// one step), so the populations that left the cell still hold both. Links have since written their own places; a cell
/// at a wall has got its imbalance back, which is small beside the limits.
lbm::CellMoments<double> moments_seen(const lbm::Air& air, const lbm::Run& run, std::ptrdiff_t slot) {
  const lbm::Parity last = air.parity() == lbm::Parity::even ? lbm::Parity::odd : lbm::Parity::even;
  return std::visit(
      [&](const auto& p) {
        const double none[3] = {0, 0, 0};
        const auto left = [&](auto i) { return static_cast<double>(p.departed(run, slot, i, last)); };
        return lbm::moments_of(lbm::hydrodynamics<false>(left, none));
      },
      air.populations);
}

struct BadCell {
  double part = -1.0, speed = 0.0, density = 1.0;  // part: of the limit; lattice units
  Vec3 x = Vec3::Zero();

  /// Takes the cell's place if that is worse, until one is over the limit.
  void offer(const lbm::CellMoments<double>& m, const lbm::Rows& rows, std::ptrdiff_t slot) {
    if (part >= 1.0) return;
    const double its_speed = std::sqrt(m.ux * m.ux + m.uy * m.uy + m.uz * m.uz);
    double its_part = std::max(its_speed / lbm::speed_limit, std::abs(m.density_excess) / 0.5);
    if (!std::isfinite(its_speed + m.density_excess)) its_part = std::numeric_limits<double>::infinity();
    if (its_part > part) *this = {its_part, its_speed, 1.0 + m.density_excess, rows.centre(slot)};
  }
};

}  // namespace

void report_bad_cell(const lbm::Air& air, const Scale& scale, double time) {
  BadCell seen, now;
  for (const auto& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      seen.offer(moments_seen(air, run, run.first + n), air.rows, run.first + n);
      now.offer(lbm::moments_at(air, run.first + n), air.rows, run.first + n);
    }
  // Seen is what the kernel stopped at; if rounding hides it by a hair, what has become of it, or the worst of all.
  const BadCell& found = seen.part >= 1.0 || seen.part >= now.part ? seen : now;
  diverge(
      "the air diverged at step %lld (t = %.6g s): %s at [%.5g, %.5g, %.5g] m: "
      "speed %.4g (limit %.2g) and density %.4g in lattice units; %.4g m/s. Likely causes: lattice_speed too "
      "high, dx too coarse for the narrowest gap, or an inlet faster than the reference speed",
      static_cast<long long>(air.steps), time,
      found.part < 1.0 ? "a cell reached its limit; nearest to it is that" : "cells out of range, the first",
      found.x[0], found.x[1], found.x[2], found.speed, lbm::speed_limit, found.density, scale.velocity(found.speed));
}

}  // namespace puffin::coupling
