#include "lbm/pore_space.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace puffin::lbm {
namespace {

const Run& run_of(const Air& air, std::ptrdiff_t slot) { return air.rows.runs()[air.run_of_slot[slot]]; }

/// Calls body(place) for all shared cells in parallel; each writes what belongs to its own cell alone.
template <class Body>
void for_each_shared(const PoreSpace& pores, const Body& body) {
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pores.cells.size(), 256),
                            [&](const auto& range) {
                              for (std::size_t n = range.begin(); n != range.end(); ++n) body(n);
                            });
}

/// Second-order equilibrium of density 1 and velocity u in direction i.
double equilibrium(int i, const double (&u)[3]) {
  const auto& c = d3q19::velocity[i];
  const double cu = c[0] * u[0] + c[1] * u[1] + c[2] * u[2];
  const double u2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
  return d3q19::weight[i] * (1.0 + 3.0 * cu + 4.5 * cu * cu - 1.5 * u2);
}

}  // namespace

PoreSpace make_pore_space(const Air& air) {
  PoreSpace pores;
  const std::size_t slots = air.run_of_slot.size();
  pores.share.assign(slots, 1.0);
  pores.home.assign(slots, -1);
  for (std::size_t s = 0; s < slots; ++s)
    if (air.run_of_slot[s] >= 0) pores.home[s] = static_cast<std::int32_t>(s);
  for (const auto& [ghost, active] : air.rows.periodic_images()) pores.home[ghost] = static_cast<std::int32_t>(active);
  return pores;
}

void set_shared(const std::vector<std::int32_t>& slots, const std::vector<double>& change, const Air& air,
                PoreSpace& pores) {
  if (slots.size() != change.size()) throw std::invalid_argument("pore space: one change of alpha a cell is needed");
  std::vector<std::int32_t>& cells = pores.cells;
  cells = slots;
  for (const std::int32_t s : slots)
    for (int i = 1; i < d3q19::q; ++i) {
      const std::int32_t beside = pores.home[s + neighbour_offset(run_of(air, s), i)];
      if (beside >= 0) cells.push_back(beside);
    }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  pores.rate.assign(cells.size(), 0.0);
  pores.excess.assign(cells.size(), 0.0);
  for (std::size_t n = 0; n < slots.size(); ++n)
    pores.rate[std::lower_bound(cells.begin(), cells.end(), slots[n]) - cells.begin()] = change[n];
}

void measure_exchange(const Air& air, PoreSpace& pores) {
  std::visit(
      [&]<class T>(const Populations<T>& p) {
        for_each_shared(pores, [&](std::size_t n) {
          const std::int32_t x = pores.cells[n];
          const Run& run = run_of(air, x);
          double sum = 0.0;
          for (int i = 1; i < d3q19::q; ++i) {
            const int back = d3q19::opposite(i);
            const std::int32_t y = pores.home[x + neighbour_offset(run, back)];  // what arrives along i came from there
            if (y < 0 || pores.share[y] == pores.share[x]) continue;
            const double in = p.departed(run_of(air, y), y, i, p.next), out = p.departed(run, x, back, p.next);
            sum += 0.5 * (pores.share[y] - pores.share[x]) * (in - out);
          }
          pores.excess[n] = sum;
        });
      },
      air.populations);
}

void apply_exchange(Air& air, PoreSpace& pores) {
  std::visit(
      [&]<class T>(Populations<T>& p) {
        for_each_shared(pores, [&](std::size_t n) {
          if (pores.excess[n] == 0.0 && pores.rate[n] == 0.0) return;
          const std::int32_t x = pores.cells[n];
          const Run& run = run_of(air, x);
          double rho = 1.0, u[3] = {0.5 * air.force.x[x], 0.5 * air.force.y[x], 0.5 * air.force.z[x]};
          for (int i = 0; i < d3q19::q; ++i) {
            const double g = p.arrived(run, x, i);
            rho += g;
            for (int d = 0; d < 3; ++d) u[d] += d3q19::velocity[i][d] * g;
          }
          for (double& component : u) component /= rho;
          const double before = pores.share[x], after = std::min(1.0, before + pores.rate[n]);  // not 1 + 2e-16
          const double gain = (before * rho + pores.excess[n]) / after - rho;
          for (int i = 0; i < d3q19::q; ++i) {
            T& g = p.arrived(run, x, i);
            g = static_cast<T>(g + gain * equilibrium(i, u));
          }
          pores.share[x] = after;
        });
      },
      air.populations);
}

void share_fluxes(const Air& air, const PoreSpace& pores, const FluxRoutes& routes, FaceFluxes& fluxes) {
  for (const std::int32_t x : pores.cells) {
    const Run& run = run_of(air, x);
    fluxes.density[x] *= pores.share[x];
    const std::array<std::ptrdiff_t, 3> up{x + 1, x + run.shift[2][1], x + run.shift[1][2]};
    const std::array<std::ptrdiff_t, 3> down{x - 1, x + run.shift[0][1], x + run.shift[1][0]};
    for (int d = 0; d < 3; ++d) {
      const std::int32_t above = pores.home[up[d]];
      fluxes.mass[d][x] *= above >= 0 ? 0.5 * (pores.share[x] + pores.share[above]) : pores.share[x];
      if (pores.home[down[d]] < 0) fluxes.mass[d][down[d]] *= pores.share[x];  // else the cell below holds this face
    }
  }
  for (const auto& image : routes.images)
    for (int d = 0; d < 3; ++d) fluxes.mass[d][image.ghost] = fluxes.mass[d][image.active];
}

}  // namespace puffin::lbm
