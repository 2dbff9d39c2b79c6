#include "lbm/scalars/advance_scalars.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lbm/flush_to_zero.hpp"
#include "lbm/scalars/busy_runs.hpp"
#include "lbm/scalars/check_fluxes.hpp"
#include "lbm/scalars/diffuse_lines.hpp"
#include "lbm/scalars/max_steps.hpp"
#include "lbm/scalars/run_faces.hpp"
#include "lbm/scalars/sub_step.hpp"
#include "lbm/scalars/sweep.hpp"
#include "lbm/scalars/wall_sinks.hpp"

namespace puffin::lbm {

namespace {

std::optional<double> fixed_value(const ScalarLaw& law, int patch) {
  return patch < static_cast<int>(law.fixed.size()) ? law.fixed[patch] : std::nullopt;
}

/// Beside a held value the sweep moves the profile by up to cfl cells, and only diffusion that follows puts it back:
/// mirrored sub-steps, where it moves twice, are up to 2 cfl cells off there. Diffusion that always follows adds
/// cfl^2/2 [cells^2] a sub-step to itself in return (decision 0023): it does where that is less than a fifth of it.
bool always_diffuses_last(const ScalarOptions& options, int k, double steps) {
  const ScalarLaw& law = options.scalar[k];
  return 0.5 * options.cfl * options.cfl < 0.2 * steps * law.diffusivity &&
         std::any_of(law.fixed.begin(), law.fixed.end(), [](const auto& value) { return value.has_value(); });
}

/// What does not change during one update.
template <class Real>
struct Update {
  const Rows& rows;
  const FaceFluxes& fluxes;
  const ScalarOptions& options;
  const std::vector<double>& resting;  // of the sub-step: busy_runs.hpp
  ScalarFields& fields;
  ScalarBudget& budget;

  const std::vector<int>& moving() const { return fields.work.moving; }
  Real* concentration(int k) const { return scratch().concentration.data() + k * rows.slots(); }
  Real* out_high(int k) const { return scratch().out_high.data() + k * rows.slots(); }
  Real* out_low(int k) const { return scratch().out_low.data() + k * rows.slots(); }
  ScalarScratch<Real>& scratch() const { return fields.work.scratch<Real>(); }

  /// Calls visit(run, index) for all computed runs, chunk by chunk in parallel. `prepare` makes what a chunk shares.
  template <class Visit>
  void for_each_run(const Visit& visit) const {
    const auto& chunks = rows.chunks();
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
      const FlushToZero flush;
      std::vector<SweepScalar<Real>> scalars(moving().size());
      for (int r = chunks[c].first_run; r < chunks[c].last_run; ++r)
        if (fields.work.computed[r]) visit(rows.runs()[r], scalars);
    });
  }
};

template <class Real>
void check(const Update<Real>& u, double steps) {
  if (!(steps >= 0.0) || !std::isfinite(steps))
    throw std::invalid_argument("scalars: the number of air steps must be >= 0");
  if (u.options.scalar.size() != u.fields.amount.size() || u.budget.left.size() != u.fields.amount.size())
    throw std::invalid_argument(
        "scalars: " + std::to_string(u.fields.amount.size()) + " fields, " + std::to_string(u.options.scalar.size()) +
        " laws, " + std::to_string(u.budget.left.size()) + " budgets: there must be one of each for every scalar");
  if (!(u.options.cfl > 0.0 && u.options.cfl < 1.0))
    throw std::invalid_argument("the CFL number of the scalars must lie between 0 and 1");
  for (const ScalarLaw& law : u.options.scalar) {
    if (!(law.diffusivity >= 0.0) || !std::isfinite(law.diffusivity))
      throw std::invalid_argument("the diffusivity of a scalar must be >= 0");
    for (const auto& value : law.fixed)
      if (value && !(*value >= 0.0)) throw std::invalid_argument("the fixed value of a scalar must be >= 0");
  }
  if (u.fields.work.checked) return;
  check_fluxes(u.rows, u.fluxes, u.fields.work);
  for (const auto& faces : u.fields.work.openings)
    for (const auto& face : faces)
      for (const auto& patches : u.budget.left)
        if (face.patch >= static_cast<int>(patches.size()))
          throw std::invalid_argument("the budget has too few patches");
  u.fields.work.checked = true;
}

/// What the runs hold and ask for, found in one pass over all of them.
struct Survey {
  RunContents contents;            // of every scalar
  std::vector<LimitFound> limits;  // by the density of the air
  double air_mismatch = 0.0;       // how far the carried air is from the lattice's, where it was carried last
};

template <class Real>
Survey survey(const Update<Real>& u, const SweepKernel& kernel) {
  const std::size_t runs = u.rows.runs().size();
  Survey found{RunContents(u.fields.amount.size(), std::vector<Content>(runs)), std::vector<LimitFound>(runs), 0.0};
  std::vector<double> off(runs, 0.0);
  const auto& chunks = u.rows.chunks();
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    for (int r = chunks[c].first_run; r < chunks[c].last_run; ++r) {
      const Run& run = u.rows.runs()[r];
      const double* density = u.fluxes.density.data() + run.first;
      for (std::size_t k = 0; k < found.contents.size(); ++k)
        found.contents[k][r] = kernel.content(run.count, u.fields.amount[k].data() + run.first);
      found.limits[r] = kernel.limit(faces_of(run, u.fluxes, density, u.options.cfl));
      if (u.fields.work.computed[r]) off[r] = kernel.mismatch(run.count, u.fields.air.data() + run.first, density);
    }
  });
  for (const double o : off) found.air_mismatch = std::max(found.air_mismatch, o);
  return found;
}

template <class Real>
void find_contents(const Update<Real>& u, const SweepKernel& kernel, RunContents& contents) {
  u.for_each_run([&](const Run& run, auto&) {
    for (const int k : u.moving())
      contents[k][u.fields.work.run_of[run.first]] = kernel.content(run.count, u.fields.amount[k].data() + run.first);
  });
}

/// Concentrations of a run by the air that is there.
template <class Real>
void find_concentrations(const Update<Real>& u, const SweepKernel& kernel, const Run& run,
                         std::vector<SweepScalar<Real>>& views) {
  for (std::size_t n = 0; n < views.size(); ++n) {
    const int k = u.moving()[n];
    views[n].resting = u.resting[k];
    views[n].amount = u.fields.amount[k].data() + run.first;
    views[n].concentration = u.concentration(k) + run.first;
  }
  kernel.of<Real>().concentrate(run.count, u.fields.air.data() + run.first, views.data(),
                                static_cast<int>(views.size()));
}

/// theta = density - elapsed * (net outflow), and the concentrations. The fluxes are constant during an update, so the
/// air of a run that joins later needs no history.
template <class Real>
void prepare(const Update<Real>& u, const SweepKernel& kernel, double elapsed) {
  u.for_each_run([&](const Run& run, auto& views) {
    double* air = u.fields.air.data();
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) air[s] = u.fluxes.density[s];
    if (elapsed > 0.0)
      for (int d = 0; d < 3; ++d) {
        const double* mass = u.fluxes.mass[d].data();
        const std::uint8_t* open = u.fluxes.open[d].data();
        const std::ptrdiff_t low = offset_low(run, d);
        for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
          air[s] -= elapsed * ((open[s] ? mass[s] : 0.0) - (open[s + low] ? mass[s + low] : 0.0));
      }
    find_concentrations(u, kernel, run, views);
  });
}

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

/// Gives the openings of direction d what they bring, and books both ways. In the order of the faces, serial.
template <class Real>
void exchange_openings(const Update<Real>& u, int d, double steps, const std::vector<double>& exchange) {
  for (const auto& face : u.fields.work.openings[d]) {
    const std::ptrdiff_t at = face.ghost_is_high ? face.cell : face.ghost;
    if (u.fluxes.open[d][at] != 2) continue;
    const double flux = steps * u.fluxes.mass[d][at];
    const double inflow = std::max(face.ghost_is_high ? -flux : flux, 0.0);
    for (const int k : u.moving()) {
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

template <class Real>
void sweep(const Update<Real>& u, const RunSweep<Real>& kernel, int d, double steps,
           const std::vector<double>& exchange, bool drifts, bool last) {
  if (u.rows.box()[d] == 1 && u.rows.periodic()[d]) return;  // one cell, its own neighbour
  const ScalarWork& work = u.fields.work;
  const std::vector<int>& moving = u.moving();
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

template <class Real>
double advance(const Rows& rows, const FaceFluxes& fluxes, double steps, const ScalarOptions& options,
               ScalarFields& fields, ScalarBudget& budget) {
  std::vector<double> resting;
  const Update<Real> u{rows, fluxes, options, resting, fields, budget};
  check(u, steps);
  static const SweepKernel kernel = select_sweep();
  for (auto* scratch : {&u.scratch().concentration, &u.scratch().out_high, &u.scratch().out_low})
    scratch->resize(rows.slots() * static_cast<std::size_t>(fields.scalars()));
  bool all = !options.skip_empty;
  for (const ScalarLaw& law : options.scalar)
    for (const auto& value : law.fixed) all = all || (value && *value > 0.0);

  auto [contents, limits, air_mismatch] = survey(u, kernel);
  mark_moving_scalars(options, contents, fields);
  const double eddy = largest_eddy(fluxes);
  budget.air_mismatch = std::max(budget.air_mismatch, air_mismatch);
  const double allowed = strictest(limits, options.cfl, {}).steps;  // of all runs, for the caller
  const double share = steps / std::max(1.0, std::ceil(steps / allowed * (1.0 - 1e-12)));
  for (double elapsed = 0.0; elapsed < steps;) {
    if (elapsed > 0.0) find_contents(u, kernel, contents);
    resting = find_resting(contents);
    if (!mark_busy_runs(rows, all, contents, resting, fields)) return allowed;
    prepare(u, kernel, elapsed);
    if (elapsed > 0.0) find_limits(rows, fluxes, fields.air, options.cfl, fields.work.computed, limits);
    SubStep p = plan_sub_step(strictest(limits, options.cfl, fields.work.computed), options, u.moving(), eddy, share,
                              steps - elapsed);
    if (p.any_implicit && !all) {  // lines carry it everywhere at once
      all = true;
      continue;
    }
    // Drift and diffusion balance each other: both in the sweeps, or both in the lines.
    const bool drifts = !fluxes.drift[0].empty();
    if (drifts && p.any_implicit) p.implicit.assign(fields.scalars(), true);
    std::vector<double> exchange(fields.scalars());
    for (const int k : u.moving()) exchange[k] = p.implicit[k] ? 0.0 : p.steps * options.scalar[k].diffusivity;
    const auto sweep_all = [&] {
      for (int n = 0; n < 3; ++n)
        sweep(u, kernel.of<Real>(), fields.reversed ? 2 - n : n, p.steps, exchange, drifts && !p.any_implicit, n == 2);
    };
    const auto diffuse_all = [&](bool before) {
      for (int n = 0; n < 3; ++n)
        for (const int k : u.moving())
          if (p.implicit[k] && before == (fields.reversed && !always_diffuses_last(options, k, p.steps)))
            diffuse_lines(rows, fluxes, fields.reversed ? 2 - n : n, k, options.scalar[k], p.steps, fields, budget);
    };
    // Mirrored from one sub-step to the next, which makes two of them second order in time.
    diffuse_all(true);
    if (p.any_implicit)
      u.for_each_run([&](const Run& run, auto& views) { find_concentrations(u, kernel, run, views); });
    sweep_all();
    diffuse_all(false);
    take_at_walls(fluxes, p.steps, u.moving(), fields, budget);
    fields.reversed = !fields.reversed;
    ++budget.sub_steps;
    for (std::size_t r = 0; r < rows.runs().size(); ++r)
      (fields.work.computed[r] ? budget.cells_computed : budget.cells_skipped) += rows.runs()[r].count;
    elapsed = p.steps < steps - elapsed ? elapsed + p.steps : steps;
  }
  return allowed;
}

}  // namespace

double advance_scalars(const Rows& rows, const FaceFluxes& fluxes, double steps, const ScalarOptions& options,
                       ScalarFields& fields, ScalarBudget& budget) {
  return options.single ? advance<float>(rows, fluxes, steps, options, fields, budget)
                        : advance<double>(rows, fluxes, steps, options, fields, budget);
}

}  // namespace puffin::lbm
