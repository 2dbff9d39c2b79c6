#include "coupling/air_steps.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/averaged.hpp"
#include "coupling/divergence.hpp"
#include "coupling/stopwatch.hpp"
#include "lbm/wall_schemes.hpp"

namespace puffin::coupling {

namespace {

/// Sets what drives a step that begins at `start`: boundaries as in its middle; the body force as at its start, since a
/// velocity holds half the force of the step to come, so that two halves make the trapezoidal rule.
void set_drive(const Models& models, double start, const Scale& scale, lbm::Drive& drive) {
  const double time = start + 0.5 * scale.dt;
  drive.speed.assign(models.patches.size(), 0.0);
  drive.density_excess.assign(models.patches.size(), 0.0);
  for (std::size_t b = 0; b < models.patches.size(); ++b) {
    if (models.patches[b].speed) drive.speed[b] = scale.velocity_lu(models.patches[b].speed(time));
    if (models.patches[b].pressure) drive.density_excess[b] = scale.density_excess_lu(models.patches[b].pressure(time));
  }
  const Vec3 force = models.body_force ? models.body_force(start) : Vec3(Vec3::Zero());
  for (int d = 0; d < 3; ++d) drive.uniform_force[d] = scale.force_density_lu(force[d]);
}

/// Fluctuations on the inlets, carried by the mean flow.
void set_inlet_turbulence(const Models& models, const Scale& scale, std::vector<double>& way, lbm::Air& air,
                          lbm::Drive& drive) {
  if (models.turbulence.empty()) return;
  way.resize(models.turbulence.size(), 0.0);
  drive.inlet_fluctuation.assign(air.links.inlets.size(), 0.0F);
  for (std::size_t k = 0; k < way.size(); ++k) {
    const double speed = drive.speed[models.turbulence[k].boundary];
    way[k] += 0.5 * speed * scale.dx;
    lbm::add_fluctuation(models.turbulence[k], way[k] / scale.dx, speed, drive.inlet_fluctuation);
    way[k] += 0.5 * speed * scale.dx;
  }
}

/// Marks the runs beside carriers, where the kernel reads forces or writes moments.
void flag_runs(const std::vector<char>& touched, std::uint8_t flag, lbm::Air& air) {
  for (std::size_t r = 0; r < touched.size(); ++r) {
    air.run_flags[r] = static_cast<std::uint8_t>(air.run_flags[r] & ~flag);
    if (touched[r]) air.run_flags[r] = static_cast<std::uint8_t>(air.run_flags[r] | flag);
  }
}

/// The mean of the last two steps. In a bed the drag of a whole interval follows the air of one step, and is the
/// stronger as the air has less room: what changes sign from step to step would be driven by the drag it makes.
void average(const lbm::Moments& before, lbm::Moments& last) {
  for (const auto list : {&lbm::Moments::density_excess, &lbm::Moments::ux, &lbm::Moments::uy, &lbm::Moments::uz})
    for (std::size_t n = 0; n < (last.*list).size(); ++n)
      (last.*list)[n] = 0.5F * ((last.*list)[n] + (before.*list)[n]);
}

}  // namespace

void give_reaction(double interval, State& s) {
  Spreader::clear(s.forced, s.air->force);
  s.forced.clear();
  std::fill(s.touched.begin(), s.touched.end(), 0);
  if (!s.impulse_on_air.empty()) {
    const MomentumBooking booking = s.spreader.spread(s.stencils, s.impulse_on_air, interval, s.scale, s.air->force);
    s.momentum.given += booking.given;
    s.momentum.taken += booking.taken;
    s.momentum.rounding += booking.rounding;
    s.momentum.exchanged += booking.exchanged;
    s.stencils.mark_runs(s.cells, s.touched);
    s.forced = s.stencils.cells();  // the stencils are built anew for this interval
  }
  if (!s.pores.cells.empty()) share_force(s.pores, s.air->force);
  flag_runs(s.touched, lbm::run_forced, *s.air);
}

void step_air(const Models& models, int steps, double rescale, std::span<const Companion> beside, State& s) {
  lbm::Air& air = *s.air;
  lbm::Moments before_last;
  for (int n = 0; n < steps; ++n) {
    lbm::CollisionConstants constants;
    const double tau = s.scale.relaxation_time(models.air.viscosity / models.air.density);
    constants.tau0 = tau;
    if (n == 0 && rescale != 1.0) {
      constants.rescale = rescale;
      constants.tau0_rescaled = tau;
      constants.tau0 = 0.5 + (tau - 0.5) / rescale;
    }
    set_drive(models, s.time + n * s.scale.dt, s.scale, s.drive);
    set_inlet_turbulence(models, s.scale, s.inlet_way, air, s.drive);
    const bool halved = !s.pores.cells.empty() && n == steps - 2;
    if (n == steps - 1 || halved) {
      std::fill(s.touched.begin(), s.touched.end(), 0);
      s.stencils.mark_runs(s.cells, s.touched);
      for (const Companion& c : beside) c.state->stencils.mark_runs(s.cells, s.touched);
      flag_runs(s.touched, lbm::run_moments, air);
    } else if (n == 0) {
      for (auto& f : air.run_flags) f = static_cast<std::uint8_t>(f & ~lbm::run_moments);
    }
    const lbm::KernelReport report = [&] {
      const Stopwatch watch(s.effort.air);
      if (s.pores.cells.empty()) return lbm::advance_air(constants, s.drive, air);
      const lbm::KernelReport collided = lbm::collide_and_stream(constants, s.drive, air);
      lbm::measure_exchange(air, s.pores);
      lbm::apply_links(s.drive, air);
      lbm::apply_exchange(air, s.pores);
      return collided;
    }();
    if (report.bad) report_bad_cell(air, s.scale, s.time);
    if (halved) before_last = air.moments;
    lbm::keep_mass(constants.rescale, s.pores, air, s.air_mass);
    s.extremes.max_speed_lu = std::max(s.extremes.max_speed_lu, std::sqrt(report.max_speed2));
    s.extremes.min_tau = std::min(s.extremes.min_tau, tau);
  }
  if (!before_last.ux.empty()) average(before_last, air.moments);
  s.extremes.min_dt = std::min(s.extremes.min_dt, s.scale.dt);
  s.extremes.max_dt = std::max(s.extremes.max_dt, s.scale.dt);
  s.effort.steps_at_reference_dt += steps * s.scale.dt / models.time_step.reference_dt;
}

}  // namespace puffin::coupling
