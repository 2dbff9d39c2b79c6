#include "lbm/scalars/diffuse_lines.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "lbm/scalars/run_faces.hpp"

namespace puffin::lbm {

namespace {

/// diag_i y_i - link_{i-1} y_{i-1} - link_i y_{i+1} = right_i; link_{n-1} joins the ends if the line closes to a ring.
struct LineSystem {
  std::vector<double> diag, link, right, scratch, correction;

  void resize(std::size_t n) {
    for (auto* v : {&diag, &link, &right, &scratch, &correction}) v->assign(n, 0.0);
  }

  /// Elimination without pivots (the matrix is diagonally dominant): y in place of `right`.
  void eliminate(std::vector<double>& y) {
    const std::size_t n = diag.size();
    double below = diag[0];
    y[0] /= below;
    for (std::size_t i = 1; i < n; ++i) {
      scratch[i] = -link[i - 1] / below;
      below = diag[i] + link[i - 1] * scratch[i];
      y[i] = (y[i] + link[i - 1] * y[i - 1]) / below;
    }
    for (std::size_t i = n - 1; i-- > 0;) y[i] -= scratch[i + 1] * y[i + 1];
  }

  /// A ring: the corner elements as a rank-one change (Sherman & Morrison, Ann. Math. Stat. 21, 124 (1950)).
  void solve(bool ring) {
    const std::size_t n = diag.size();
    const double corner = ring && n > 2 ? link[n - 1] : 0.0;
    if (ring && n == 2) link[0] += link[1];  // two cells that share two faces
    if (corner == 0.0) return eliminate(right);
    // A = B + u v^T with u = (-d, .., -c), v = (1, .., c/d), d = diag_0: B keeps positive diagonals.
    const double d = diag[0];
    diag[0] += d;
    diag[n - 1] += corner * corner / d;
    correction[0] = -d;
    correction[n - 1] = -corner;
    eliminate(right);
    eliminate(correction);
    const double factor =
        (right[0] + corner / d * right[n - 1]) / (1.0 + correction[0] + corner / d * correction[n - 1]);
    for (std::size_t i = 0; i < n; ++i) right[i] -= factor * correction[i];
  }
};

}  // namespace

void diffuse_lines(const Rows& rows, const FaceFluxes& fluxes, int d, int scalar, const ScalarLaw& law, double exchange,
                   ScalarFields& fields, ScalarBudget& budget) {
  if (rows.box()[d] == 1 && rows.periodic()[d]) return;
  ScalarWork& work = fields.work;
  std::vector<double>& amount = fields.amount[scalar];
  double* y = work.concentration.data() + scalar * rows.slots();
  const bool absorbs = law.wall == WallRule::absorb;
  const auto low = [&](std::ptrdiff_t s) { return s + offset_low(rows.runs()[work.run_of[s]], d); };
  const auto high = [&](std::ptrdiff_t s) { return s + offset_high(rows.runs()[work.run_of[s]], d); };
  /// The value held behind a face, if it is an opening with one.
  const auto held = [&](std::ptrdiff_t face, std::ptrdiff_t ghost) -> const double* {
    if (fluxes.open[d][face] != 2) return nullptr;
    const std::size_t patch = work.opening_patch[ghost];
    return patch < law.fixed.size() && law.fixed[patch] ? &*law.fixed[patch] : nullptr;
  };

  const std::size_t lines = work.line_closes[d].size();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lines, 16), [&](const tbb::blocked_range<std::size_t>& range) {
    LineSystem system;
    for (std::size_t line = range.begin(); line < range.end(); ++line) {
      const std::int32_t* slot = work.line_slots[d].data() + work.line_begin[d][line];
      const std::size_t n = work.line_begin[d][line + 1] - work.line_begin[d][line];
      system.resize(n);
      for (std::size_t i = 0; i < n; ++i) {
        const std::ptrdiff_t s = slot[i], below = low(s);
        const auto open_low = fluxes.open[d][below], open_high = fluxes.open[d][s];
        double faces = (open_low == 1) + (open_high == 1);
        if (absorbs) faces += 2.0 * ((open_low == 0) + (open_high == 0));
        system.right[i] = amount[s];
        for (const double* value : {held(below, below), held(s, high(s))}) {
          if (!value) continue;
          faces += 2.0;
          system.right[i] += 2.0 * exchange * *value;
        }
        system.diag[i] = fields.air[s] + exchange * faces;
        system.link[i] = open_high == 1 ? exchange : 0.0;
      }
      system.solve(work.line_closes[d][line]);
      for (std::size_t i = 0; i < n; ++i) y[slot[i]] = system.right[i];
      for (std::size_t i = 0; i < n; ++i) {
        const std::ptrdiff_t s = slot[i];
        if (fluxes.open[d][s] == 1) {
          const std::ptrdiff_t next = slot[i + 1 < n ? i + 1 : 0];
          const double moved = exchange * (y[next] - y[s]);
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
  for (const auto& face : work.openings[d]) {
    const double* value = held(face.ghost_is_high ? face.cell : face.ghost, face.ghost);
    if (!value) continue;
    const double out = 2.0 * exchange * y[face.cell], in = 2.0 * exchange * *value;
    amount[face.cell] += in - out;
    budget.left[scalar][face.patch].add(out);
    budget.entered[scalar][face.patch].add(in);
  }
  tbb::parallel_for(std::size_t{0}, rows.chunks().size(), [&](std::size_t c) {
    for (int r = rows.chunks()[c].first_run; r < rows.chunks()[c].last_run; ++r)
      for (std::ptrdiff_t s = rows.runs()[r].first; s < rows.runs()[r].first + rows.runs()[r].count; ++s)
        y[s] = amount[s] / fields.air[s];
  });
}

}  // namespace puffin::lbm
