#include "lbm/scalars/sweep_direction.hpp"

#include <algorithm>
#include <utility>

#include "lbm/scalars/held_faces.hpp"
#include "lbm/scalars/run_faces.hpp"

namespace puffin::lbm {

namespace {

/// What the closed faces of absorbing walls take, before the sweep; books it by cell.
template <class Real>
void absorb(const Update<Real>& u, int d, const Run& run, int k, double exchange) {
  const std::uint8_t* open = u.fluxes.open[d].data();
  const std::ptrdiff_t low = offset_low(run, d);
  for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) {
    const double taken = 2.0 * exchange * u.concentration(k)[s] * ((open[s] == 0) + (open[s + low] == 0));
    u.fields.amount[k][s] -= taken;
    u.budget.absorbed_at[k][s] += taken;
  }
}

/// What walls that hold a value take from the cells beside them and give, before the sweep. Serial, as
/// exchange_openings.
template <class Real>
void exchange_walls(const Update<Real>& u, int d, const std::vector<double>& exchange) {
  for (const int k : u.moving)
    for (const auto& face : u.fields.work.held_walls[d]) {
      const auto value = fixed_value(u.options.scalar[k], face.patch);
      if (!value) continue;
      const bool takes = u.options.scalar[k].wall == WallRule::reflect;  // else absorb() does
      const double taken = takes ? 2.0 * exchange[k] * u.concentration(k)[face.cell] : 0.0;
      const double given = 2.0 * exchange[k] * *value;
      u.fields.amount[k][face.cell] += given - taken;
      u.budget.absorbed_at[k][face.cell] += taken;
      u.budget.entered[k][face.patch].add(given);
    }
}

/// Gives the openings of direction d what they bring, and books both ways. In the order of the faces, serial.
template <class Real>
void exchange_openings(const Update<Real>& u, int d, double steps, const std::vector<double>& exchange) {
  for (const auto& face : u.fields.work.openings[d]) {
    const std::ptrdiff_t at = face.ghost_is_high ? face.cell : face.ghost;
    if (u.fluxes.open[d][at] != 2) continue;
    const double flux = steps * u.fluxes.mass[d][at];
    const double inflow = std::max(face.ghost_is_high ? -flux : flux, 0.0);
    for (const int k : u.moving) {
      Real& out = face.ghost_is_high ? u.out_high(k)[face.cell] : u.out_low(k)[face.cell];
      Real& in = face.ghost_is_high ? u.out_low(k)[face.ghost] : u.out_high(k)[face.ghost];
      const auto value = fixed_value(u.options.scalar[k], face.patch);
      if (value) out += static_cast<Real>(2.0 * exchange[k] * u.concentration(k)[face.cell]);
      in = static_cast<Real>(value ? (inflow + 2.0 * exchange[k]) * *value : 0.0);
      if (out > 0.0) u.budget.left[k][face.patch].add(out);
      if (in > 0.0) u.budget.entered[k][face.patch].add(in);
    }
  }
}

/// What leaves the cells of a run that has no other beside it: nobody else asks, so it stays in the cache.
template <class Real>
class OwnOutflow {
 public:
  void hold(int count, std::vector<SweepScalar<Real>>& views) {
    const std::size_t room = static_cast<std::size_t>(count) + 2 + Rows::padding;
    values_.assign(2 * room * views.size(), Real(0));
    Real* next = values_.data() + 1;  // nothing comes from before the first cell or from behind the last
    for (auto& v : views) {
      v.out_high = std::exchange(next, next + room);
      v.out_low = std::exchange(next, next + room);
    }
  }

 private:
  std::vector<Real> values_;
};

}  // namespace

template <class Real>
void sweep(const Update<Real>& u, const RunSweep<Real>& kernel, int d, double steps,
           const std::vector<double>& exchange, bool drifts, bool last) {
  if (u.rows.box()[d] == 1 && u.rows.periodic()[d]) return;  // one cell, its own neighbour
  const ScalarWork& work = u.fields.work;
  const std::vector<int>& moving = u.moving;
  const int scalars = static_cast<int>(moving.size());
  const auto view = [&](const Run& run, std::vector<SweepScalar<Real>>& views) {
    for (int n = 0; n < scalars; ++n) {
      const int k = moving[n];
      views[n] = {u.options.scalar[k].scheme,
                  exchange[k],
                  u.resting[k],
                  u.fields.amount[k].data() + run.first,
                  u.concentration(k) + run.first,
                  u.out_high(k) + run.first,
                  u.out_low(k) + run.first};
    }
    return SweepRun{run.count,
                    offset_low(run, d),
                    offset_high(run, d),
                    u.fluxes.mass[d].data() + run.first,
                    u.fluxes.open[d].data() + run.first,
                    steps,
                    u.fields.air.data() + run.first,
                    u.fluxes.eddy[d].empty() ? nullptr : u.fluxes.eddy[d].data() + run.first,
                    drifts ? u.fluxes.drift[d].data() + run.first : nullptr};
  };
  for (const int k : moving)
    for (const auto& [ghost, cell] : work.periodic[d]) u.concentration(k)[ghost] = u.concentration(k)[cell];
  const auto take_and_give = [&](const SweepRun& faces, std::vector<SweepScalar<Real>>& views) {
    if (last)  // the next update finds the concentrations anew
      for (auto& v : views) v.concentration = nullptr;
    kernel.update(faces, views.data(), scalars);
  };
  const auto update = [&](const Run& run, std::vector<SweepScalar<Real>>& views) {
    take_and_give(view(run, views), views);
  };
  exchange_walls(u, d, exchange);
  // Runs whose neighbours are all in their own chunk are finished while they are still in the cache.
  const auto& chunks = u.rows.chunks();
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    const FlushToZero flush;
    std::vector<SweepScalar<Real>> views(scalars);
    OwnOutflow<Real> own;
    for (int r = chunks[c].first_run; r < chunks[c].last_run; ++r) {
      if (!work.computed[r]) continue;
      const Run& run = u.rows.runs()[r];
      const SweepRun faces = view(run, views);
      const bool alone = d == 0 && work.local[d][r];  // no other run lies beside it in x
      if (alone) own.hold(run.count, views);
      kernel.outgoing(faces, views.data(), scalars);
      for (const int k : moving)
        if (u.options.scalar[k].wall == WallRule::absorb && exchange[k] > 0.0) absorb(u, d, run, k, exchange[k]);
      if (alone) take_and_give(faces, views);
    }
    for (int r = chunks[c].first_run; r < chunks[c].last_run; ++r)
      if (d != 0 && work.computed[r] && work.local[d][r]) update(u.rows.runs()[r], views);
  });
  for (const int k : moving)
    for (const auto& [ghost, cell] : work.periodic[d]) {
      u.out_high(k)[ghost] = u.out_high(k)[cell];
      u.out_low(k)[ghost] = u.out_low(k)[cell];
    }
  exchange_openings(u, d, steps, exchange);
  u.for_each_run([&](const Run& run, std::vector<SweepScalar<Real>>& views) {
    if (!work.local[d][work.run_of[run.first]]) update(run, views);
  });
  for (const int k : moving) {  // a ghost may lie beside other cells in the other directions
    for (const auto& face : work.openings[d]) u.out_high(k)[face.ghost] = u.out_low(k)[face.ghost] = 0.0;
    for (const auto& [ghost, cell] : work.periodic[d]) u.out_high(k)[ghost] = u.out_low(k)[ghost] = 0.0;
  }
}

template void sweep<float>(const Update<float>&, const RunSweep<float>&, int, double, const std::vector<double>&, bool,
                           bool);
template void sweep<double>(const Update<double>&, const RunSweep<double>&, int, double, const std::vector<double>&,
                            bool, bool);

}  // namespace puffin::lbm
