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
#include "lbm/scalars/sweep_direction.hpp"
#include "lbm/scalars/update.hpp"
#include "lbm/scalars/wall_sinks.hpp"

namespace puffin::lbm {

namespace {

/// So many scalars stay in the cache from one sweep to the next: 32 in 125,000 cells, in double, took 13.5 s all at
/// once, 8.4 s in groups of 8, 8.8 s in groups of 4.
constexpr std::size_t scalars_together = 8;

/// Beside a held value the sweep moves the profile by up to cfl cells, and only diffusion that follows puts it back:
/// mirrored sub-steps, where it moves twice, are up to 2 cfl cells off there. Diffusion that always follows adds
/// cfl^2/2 [cells^2] a sub-step to itself in return (decision 0023): it does where that is less than a fifth of it.
bool always_diffuses_last(const ScalarOptions& options, int k, double steps) {
  const ScalarLaw& law = options.scalar[k];
  return 0.5 * options.cfl * options.cfl < 0.2 * steps * law.diffusivity &&
         std::any_of(law.fixed.begin(), law.fixed.end(), [](const auto& value) { return value.has_value(); });
}

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
  const ScalarWork& work = u.fields.work;
  for (int d = 0; d < 3; ++d)
    for (const auto& face : work.held_walls[d])
      if (face.patch < 0 || work.run_of[face.cell] < 0 ||
          u.fluxes.open[d][face.high ? face.cell : face.cell + offset_low(u.rows.runs()[work.run_of[face.cell]], d)] !=
              0)
        throw std::invalid_argument("scalars: a value is held on a face that is no wall of a cell");
  for (const auto& patches : u.budget.left) {
    const auto missing = [&](const auto& face) { return face.patch >= static_cast<int>(patches.size()); };
    for (int d = 0; d < 3; ++d)
      if (std::any_of(work.openings[d].begin(), work.openings[d].end(), missing) ||
          std::any_of(work.held_walls[d].begin(), work.held_walls[d].end(), missing))
        throw std::invalid_argument("the budget has too few patches");
  }
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
    const FlushToZero flush;
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
    for (const int k : u.moving)
      contents[k][u.fields.work.run_of[run.first]] = kernel.content(run.count, u.fields.amount[k].data() + run.first);
  });
}

/// Concentrations of a run by the air that is there.
template <class Real>
void find_concentrations(const Update<Real>& u, const SweepKernel& kernel, const Run& run,
                         std::vector<SweepScalar<Real>>& views) {
  for (std::size_t n = 0; n < views.size(); ++n) {
    const int k = u.moving[n];
    views[n].resting = u.resting[k];
    views[n].amount = u.fields.amount[k].data() + run.first;
    views[n].concentration = u.concentration(k) + run.first;
  }
  kernel.of<Real>().concentrate(run.count, u.fields.air.data() + run.first, views.data(),
                                static_cast<int>(views.size()));
}

/// theta = density - elapsed * (net outflow). The fluxes are constant during an update, so the air of a run that joins
/// later needs no history.
template <class Real>
void find_air(const Update<Real>& u, const Run& run, double elapsed) {
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
}

template <class Real>
void find_air(const Update<Real>& u, double elapsed) {
  u.for_each_run([&](const Run& run, auto&) { find_air(u, run, elapsed); });
}

template <class Real>
void prepare(const Update<Real>& u, const SweepKernel& kernel, double elapsed) {
  u.for_each_run([&](const Run& run, auto& views) {
    find_air(u, run, elapsed);
    find_concentrations(u, kernel, run, views);
  });
}

/// One sub-step of some scalars. Each such group carries the air anew.
template <class Real>
void advance_group(const Update<Real>& u, const SweepKernel& kernel, double elapsed, const SubStep& p,
                   const std::vector<Stroke>& sweeps) {
  prepare(u, kernel, elapsed);
  const bool reversed = u.fields.reversed, drifts = !u.fluxes.drift[0].empty() && !p.any_implicit;
  std::vector<double> exchange(u.fields.scalars());
  const auto diffuse = [&](bool before) {
    for (int n = 0; n < 3; ++n)
      for (const int k : u.moving)
        if (p.implicit[k] && before == (reversed && !always_diffuses_last(u.options, k, p.steps)))
          diffuse_lines(u.rows, u.fluxes, reversed ? 2 - n : n, k, u.options.scalar[k], p.steps, u.fields, u.budget);
  };
  // Mirrored from one sub-step to the next, which makes two of them second order in time.
  diffuse(true);
  if (p.any_implicit) u.for_each_run([&](const Run& run, auto& views) { find_concentrations(u, kernel, run, views); });
  for (std::size_t n = 0; n < sweeps.size(); ++n) {
    const auto [d, steps] = sweeps[n];
    for (const int k : u.moving) exchange[k] = p.implicit[k] ? 0.0 : steps * u.options.scalar[k].diffusivity;
    sweep(u, kernel.of<Real>(), d, steps, exchange, drifts, n + 1 == sweeps.size());
  }
  diffuse(false);
}

template <class Real>
StepsAllowed advance(const Rows& rows, const FaceFluxes& fluxes, double steps, const ScalarOptions& options,
                     ScalarFields& fields, ScalarBudget& budget) {
  std::vector<double> resting;
  const std::vector<int>& moving = fields.work.moving;
  const Update<Real> u{rows, fluxes, options, resting, moving, fields, budget};
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
  const StepLimit whole = strictest(limits, options.cfl, {});
  const StepsAllowed allowed = allowed_steps(whole, options, moving, eddy);
  const Cut cut = cut_update(steps, whole, allowed);
  for (double elapsed = 0.0; elapsed < steps;) {
    if (elapsed > 0.0) find_contents(u, kernel, contents);
    resting = find_resting(contents);
    if (!mark_busy_runs(rows, all, contents, resting, strokes(cut, 0.0, fields.reversed), fields)) return allowed;
    if (elapsed > 0.0) {
      find_air(u, elapsed);
      find_limits(rows, fluxes, fields.air, options.cfl, fields.work.computed, limits);
    }
    SubStep p = plan_sub_step(strictest(limits, options.cfl, fields.work.computed), options, moving, eddy, cut,
                              steps - elapsed);
    if (p.any_implicit && !all) {  // lines carry it everywhere at once
      all = true;
      continue;
    }
    // Drift and diffusion balance each other: both in the sweeps, or both in the lines.
    if (!fluxes.drift[0].empty() && p.any_implicit) p.implicit.assign(fields.scalars(), true);
    const std::vector<Stroke> sweeps = strokes(cut, p.steps, fields.reversed);
    const double taken_before = cut.middle ? 0.5 * p.steps : 0.0;
    take_at_walls(fluxes, taken_before, moving, fields, budget);
    for (std::size_t first = 0; first == 0 || first < moving.size(); first += scalars_together) {
      const auto begin = moving.begin() + static_cast<std::ptrdiff_t>(first);
      const std::vector<int> group(
          begin, begin + static_cast<std::ptrdiff_t>(std::min(scalars_together, moving.size() - first)));
      advance_group(Update<Real>{rows, fluxes, options, resting, group, fields, budget}, kernel, elapsed, p, sweeps);
    }
    take_at_walls(fluxes, p.steps - taken_before, moving, fields, budget);
    fields.reversed = fields.reversed != !cut.middle;  // a pair is its own mirror image
    ++budget.sub_steps;
    for (std::size_t r = 0; r < rows.runs().size(); ++r)
      (fields.work.computed[r] ? budget.cells_computed : budget.cells_skipped) += rows.runs()[r].count;
    elapsed = p.steps < steps - elapsed ? elapsed + p.steps : steps;
  }
  return allowed;
}

}  // namespace

StepsAllowed advance_scalars(const Rows& rows, const FaceFluxes& fluxes, double steps, const ScalarOptions& options,
                             ScalarFields& fields, ScalarBudget& budget) {
  return options.single ? advance<float>(rows, fluxes, steps, options, fields, budget)
                        : advance<double>(rows, fluxes, steps, options, fields, budget);
}

}  // namespace puffin::lbm
