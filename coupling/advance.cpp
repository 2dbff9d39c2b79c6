// One exchange interval on one page. Long because the whole order of the physics stands here. The order, and why it is
// this:
//   air steps     with the carriers' reaction of the interval before (explicit, as the air is 1,000 times faster)
//   interpolation of the air at the carriers' present places, through the same stencils that carried their reaction
//   carriers      over the same interval, drag semi-implicit; what drag gave them is what the air will lose next
//   fines         taken off by the contacts and the slip of this interval
//   transport     of the fines by the lattice's own fluxes, in steps of its own

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>

#include "coupling/advance_together.hpp"
#include "coupling/averaged.hpp"
#include "coupling/divergence.hpp"
#include "coupling/drag_limit.hpp"
#include "coupling/field_forces.hpp"
#include "coupling/self_disturbance.hpp"
#include "coupling/state.hpp"
#include "coupling/volume_fraction.hpp"
#include "dem/advance.hpp"
#include "dem/open_contacts.hpp"
#include "lbm/eddy_diffusion.hpp"
#include "lbm/wall_schemes.hpp"

namespace puffin::coupling {

namespace {

/// Adds the seconds of its life to a counter.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

bool all_asleep(const dem::Carriers& carriers) {
  return std::none_of(carriers.rest.begin(), carriers.rest.end(), [](dem::Rest r) { return r == dem::Rest::awake; });
}

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

/// The carriers' reaction of the last interval becomes a force in the cells during `interval`.
void give_reaction(double interval, State& s) {
  Spreader::clear(s.spread_on, s.air->force);
  std::fill(s.touched.begin(), s.touched.end(), 0);
  if (!s.impulse_on_air.empty()) {
    const MomentumBooking booking = s.spreader.spread(s.stencils, s.impulse_on_air, interval, s.scale, s.air->force);
    s.momentum.given += booking.given;
    s.momentum.taken += booking.taken;
    s.momentum.rounding += booking.rounding;
    s.momentum.exchanged += booking.exchanged;
    s.stencils.mark_runs(s.cells, s.touched);
    std::swap(s.spread_on, s.stencils);  // the stencils are built anew for this interval
  } else {
    s.spread_on = Stencils();
  }
  if (!s.pores.cells.empty()) share_force(s);
  flag_runs(s.touched, lbm::run_forced, *s.air);
}

/// `beside`: further states whose carriers will ask for the air's velocity.
void step_air(const Models& models, int steps, double rescale, std::span<const Companion> beside, State& s) {
  lbm::Air& air = *s.air;
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
    if (n == steps - 1) {
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
    lbm::keep_mass(constants.rescale, s.pores, air, s.air_mass);
    s.extremes.max_speed_lu = std::max(s.extremes.max_speed_lu, std::sqrt(report.max_speed2));
    s.extremes.min_tau = std::min(s.extremes.min_tau, tau);
  }
  s.extremes.min_dt = std::min(s.extremes.min_dt, s.scale.dt);
  s.extremes.max_dt = std::max(s.extremes.max_dt, s.scale.dt);
  s.effort.steps_at_reference_dt += steps * s.scale.dt / models.time_step.reference_dt;
}

/// Whether the lattice computes the air. A frozen field may have cells too: the fines need them.
bool computes_air(const Models& models, const State& s) { return s.air && !models.frozen_air; }

/// Velocity of the air and drag coefficient at every carrier.
void find_loads(const Models& models, double interval, State& s) {
  dem::Carriers& c = s.carriers.carriers;
  const std::size_t count = c.size();
  std::vector<int> which(count);
  for (std::size_t p = 0; p < count; ++p) which[p] = static_cast<int>(p);
  std::vector<Vec3> velocity(count, Vec3::Zero());
  if (computes_air(models, s)) {
    interpolate(s.stencils, s.air->moments, count, s.samples);
    for (std::size_t p = 0; p < count; ++p) velocity[p] = s.samples.velocity_lu[p] * s.scale.speed();
  } else if (models.frozen_air) {
    // At the middle of the way, so that a vortex or a shear is followed to second order.
    for (std::size_t p = 0; p < count; ++p)
      velocity[p] = models.frozen_air(c.position[p] + 0.5 * interval * c.velocity[p]);
  }
  s.loads.assign(count, dem::Load{});
  if (!s.air && !models.frozen_air) return;
  std::vector<double> beta(count, 0.0), solid, volume;
  double largest_fraction = 1.0;
  if (s.air && models.volume_fraction != VolumeFraction::none) {
    volume.resize(count);
    for (std::size_t p = 0; p < count; ++p)
      volume[p] = c.carriers[p] * 4.1887902047863909846 * std::pow(c.single_radius[p], 3);
    solid.assign(count, 0.0);
    largest_fraction = solid_fraction(s.stencils, volume, s.scale.dx, s.spreader, solid);
  }
  drag_coefficients(models.drag, models.air, which, velocity, c.velocity, c.single_radius, c.carriers, solid, beta);
  if (models.frozen_air) {  // the coefficient too at the middle: with the slip that half the interval will have left
    std::vector<Vec3> middle(count);
    for (std::size_t p = 0; p < count; ++p)
      middle[p] = velocity[p] + (c.velocity[p] - velocity[p]) * std::exp(-0.5 * interval * beta[p] / c.mass[p]);
    drag_coefficients(models.drag, models.air, which, velocity, middle, c.single_radius, c.carriers, solid, beta);
  }
  if (computes_air(models, s) && models.two_way) take_off_self(models, solid, s, velocity, beta);
  if (computes_air(models, s))
    for (const int p : s.stencils.outside()) beta[p] = 0.0;      // no air there: nothing drags
  const double reaction_time = interval / least_share(s.pores);  // a cell that is partly solid holds less air
  const bool harmless = !volume.empty() && load_bound(largest_fraction, beta, volume, reaction_time, s.scale) <= 1.0;
  if (computes_air(models, s) && models.two_way && !harmless) {
    std::vector<double> scratch(count, 0.0);
    limit_drag(s.stencils, reaction_time, s.scale, s.spreader, scratch, beta);
  }
  for (std::size_t p = 0; p < count; ++p) {
    s.loads[p].air_velocity = velocity[p];
    s.loads[p].drag = beta[p];
  }
  add_field_forces(models, interval, s);
}

/// Takes carriers out that have left through an opening. One that has left through a wall is a failure.
void remove_departed(const Models& models, State& s) {
  dem::Carriers& c = s.carriers.carriers;
  std::vector<std::uint8_t> gone;
  std::vector<std::int64_t> emitted;
  for (std::size_t p = 0; p < c.size(); ++p) {
    if (c.rest[p] != dem::Rest::awake) continue;
    const auto triangle = models.walls->beyond_opening(c.position[p]);
    if (!triangle) continue;
    gone.resize(c.size(), 0);
    gone[p] = 1;
    const int patch = models.opening_of_triangle[*triangle];
    s.departures.push_back({c.id[p], s.time, patch, c.carriers[p]});
    emitted.push_back(c.id[p]);
  }
  if (gone.empty()) return;
  const auto open = dem::open_contacts(s.carriers, s.time, gone);
  s.events.ended.insert(s.events.ended.end(), open.begin(), open.end());
  mark_emitted(emitted, s.fines);
  dem::remove(gone, s.carriers);  // what they owe the air is still in impulse_on_air, by their old places
}

/// The carriers' part. What their integration cannot go on with is a divergence, with the place where it happened.
void step_carriers(const Models& models, double interval, State& s) {
  const Stopwatch watch(s.effort.carriers);
  try {
    dem::advance(interval, models.carriers, *models.walls, s.loads, s.carriers, s.events);
  } catch (const std::runtime_error& e) {
    const dem::Carriers& c = s.carriers.carriers;
    std::string where;
    for (std::size_t p = 0; where.empty() && p < c.size() && p < s.stencils_at.position.size(); ++p)
      if (!c.position[p].allFinite() || !c.velocity[p].allFinite()) {
        char text[96];
        const Vec3& x = s.stencils_at.position[p];
        std::snprintf(text, sizeof text, "; it was last at [%.5g, %.5g, %.5g] m", x[0], x[1], x[2]);
        where = text;
      }
    diverge("%s%s. Likely causes: a contact too stiff for its step, or air that diverged around the carrier", e.what(),
            where.c_str());
  }
}

/// Contacts count from here on.
std::optional<double> counted_from(const Models& models, const State& s) {
  return models.settling ? s.first_motion.time() : std::optional(0.0);
}

void move_fines(const Models& models, std::int64_t steps, double interval, State& s) {
  if (s.scalars.scalars() == 0 || !s.air) return;
  if (models.fines) {
    const Stopwatch watch(s.effort.fines);
    const double before = s.fines.to_air[0].value() + s.fines.to_air[1].value() + s.fines.to_air[2].value();
    s.release.by_contacts(s.events.begun, counted_from(models, s), s.carriers.carriers, *models.fines, s.cells, s.fines,
                          s.scalars);
    const auto& c = s.carriers.carriers;
    if (models.regain) pick_up_from_walls(s.events.begun, counted_from(models, s), c, *models.regain, s.fines);
    std::vector<double> slip(c.size());
    for (std::size_t p = 0; p < c.size(); ++p) slip[p] = (s.loads[p].air_velocity - c.velocity[p]).norm();
    s.release.by_drag(s.stencils, slip, interval, c, *models.fines, s.fines, s.scalars);
    if (models.regain && s.airborne)
      reattach(s.stencils, slip, interval, s.scale.dx, c, *models.regain, s.fines, s.scalars);
    const double after = s.fines.to_air[0].value() + s.fines.to_air[1].value() + s.fines.to_air[2].value();
    s.airborne = s.airborne || after > before;
  }
  s.steps_since_scalars += steps;
  if (!s.airborne) s.effort.scalar_steps_off += steps;
}

/// Carries the airborne fines over the steps since the last time. Due when the next exchange could exceed the CFL
/// limit.
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
    s.steps_per_scalar_update = models.transport_steps ? std::clamp(std::floor(allowed), 1.0, 64.0) : 1.0;
  } catch (const std::runtime_error& e) {
    diverge("%s (t = %.6g s)", e.what(), s.time);
  }
  s.effort.scalar_steps += s.steps_since_scalars;
  s.steps_since_scalars = 0;
}

/// What one exchange interval is: its air steps, the change of the time step before them, its length [s].
struct Interval {
  int steps = 1;
  double rescale = 1.0, seconds = 0.0;
};

/// Air steps that the next interval may have.
int most_steps(const Models& models, const State& s) {
  const bool resting = s.carriers.carriers.size() == 0 || all_asleep(s.carriers.carriers);
  return resting ? models.steps_per_exchange_asleep : models.steps_per_exchange;
}

/// Takes a new time step over; airborne fines are carried first, with the fluxes of the old one.
void take_time_step(const Models& models, double dt, State& s) {
  if (s.air && dt != s.scale.dt) {
    carry_fines(models, true, s);
    ++s.effort.rescalings;
  }
  s.scale.dt = dt;
}

Interval interval_until(double until, int most, double old_dt, const State& s) {
  Interval i;
  i.rescale = s.air ? s.scale.dt / old_dt : 1.0;
  i.steps = std::clamp(static_cast<int>(std::ceil((until - s.time) / s.scale.dt - 1e-9)), 1, most);
  // Without a lattice nothing ties the interval to whole steps: it ends where it is asked to.
  const double whole = i.steps * s.scale.dt;
  i.seconds = !s.air && until > s.time ? std::min(whole, until - s.time) : whole;
  return i;
}

/// Where the carriers are, before the air moves.
void find_stencils(const Models& models, const Interval& interval, State& s) {
  if (all_asleep(s.carriers.carriers) && s.carriers.carriers.size() > 0)
    s.effort.exchanges_saved += std::max(0, interval.steps / models.steps_per_exchange - 1);
  if (!s.air) return;
  const Stopwatch watch(s.effort.exchange);
  if (computes_air(models, s)) give_reaction(interval.seconds, s);
  std::vector<int> all(s.carriers.carriers.size());
  for (std::size_t p = 0; p < all.size(); ++p) all[p] = static_cast<int>(p);
  s.stencils_at = {s.carriers.carriers.position, s.carriers.carriers.radius};
  s.stencils.build(s.cells, s.stencils_at.position, s.stencils_at.radius, all);
  if (computes_air(models, s)) follow_volume(models, interval.steps, s);
}

/// Carriers and fines over the interval that the air has done.
void follow_air(const Models& models, const Interval& interval, double until, State& s) {
  s.events.clear();
  if (s.carriers.carriers.size() > 0) {
    ++s.effort.exchanges;
    if (s.time >= models.carriers_start)
      for (auto& rest : s.carriers.carriers.rest)
        if (rest == dem::Rest::held) rest = dem::Rest::awake;
    {
      const Stopwatch watch(s.effort.exchange);
      find_loads(models, interval.seconds, s);
    }
    step_carriers(models, interval.seconds, s);
    s.first_motion.update(s.carriers.carriers, s.time + interval.seconds);
    count_collisions(s.events.begun, s.carriers.carriers, counted_from(models, s), s.collisions);
    if (computes_air(models, s) && models.two_way) {
      s.impulse_on_air.resize(s.carriers.carriers.size());
      for (std::size_t p = 0; p < s.impulse_on_air.size(); ++p) s.impulse_on_air[p] = -s.carriers.drag_impulse[p];
      add_field_reaction(interval.seconds, s);
    }
  }
  // The caller reads the air at `until`: with the forces of the walls as they belong to it.
  if (computes_air(models, s) && s.time + interval.seconds >= until * (1.0 - 1e-12)) lbm::settle_walls(s.drive, *s.air);
  s.time += interval.seconds;
  move_fines(models, interval.steps, interval.seconds, s);
  carry_fines(models, s.time >= until * (1.0 - 1e-12), s);  // the caller reads them at `until`
  if (s.carriers.carriers.size() > 0) remove_departed(models, s);
}

}  // namespace

void advance(const Models& models, double until, State& s) {
  const double old_dt = s.scale.dt;
  take_time_step(models, models.time_step.next(s.time, old_dt, s.step_factor), s);
  const Interval interval = interval_until(until, most_steps(models, s), old_dt, s);
  find_stencils(models, interval, s);
  if (computes_air(models, s)) step_air(models, interval.steps, interval.rescale, {}, s);
  follow_air(models, interval, until, s);
}

BorrowedAir::BorrowedAir(State& owner, State& borrower) : owner_(owner), borrower_(borrower) {
  if (&owner_ != &borrower_) std::swap(owner_.air, borrower_.air);
}
BorrowedAir::~BorrowedAir() {
  if (&owner_ != &borrower_) std::swap(owner_.air, borrower_.air);
}

void advance_together(std::span<Companion> all, double until) {
  State& owner = *all[0].state;
  const Models& flow = *all[0].models;
  const double old_dt = owner.scale.dt, dt = flow.time_step.next(owner.time, old_dt, owner.step_factor);
  const auto each = [&](auto work) {
    for (Companion& c : all) try {
        const BorrowedAir air(owner, *c.state);
        if (c.failure.empty()) work(*c.models, *c.state);
      } catch (const Diverged& e) {
        c.failure = e.what();
      }
  };
  int most = flow.steps_per_exchange_asleep;
  each([&](const Models& m, State& s) {
    take_time_step(m, dt, s);
    most = std::min(most, most_steps(m, s));
  });
  const Interval interval = interval_until(until, most, old_dt, owner);
  const double end = owner.time + interval.seconds;
  each([&](const Models& m, State& s) { find_stencils(m, interval, s); });
  step_air(flow, interval.steps, interval.rescale, all.subspan(1), owner);
  each([&](const Models& m, State& s) { follow_air(m, interval, until, s); });
  for (const Companion& c : all)
    if (!c.failure.empty()) c.state->time = end;
}

}  // namespace puffin::coupling
