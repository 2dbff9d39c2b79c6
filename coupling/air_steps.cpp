#include "coupling/air_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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

/// Density excess and velocity of one cell [lattice units].
using Reading = std::array<float, 4>;

std::vector<Reading> read(const std::vector<std::int32_t>& cells, const lbm::Moments& m) {
  std::vector<Reading> readings;
  readings.reserve(cells.size());
  for (const std::int32_t s : cells) readings.push_back({m.density_excess[s], m.ux[s], m.uy[s], m.uz[s]});
  return readings;
}

/// As the steps so far leave the air, under the force that has driven it.
std::vector<Reading> read_now(const std::vector<std::int32_t>& cells, const lbm::Drive& drive, const lbm::Air& air) {
  std::vector<Reading> readings;
  readings.reserve(cells.size());
  for (const std::int32_t s : cells) {
    const auto m = lbm::moments_at(air, s);
    const double half = 0.5 / (1.0 + m.density_excess);
    readings.push_back({static_cast<float>(m.density_excess),
                        static_cast<float>(m.ux + half * (air.force.x[s] + drive.uniform_force[0])),
                        static_cast<float>(m.uy + half * (air.force.y[s] + drive.uniform_force[1])),
                        static_cast<float>(m.uz + half * (air.force.z[s] + drive.uniform_force[2]))});
  }
  return readings;
}

/// The mean of two instants a step apart: what changes sign from step to step is not seen (drag_limit.hpp).
void average(const std::vector<std::int32_t>& cells, const std::vector<Reading>& other, lbm::Moments& m) {
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const std::array<float*, 4> at{&m.density_excess[cells[n]], &m.ux[cells[n]], &m.uy[cells[n]], &m.uz[cells[n]]};
    for (std::size_t k = 0; k < at.size(); ++k) *at[k] = 0.5F * (*at[k] + other[n][k]);
  }
}

}  // namespace

std::vector<Vec3> impulse_for(double interval, const State& s) {
  std::vector<Vec3> impulse = s.impulse_on_air;
  for (std::size_t p = 0; p < impulse.size(); ++p) impulse[p] += interval * s.force_on_air[p];
  return impulse;
}

void give_reaction(double interval, State& s) {
  Spreader::clear(s.forced, s.air->force);
  s.forced.clear();
  std::fill(s.touched.begin(), s.touched.end(), 0);
  if (!s.impulse_on_air.empty()) {
    const MomentumBooking booking =
        s.spreader.spread(s.stencils, impulse_for(interval, s), interval, s.scale, s.air->force);
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
  const std::vector<std::int32_t>& cells = s.stencils.cells();
  const bool mean = models.two_way && !cells.empty();
  std::vector<Reading> other;  // of the step before the last, or after it where there is but one
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
    const bool first_of_two = mean && n == steps - 2;
    if (n == steps - 1 || first_of_two) {
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
    if (first_of_two) other = read(cells, air.moments);
    lbm::keep_mass(constants.rescale, s.pores, air, s.air_mass);
    s.extremes.max_speed_lu = std::max(s.extremes.max_speed_lu, std::sqrt(report.max_speed2));
    s.extremes.min_tau = std::min(s.extremes.min_tau, tau);
  }
  if (mean && steps == 1) other = read_now(cells, s.drive, air);
  if (mean) average(cells, other, air.moments);
  s.extremes.min_dt = std::min(s.extremes.min_dt, s.scale.dt);
  s.extremes.max_dt = std::max(s.extremes.max_dt, s.scale.dt);
  s.effort.steps_at_reference_dt += steps * s.scale.dt / models.time_step.reference_dt;
}

}  // namespace puffin::coupling
