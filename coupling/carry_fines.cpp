#include "coupling/carry_fines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/air_steps.hpp"
#include "coupling/divergence.hpp"
#include "coupling/stopwatch.hpp"
#include "lbm/eddy_diffusion.hpp"

namespace puffin::coupling {

std::optional<double> counted_from(const Models& models, const State& s) {
  return models.settling ? s.first_motion.time() : std::optional(0.0);
}

void keep_fines_in_one_place(int sets, State& s) {
  const auto scalars = static_cast<std::size_t>(mechanisms * sets);
  s.scalars = lbm::ScalarFields();
  s.scalars.amount.assign(scalars, {0.0});
  s.scalars.air.assign(1, 0.0);
  s.budget = lbm::ScalarBudget();
  s.budget.left.resize(scalars);
  s.budget.entered.resize(scalars);
  s.budget.absorbed_at.assign(scalars, {0.0});
  s.fines.placed.assign(static_cast<std::size_t>(sets), 0.0);
}

void move_fines(const Models& models, std::int64_t steps, double interval, State& s) {
  if (s.scalars.scalars() == 0) return;
  if (models.fines) {
    const Stopwatch watch(s.effort.fines);
    s.release.by_contacts(s.events.begun, counted_from(models, s), s.carriers.carriers, *models.fines, s.cells, s.fines,
                          s.scalars);
    const auto& c = s.carriers.carriers;
    if (models.regain) pick_up_from_walls(s.events.begun, counted_from(models, s), c, *models.regain, s.fines);
    if (!s.air) return;  // nothing blows, nothing is carried on
    std::vector<double> slip(c.size());
    for (std::size_t p = 0; p < c.size(); ++p) slip[p] = (s.loads[p].air_velocity - c.velocity[p]).norm();
    s.release.by_drag(s.stencils, slip, interval, c, *models.fines, s.fines, s.scalars);
    if (models.regain && s.airborne)
      reattach(s.stencils, slip, interval, s.scale.dx, c, *models.regain, s.fines, s.scalars);
    const double after = s.fines.to_air[0].value() + s.fines.to_air[1].value() + s.fines.to_air[2].value();
    s.airborne = s.airborne || after > models.scalars.negligible;
  }
  s.steps_since_scalars += steps;
  if (!s.airborne) s.effort.scalar_steps_off += steps;
}

double steps_diffusion_follows(const lbm::ScalarOptions& options) {
  double diffusivity = 0.0;
  for (const lbm::ScalarLaw& law : options.scalar) diffusivity = std::max(diffusivity, law.diffusivity);
  return diffusivity > 0.0 ? std::max(1.0, 0.5 / diffusivity) : std::numeric_limits<double>::infinity();
}

double steps_per_update(double allowed, std::int64_t exchange) {
  const double longest = std::clamp(std::floor(allowed), 1.0, 64.0);
  const auto e = static_cast<double>(exchange);
  if (e <= longest) return longest;
  double best = e;
  const auto cost = [&](double steps) { return std::ceil(steps / allowed * (1.0 - 1e-12)) / steps; };
  for (const double steps : {2.0 * e, 3.0 * e})
    if (steps <= 64.0 && cost(steps) < cost(best) * (1.0 - 1e-12)) best = steps;
  return best;
}

void carry_fines(const Models& models, bool now, State& s) {
  if (s.scalars.scalars() == 0 || !s.air) return;
  if (!s.airborne && models.idle_transport) {
    s.steps_since_scalars = 0;
    return;
  }
  if (s.steps_since_scalars == 0 ||
      (!now && s.steps_since_scalars + models.steps_per_exchange <= s.steps_per_scalar_update))
    return;
  const Stopwatch watch(s.effort.scalars);
  lbm::ScalarOptions options = models.scalars;
  for (std::size_t k = 0; k < options.scalar.size(); ++k)
    options.scalar[k].diffusivity = s.scale.viscosity_lu(models.diffusion[k]);
  if (computes_air(models, s)) {  // a frozen field's stay
    lbm::find_mass_fluxes(*s.air, s.routes, s.fluxes);
    if (!s.pores.cells.empty()) lbm::share_fluxes(*s.air, s.pores, s.routes, s.fluxes);
    if (models.turbulent_schmidt > 0.0)
      lbm::find_eddy_diffusion(*s.air, s.scale.relaxation_time(models.air.viscosity / models.air.density),
                               models.turbulent_schmidt, s.fluxes);
    if (models.drift) {
      update_drift(s.air->rows, s.fluxes, s.scale, *models.drift,
                   static_cast<double>(s.steps_since_scalars) * s.scale.dt, s.fines_drift);
      add_drift(s.air->rows, s.routes, s.scale, *models.drift, s.fines_drift, s.fluxes);
    }
  }
  try {
    const double allowed = lbm::advance_scalars(s.air->rows, s.fluxes, static_cast<double>(s.steps_since_scalars),
                                                options, s.scalars, s.budget);
    s.steps_per_scalar_update =
        models.transport_steps
            ? steps_per_update(std::min(allowed, steps_diffusion_follows(options)), models.steps_per_exchange)
            : 1.0;
  } catch (const std::runtime_error& e) {
    diverge("%s (t = %.6g s)", e.what(), s.time);
  }
  s.effort.scalar_steps += s.steps_since_scalars;
  s.steps_since_scalars = 0;
}

}  // namespace puffin::coupling
