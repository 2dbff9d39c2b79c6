#include "lbm/scalars/advance_scalars.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

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
struct Update {
  const Rows& rows;
  const FaceFluxes& fluxes;
  const ScalarOptions& options;
  ScalarFields& fields;
  ScalarBudget& budget;

  const std::vector<int>& moving() const { return fields.work.moving; }
  double* concentration(int k) const { return fields.work.concentration.data() + k * rows.slots(); }
  double* out_high(int k) const { return fields.work.out_high.data() + k * rows.slots(); }
  double* out_low(int k) const { return fields.work.out_low.data() + k * rows.slots(); }

  /// Calls visit(run, index) for all computed runs, chunk by chunk in parallel. `prepare` makes what a chunk shares.
  template <class Visit>
  void for_each_run(const Visit& visit) const {
    const auto& chunks = rows.chunks();
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
      const FlushToZero flush;
      std::vector<SweepScalar> scalars(moving().size());
      for (int r = chunks[c].first_run; r < chunks[c].last_run; ++r)
        if (fields.work.computed[r]) visit(rows.runs()[r], scalars);
    });
  }
};

void check(const Update& u, double steps) {
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

/// How far the carried air is from the lattice's, where it was carried last.
double air_mismatch(const Update& u) {
  std::vector<double> worst(u.rows.runs().size(), 0.0);
  u.for_each_run([&](const Run& run, auto&) {
    double most = 0.0;
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
      most = std::max(most, std::abs(u.fields.air[s] - u.fluxes.density[s]) / u.fluxes.density[s]);
    worst[u.fields.work.run_of[run.first]] = most;
  });
  double most = 0.0;
  for (const double w : worst) most = std::max(most, w);
  return most;
}

/// theta = density - elapsed * (net outflow), and the concentrations. The fluxes are constant during an update, so the
/// air of a run that joins later needs no history.
void prepare(const Update& u, double elapsed) {
  u.for_each_run([&](const Run& run, auto&) {
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
    for (const int k : u.moving()) {
      const double* amount = u.fields.amount[k].data();
      double* y = u.concentration(k);
      for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
        y[s] = amount[s] > dust ? amount[s] / air[s] : 0.0;
    }
  });
}

/// What the closed faces of absorbing walls take, before the sweep; books it by cell.
void absorb(const Update& u, int d, const Run& run, int k, double exchange) {
  const std::uint8_t* open = u.fluxes.open[d].data();
  const std::ptrdiff_t low = offset_low(run, d);
  for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) {
    const double taken = 2.0 * exchange * u.concentration(k)[s] * ((open[s] == 0) + (open[s + low] == 0));
    u.fields.amount[k][s] -= taken;
    u.budget.absorbed_at[k][s] += taken;
  }
}

/// Gives the openings of direction d what they bring, and books both ways. In the order of the faces, serial.
void exchange_openings(const Update& u, int d, double steps, const std::vector<double>& exchange) {
  for (const auto& face : u.fields.work.openings[d]) {
    const std::ptrdiff_t at = face.ghost_is_high ? face.cell : face.ghost;
    if (u.fluxes.open[d][at] != 2) continue;
    const double flux = steps * u.fluxes.mass[d][at];
    const double inflow = std::max(face.ghost_is_high ? -flux : flux, 0.0);
    for (const int k : u.moving()) {
      double& out = face.ghost_is_high ? u.out_high(k)[face.cell] : u.out_low(k)[face.cell];
      double& in = face.ghost_is_high ? u.out_low(k)[face.ghost] : u.out_high(k)[face.ghost];
      const auto value = fixed_value(u.options.scalar[k], face.patch);
      if (value) out += 2.0 * exchange[k] * u.concentration(k)[face.cell];
      in = value ? (inflow + 2.0 * exchange[k]) * *value : 0.0;
      if (out > 0.0) u.budget.left[k][face.patch].add(out);
      if (in > 0.0) u.budget.entered[k][face.patch].add(in);
    }
  }
}

void sweep(const Update& u, const SweepKernel& kernel, int d, double steps, const std::vector<double>& exchange,
           bool drifts) {
  if (u.rows.box()[d] == 1 && u.rows.periodic()[d]) return;  // one cell, its own neighbour
  const ScalarWork& work = u.fields.work;
  const std::vector<int>& moving = u.moving();
  const int scalars = static_cast<int>(moving.size());
  const auto view = [&](const Run& run, std::vector<SweepScalar>& views) {
    for (int n = 0; n < scalars; ++n) {
      const int k = moving[n];
      views[n] = {u.options.scalar[k].scheme,
                  exchange[k],
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
  const auto update = [&](const Run& run, std::vector<SweepScalar>& views) {
    kernel.update(view(run, views), views.data(), scalars);
  };
  // Runs whose neighbours are all in their own chunk are finished while they are still in the cache.
  const auto& chunks = u.rows.chunks();
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    const FlushToZero flush;
    std::vector<SweepScalar> views(scalars);
    for (int r = chunks[c].first_run; r < chunks[c].last_run; ++r) {
      if (!work.computed[r]) continue;
      const Run& run = u.rows.runs()[r];
      kernel.outgoing(view(run, views), views.data(), scalars);
      for (const int k : moving)
        if (u.options.scalar[k].wall == WallRule::absorb && exchange[k] > 0.0) absorb(u, d, run, k, exchange[k]);
      if (d == 0 && work.local[d][r]) update(run, views);  // no other run lies beside it in x
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
  u.for_each_run([&](const Run& run, std::vector<SweepScalar>& views) {
    if (!work.local[d][work.run_of[run.first]]) update(run, views);
  });
  for (const int k : moving) {  // a ghost may lie beside other cells in the other directions
    for (const auto& face : work.openings[d]) u.out_high(k)[face.ghost] = u.out_low(k)[face.ghost] = 0.0;
    for (const auto& [ghost, cell] : work.periodic[d]) u.out_high(k)[ghost] = u.out_low(k)[ghost] = 0.0;
  }
}

}  // namespace

double advance_scalars(const Rows& rows, const FaceFluxes& fluxes, double steps, const ScalarOptions& options,
                       ScalarFields& fields, ScalarBudget& budget) {
  const Update u{rows, fluxes, options, fields, budget};
  check(u, steps);
  static const SweepKernel kernel = select_sweep();
  bool all = !options.skip_empty;
  for (const ScalarLaw& law : options.scalar)
    for (const auto& value : law.fixed) all = all || (value && *value > 0.0);

  mark_moving_scalars(rows, options, fields);
  const double eddy = largest_eddy(fluxes);
  budget.air_mismatch = std::max(budget.air_mismatch, air_mismatch(u));
  std::vector<LimitFound> limits;
  double allowed = 0.0, share = steps;
  const auto found = [&] { return limits.empty() ? max_steps(rows, fluxes, options.cfl) : allowed; };
  for (double elapsed = 0.0; elapsed < steps;) {
    if (!mark_busy_runs(rows, all, fields)) return found();
    prepare(u, elapsed);
    if (elapsed == 0.0) {  // of all runs, for the caller
      find_limits(rows, fluxes, fluxes.density, options.cfl, {}, limits);
      allowed = strictest(limits, options.cfl, {}).steps;
      share = steps / std::max(1.0, std::ceil(steps / allowed * (1.0 - 1e-12)));
    } else {
      find_limits(rows, fluxes, fields.air, options.cfl, fields.work.computed, limits);
    }
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
        sweep(u, kernel, fields.reversed ? 2 - n : n, p.steps, exchange, drifts && !p.any_implicit);
    };
    const auto diffuse_all = [&](bool before) {
      for (int n = 0; n < 3; ++n)
        for (const int k : u.moving())
          if (p.implicit[k] && before == (fields.reversed && !always_diffuses_last(options, k, p.steps)))
            diffuse_lines(rows, fluxes, fields.reversed ? 2 - n : n, k, options.scalar[k], p.steps, fields, budget);
    };
    // Mirrored from one sub-step to the next, which makes two of them second order in time.
    diffuse_all(true);
    sweep_all();
    diffuse_all(false);
    take_at_walls(fluxes, p.steps, u.moving(), fields, budget);
    fields.reversed = !fields.reversed;
    ++budget.sub_steps;
    for (std::size_t r = 0; r < rows.runs().size(); ++r)
      (fields.work.computed[r] ? budget.cells_computed : budget.cells_skipped) += rows.runs()[r].count;
    elapsed = p.steps < steps - elapsed ? elapsed + p.steps : steps;
  }
  return found();
}

}  // namespace puffin::lbm
