#include "coupling/carry_fines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/air_steps.hpp"
#include "coupling/averaged.hpp"
#include "coupling/divergence.hpp"
#include "coupling/exchange_interval.hpp"
#include "coupling/stopwatch.hpp"
#include "lbm/eddy_diffusion.hpp"
#include "lbm/wall_schemes.hpp"

namespace puffin::coupling {

namespace {

struct Draught {
  Vec3 x = Vec3::Zero();  // centre of the cell [m]
  double part = 0.0;      // of its air that goes through one of its faces in an air step
};

/// Where the air's mass fluxes are largest beside the air that is there; a cell that is no number comes first.
Draught strongest_draught(const lbm::Rows& rows, const lbm::FaceFluxes& fluxes) {
  Draught worst;
  for (const auto& run : rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot)
      for (const auto& mass : fluxes.mass) {
        const double part = std::abs(mass[slot]) / fluxes.density[slot];
        if (!std::isfinite(part)) return {rows.centre(slot), part};
        if (part > worst.part) worst = {rows.centre(slot), part};
      }
  return worst;
}

/// What the carriers did to the air in the last exchange, per volume of air; empty: nothing. Not the force that lay in
/// the cells: it is what the exchange before gathered, and in an exchange that an output cuts short many times that.
lbm::BodyForce reaction(State& s) {
  lbm::BodyForce force;
  if (s.impulse_on_air.empty() || !(s.exchange_seconds > 0.0)) return force;
  for (auto* component : {&force.x, &force.y, &force.z}) component->assign(s.air->rows.slots(), 0.0F);
  s.spreader.spread(s.stencils, impulse_for(s.exchange_seconds, s), s.exchange_seconds, s.scale, force);
  share_force(s.pores, force);
  return force;
}

}  // namespace

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

double steps_per_update(const lbm::StepsAllowed& allowed, double followed, std::int64_t exchange) {
  constexpr double most = 64.0;
  const auto e = static_cast<double>(exchange);
  const double longest = std::clamp(std::floor(allowed.single), 1.0, most);
  const auto cost = [&](double steps) { return (2.5 + lbm::cost_in_sweeps(lbm::pieces_of(steps, allowed))) / steps; };
  double best = std::max(longest, e), least = cost(std::max(1.0, std::floor(longest / e)) * e);
  for (const double steps : {2.0 * e, 3.0 * e})
    if (steps > longest && steps <= most && cost(steps) < least * (1.0 - 1e-12)) {
      best = steps;
      least = cost(steps);
    }
  return std::min(best, std::max(e, std::floor(followed)));
}

void carry_fines(const Models& models, bool now, State& s) {
  if (s.scalars.scalars() == 0 || !s.air) return;
  if (!s.airborne && models.idle_transport) {
    s.steps_since_scalars = 0;
    return;
  }
  // Steps of the next interval: it may be cut short where carriers are dense.
  const std::int64_t exchange = std::min<std::int64_t>(models.steps_per_exchange, most_steps(models, s));
  if (s.steps_since_scalars == 0 || (!now && s.steps_since_scalars + exchange <= s.steps_per_scalar_update)) return;
  const Stopwatch watch(s.effort.scalars);
  lbm::ScalarOptions options = models.scalars;
  // In the steps of the fluxes, of which a retreat makes several out of one in a frozen field.
  Scale of_fluxes = s.scale;
  of_fluxes.dt = step_of_cells(models, s);
  const double part = s.scale.dt / of_fluxes.dt;
  for (std::size_t k = 0; k < options.scalar.size(); ++k)
    options.scalar[k].diffusivity = of_fluxes.viscosity_lu(models.diffusion[k]);
  if (computes_air(models, s)) {  // a frozen field's stay
    lbm::find_mass_fluxes(*s.air, s.routes, lbm::wall_speed(s.drive, *s.air), s.fluxes);
    if (models.drift) {  // by the pressure: the density of the air, before it is that of the part of a cell that is air
      const lbm::BodyForce carriers = reaction(s);
      const ForceOnAir force{s.drive.uniform_force, carriers.x.empty() ? nullptr : &carriers};
      update_drift(s.air->rows, s.fluxes, force, s.scale, *models.drift,
                   static_cast<double>(s.steps_since_scalars) * s.scale.dt, s.fines_drift);
    }
    if (!s.pores.cells.empty()) lbm::share_fluxes(*s.air, s.pores, s.routes, s.fluxes);
    if (models.turbulent_schmidt > 0.0)
      lbm::find_eddy_diffusion(*s.air, s.scale.relaxation_time(models.air.viscosity / models.air.density),
                               models.turbulent_schmidt, s.fluxes);
    if (models.drift) add_drift(s.air->rows, s.routes, s.scale, *models.drift, s.fines_drift, s.fluxes);
  }
  try {
    const lbm::StepsAllowed allowed = lbm::advance_scalars(
        s.air->rows, s.fluxes, part * static_cast<double>(s.steps_since_scalars), options, s.scalars, s.budget);
    s.steps_per_scalar_update = models.transport_steps
                                    ? steps_per_update({allowed.single / part, allowed.pair / part},
                                                       steps_diffusion_follows(options) / part, exchange)
                                    : 1.0;
  } catch (const std::runtime_error& e) {
    const Draught worst = strongest_draught(s.air->rows, s.fluxes);
    diverge("%s (t = %.6g s): the cell at [%.5g, %.5g, %.5g] m passes %.3g of its air through one face in a step",
            e.what(), s.time, worst.x[0], worst.x[1], worst.x[2], worst.part);
  }
  s.effort.scalar_steps += s.steps_since_scalars;
  s.steps_since_scalars = 0;
}

}  // namespace puffin::coupling
