#include "lbm/scalars/diffuse_lines.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "lbm/scalars/held_faces.hpp"
#include "lbm/scalars/run_faces.hpp"
#include "lbm/scalars/sweep.hpp"

namespace puffin::lbm {

namespace {

/// What passes a face between a cell and the next one on its high side: give Y_cell - take Y_next. With the drift m
/// over the same time, p = m/exchange: give = exchange B(-p), take = exchange B(p), B(x) = x/(exp(x) - 1). So Y_next =
/// exp(p) Y_cell passes nothing, as in the continuum; without diffusion the drift takes the value upstream. Source: D.
/// L. Scharfetter & H. K. Gummel, IEEE Trans. Electron Devices 16, 64 (1969).
struct Passage {
  double give = 0.0, take = 0.0;
};
Passage passage(double exchange, double drift) {
  if (drift == 0.0) return {exchange, exchange};
  const double size = std::abs(drift);
  const double against = exchange > 1e-3 * size ? size / std::expm1(size / exchange) : 0.0;
  return drift > 0.0 ? Passage{against + size, against} : Passage{against, against + size};
}

/// diag_i y_i - from_low_i y_{i-1} - from_high_i y_{i+1} = right_i; in a ring the ends are neighbours.
struct LineSystem {
  std::vector<double> diag, from_low, from_high, right, scratch, correction;

  void resize(std::size_t n) {
    for (auto* v : {&diag, &from_low, &from_high, &right, &scratch, &correction}) v->assign(n, 0.0);
  }

  /// Weight of the old concentrations: a half, or what keeps e 2 diag <= air, so that nothing changes sign.
  double old_share(const std::vector<double>& air, const std::int32_t* slot) const {
    double share = 0.5;
    for (std::size_t i = 0; i < diag.size(); ++i)
      if (2.0 * share * diag[i] > air[slot[i]]) share = 0.5 * air[slot[i]] / diag[i];
    return share;
  }

  /// Elimination without pivots (columns are dominated by their diagonal): y in place of `y`.
  void eliminate(std::vector<double>& y) {
    const std::size_t n = diag.size();
    double below = diag[0];
    y[0] /= below;
    for (std::size_t i = 1; i < n; ++i) {
      scratch[i] = -from_high[i - 1] / below;
      below = diag[i] + from_low[i] * scratch[i];
      y[i] = (y[i] + from_low[i] * y[i - 1]) / below;
    }
    for (std::size_t i = n - 1; i-- > 0;) y[i] -= scratch[i + 1] * y[i + 1];
  }

  /// A ring: the corner elements as a rank-one change (Sherman & Morrison, Ann. Math. Stat. 21, 124 (1950)).
  void solve(bool ring) {
    const std::size_t n = diag.size();
    if (ring && n == 2) {  // two cells that share two faces
      from_high[0] += from_low[0];
      from_low[1] += from_high[1];
    }
    const double first = ring && n > 2 ? from_low[0] : 0.0, last = ring && n > 2 ? from_high[n - 1] : 0.0;
    if (first == 0.0 && last == 0.0) return eliminate(right);
    // A = B + u v^T with u = (-d, .., -last), v = (1, .., first/d), d = diag_0: B keeps positive diagonals.
    const double d = diag[0];
    diag[0] += d;
    diag[n - 1] += first * last / d;
    correction[0] = -d;
    correction[n - 1] = -last;
    eliminate(right);
    eliminate(correction);
    const double factor = (right[0] + first / d * right[n - 1]) / (1.0 + correction[0] + first / d * correction[n - 1]);
    for (std::size_t i = 0; i < n; ++i) right[i] -= factor * correction[i];
  }
};

}  // namespace

void diffuse_lines(const Rows& rows, const FaceFluxes& fluxes, int d, int scalar, const ScalarLaw& law, double steps,
                   ScalarFields& fields, ScalarBudget& budget) {
  const double exchange = steps * law.diffusivity;
  if (rows.box()[d] == 1 && rows.periodic()[d]) return;
  ScalarWork& work = fields.work;
  std::vector<double>& amount = fields.amount[scalar];
  work.seen.resize(rows.slots());
  double* y = work.seen.data();
  const bool absorbs = law.wall == WallRule::absorb;
  const auto low = [&](std::ptrdiff_t s) { return s + offset_low(rows.runs()[work.run_of[s]], d); };
  const std::vector<HeldFace> held = held_faces(work, fluxes, d, law);
  work.held_count.resize(rows.slots());
  work.held_sum.resize(rows.slots());
  for (const HeldFace& face : held) {
    work.held_count[face.cell] += face.takes;
    work.held_sum[face.cell] += face.value;
  }

  const std::size_t lines = work.line_closes[d].size();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lines, 16), [&](const tbb::blocked_range<std::size_t>& range) {
    LineSystem system;
    std::vector<Passage> high_face;
    for (std::size_t line = range.begin(); line < range.end(); ++line) {
      const std::int32_t* slot = work.line_slots[d].data() + work.line_begin[d][line];
      const std::size_t n = work.line_begin[d][line + 1] - work.line_begin[d][line];
      system.resize(n);
      high_face.assign(n, {});
      for (std::size_t i = 0; i < n; ++i) {
        const std::ptrdiff_t s = slot[i], below = low(s);
        y[s] = amount[s] > dust ? amount[s] / fields.air[s] : 0.0;
        if (absorbs) system.diag[i] += 2.0 * exchange * ((fluxes.open[d][below] == 0) + (fluxes.open[d][s] == 0));
        system.diag[i] += 2.0 * exchange * work.held_count[s];
        system.right[i] = amount[s] + 2.0 * exchange * work.held_sum[s];
        if (fluxes.open[d][s] != 1) continue;
        const std::size_t next = i + 1 < n ? i + 1 : 0;
        high_face[i] = passage(exchange, fluxes.drift[d].empty() ? 0.0 : steps * fluxes.drift[d][s]);
        system.diag[i] += high_face[i].give;
        system.diag[next] += high_face[i].take;
        system.from_high[i] = high_face[i].take;
        system.from_low[next] = high_face[i].give;
      }
      // From here on y is what diffuses and drifts: the part `share` of the old values, the rest of the new.
      const double share = system.old_share(fields.air, slot);
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = i + 1 < n ? i + 1 : 0, last = i > 0 ? i - 1 : n - 1;
        system.right[i] += share * (system.from_high[i] * y[slot[next]] + system.from_low[i] * y[slot[last]] -
                                    system.diag[i] * y[slot[i]]);
      }
      for (std::size_t i = 0; i < n; ++i) {
        system.diag[i] = fields.air[slot[i]] + (1.0 - share) * system.diag[i];
        system.from_high[i] *= 1.0 - share;
        system.from_low[i] *= 1.0 - share;
      }
      system.solve(work.line_closes[d][line]);
      for (std::size_t i = 0; i < n; ++i) {
        double& seen = y[slot[i]];
        seen = share * seen + (1.0 - share) * system.right[i];
      }
      for (std::size_t i = 0; i < n; ++i) {
        const std::ptrdiff_t s = slot[i];
        if (fluxes.open[d][s] == 1) {
          const std::ptrdiff_t next = slot[i + 1 < n ? i + 1 : 0];
          const double moved = high_face[i].take * y[next] - high_face[i].give * y[s];
          amount[s] += moved;
          amount[next] -= moved;
        }
        if (absorbs) {
          const double taken = 2.0 * exchange * y[s] * ((fluxes.open[d][s] == 0) + (fluxes.open[d][low(s)] == 0));
          amount[s] -= taken;
          budget.absorbed_at[scalar][s] += taken;
        }
      }
    }
  });
  for (const HeldFace& face : held) {
    const double out = face.takes ? 2.0 * exchange * y[face.cell] : 0.0, in = 2.0 * exchange * face.value;
    amount[face.cell] += in - out;
    if (face.opening)
      budget.left[scalar][face.patch].add(out);
    else
      budget.absorbed_at[scalar][face.cell] += out;
    budget.entered[scalar][face.patch].add(in);
    work.held_count[face.cell] = work.held_sum[face.cell] = 0.0;
  }
}

}  // namespace puffin::lbm
