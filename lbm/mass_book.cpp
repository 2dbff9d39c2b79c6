#include "lbm/mass_book.hpp"

#include <algorithm>
#include <cmath>

namespace puffin::lbm {
namespace {

/// Sum of n numbers in eight sums, which a processor adds side by side.
template <class T>
double sum_of(const T* values, int n) {
  double lane[8] = {0, 0, 0, 0, 0, 0, 0, 0};
  int k = 0;
  for (; k + 8 <= n; k += 8)
    for (int l = 0; l < 8; ++l) lane[l] += static_cast<double>(values[k + l]);
  for (; k < n; ++k) lane[k % 8] += static_cast<double>(values[k]);
  return ((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7]));
}

/// What the shared cells hold less than whole ones: sum of (alpha - 1) rho, so that with the sum of rho - 1 it is that
/// of alpha rho less the cells.
double of_shared_cells(const Air& air, const PoreSpace& pores) {
  double sum = 0.0;
  for (const std::int32_t s : pores.cells) sum += (pores.share[s] - 1.0) * (1.0 + moments_at(air, s).density_excess);
  return sum;
}

/// Sum of rho - 1 (of alpha rho - 1) over the cells.
double excess_of(const Air& air, const PoreSpace& pores) {
  std::vector<double> part(air.rows.chunks().size(), 0.0);
  std::visit(
      [&]<class T>(const Populations<T>& p) {
        for_each_chunk(air.rows, [&](int c, const Chunk& chunk) {
          for (int r = chunk.first_run; r < chunk.last_run; ++r) {
            const Run& run = air.rows.runs()[r];
            for (int i = 0; i < d3q19::q; ++i) part[c] += sum_of(&p.arrived(run, run.first, i), run.count);
          }
        });
      },
      air.populations);
  double sum = of_shared_cells(air, pores);
  for (const double v : part) sum += v;
  return sum;
}

void give_each_cell(double density, Air& air) {
  std::visit(
      [&]<class T>(Populations<T>& p) {
        for_each_chunk(air.rows, [&](int, const Chunk& chunk) {
          for (int r = chunk.first_run; r < chunk.last_run; ++r) {
            const Run& run = air.rows.runs()[r];
            T* const at_rest = &p.arrived(run, run.first, 0);
            for (int n = 0; n < run.count; ++n) at_rest[n] = static_cast<T>(at_rest[n] + density);
          }
        });
      },
      air.populations);
}

}  // namespace

bool is_closed(const Air& air) {
  return std::none_of(air.boundaries.begin(), air.boundaries.end(), [](const Boundary& b) {
    return b.kind == BoundaryKind::velocity_inlet || b.kind == BoundaryKind::pressure_outlet;
  });
}

void keep_mass(double rescale, const PoreSpace& pores, Air& air, MassBook& book) {
  if (!is_closed(air)) return;
  if (book.cells == 0) {
    book.cells = static_cast<std::int64_t>(air.rows.active_cells());
    book.booked = excess_of(air, pores);
    return;
  }
  book.booked *= rescale * rescale;
  if (air.steps % steps_between_looks != 0) return;
  book.missing = book.booked - excess_of(air, pores);
  const double each = book.missing / static_cast<double>(book.cells);
  if (!(std::abs(each) >= least_return)) return;
  give_each_cell(each, air);
  book.returned += book.missing;
  book.missing = 0.0;
  ++book.corrections;
}

}  // namespace puffin::lbm
