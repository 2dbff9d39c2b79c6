// One exchange interval on one page. The order, and why it is
// this:
//   air steps     with the carriers' reaction of the interval before (explicit, as the air is 1,000 times faster)
//   interpolation of the air at the carriers' present places, through the same stencils that carried their reaction
//   carriers      over the same interval, drag semi-implicit; what drag gave them is what the air will lose next, and
//                 of those that rest the force that acts on them
//   fines         taken off by the contacts and the slip of this interval
//   transport     of the fines by the lattice's own fluxes, in steps of its own

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>

#include "coupling/advance_together.hpp"
#include "coupling/air_steps.hpp"
#include "coupling/averaged.hpp"
#include "coupling/carry_fines.hpp"
#include "coupling/divergence.hpp"
#include "coupling/exchange_interval.hpp"
#include "coupling/field_forces.hpp"
#include "coupling/find_loads.hpp"
#include "coupling/resting.hpp"
#include "coupling/state.hpp"
#include "coupling/stopwatch.hpp"
#include "dem/advance.hpp"
#include "dem/failure.hpp"
#include "dem/open_contacts.hpp"
#include "lbm/wall_schemes.hpp"

namespace puffin::coupling {

namespace {

/// Takes carriers out that have left through an opening on the way from where they were `before` the interval. One that
/// has left through a wall stays, wherever it goes: a failure, for Health to find.
void remove_departed(const Models& models, const std::vector<Vec3>& before, State& s) {
  dem::Carriers& c = s.carriers.carriers;
  std::vector<std::uint8_t> gone;
  std::vector<std::int64_t> emitted;
  for (std::size_t p = 0; p < c.size(); ++p) {
    if (c.rest[p] != dem::Rest::awake) continue;
    const auto triangle = models.walls->left_through(before[p], c.position[p]);
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
  dem::remove(gone, s.carriers);  // what they owe the air is still there, by their old places
}

/// The carriers' part. What their integration cannot go on with is a divergence, with the place where it happened.
void step_carriers(const Models& models, double interval, State& s) {
  const Stopwatch watch(s.effort.carriers);
  try {
    dem::advance(interval, models.carriers, *models.walls, s.loads, s.carriers, s.events);
  } catch (const dem::Failure& e) {
    const dem::Carriers& c = s.carriers.carriers;
    const auto p = static_cast<std::size_t>(std::find(c.id.begin(), c.id.end(), e.carrier()) - c.id.begin());
    // Where it was at the interval's start; without a lattice nobody keeps that.
    const Vec3 x = p < s.stencils_at.position.size() ? s.stencils_at.position[p] : c.position[p];
    char where[96] = "";
    if (x.allFinite()) std::snprintf(where, sizeof where, "; it was last at [%.5g, %.5g, %.5g] m", x[0], x[1], x[2]);
    diverge("%s%s. Likely causes: a contact too stiff for its step, or air that diverged around the carrier", e.what(),
            where);
  }
}

/// What one exchange interval is: its air steps, the change of the time step before them, its length [s].
struct Interval {
  int steps = 1;
  double rescale = 1.0, seconds = 0.0;
};

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
  if (s.carriers.carriers.size() == 0) {  // given now, and nobody is left to owe more
    s.impulse_on_air.clear();
    s.force_on_air.clear();
  }
  std::vector<int> all(s.carriers.carriers.size());
  for (std::size_t p = 0; p < all.size(); ++p) all[p] = static_cast<int>(p);
  s.stencils_at = {s.carriers.carriers.position, s.carriers.carriers.radius};
  s.stencils.build(s.cells, s.stencils_at.position, s.stencils_at.radius, all);
  if (computes_air(models, s)) follow_volume(models, interval.steps, s);
}

/// What the carriers owe the air for the last interval. One that moved returns the impulse that it got. One that rested
/// throughout got none that it could return: the air loses the force that its contacts (or whoever holds it) withstand,
/// for as long as it will rest, so that force is kept and not its impulse.
void owe_reaction(const std::vector<dem::Rest>& before, double interval, State& s) {
  const dem::Carriers& c = s.carriers.carriers;
  s.exchange_seconds = interval;
  s.impulse_on_air.assign(c.size(), Vec3::Zero());
  s.force_on_air.assign(c.size(), Vec3::Zero());
  for (std::size_t p = 0; p < c.size(); ++p) {
    const Vec3 aside = force_beside_drag(p, s);
    if (before[p] != dem::Rest::awake && rests(c, p))
      s.force_on_air[p] = -s.loads[p].drag * s.loads[p].air_velocity - aside;
    else
      s.impulse_on_air[p] = -s.carriers.drag_impulse[p] - interval * aside;
  }
}

/// Carriers and fines over the interval that the air has done.
void follow_air(const Models& models, const Interval& interval, double until, State& s) {
  s.events.clear();
  const std::vector<Vec3> before = s.carriers.carriers.position;
  if (s.carriers.carriers.size() > 0) {
    ++s.effort.exchanges;
    {
      const Stopwatch watch(s.effort.exchange);
      find_loads(models, interval.seconds, s);
    }
    const std::vector<dem::Rest> rest = s.carriers.carriers.rest;
    step_carriers(models, interval.seconds, s);
    s.first_motion.update(s.carriers.carriers, s.time + interval.seconds);
    count_collisions(s.events.begun, s.carriers.carriers, counted_from(models, s), s.collisions);
    if (computes_air(models, s) && models.two_way) owe_reaction(rest, interval.seconds, s);
  }
  // The caller reads the air at `until`: with the forces of the walls as they belong to it.
  if (computes_air(models, s) && s.time + interval.seconds >= until * (1.0 - 1e-12)) lbm::settle_walls(s.drive, *s.air);
  s.time += interval.seconds;
  move_fines(models, interval.steps, interval.seconds, s);
  carry_fines(models, s.time >= until * (1.0 - 1e-12), s);  // the caller reads them at `until`
  if (s.carriers.carriers.size() > 0) remove_departed(models, before, s);
}

/// Lets the carriers go when it is time; `until`, or before it that moment.
double let_go(const Models& models, double until, State& s) {
  if (s.carriers.carriers.size() == 0) return until;
  if (s.time < models.carriers_start * (1.0 - 1e-12)) return std::min(until, models.carriers_start);
  for (auto& rest : s.carriers.carriers.rest)
    if (rest == dem::Rest::held) rest = dem::Rest::awake;
  return until;
}

}  // namespace

void advance(const Models& models, double until, State& s) {
  until = let_go(models, until, s);
  const double old_dt = s.scale.dt;
  take_time_step(models, models.time_step.next(s.time, old_dt, s.step_factor), s);
  const Interval interval = interval_until(until, most_steps(models, s), old_dt, s);
  find_stencils(models, interval, s);
  if (computes_air(models, s)) step_air(models, interval.steps, interval.rescale, {}, s);
  follow_air(models, interval, until, s);
}

/// The air, what drives it, and what is booked of it and of its steps.
static void exchange_air(State& a, State& b) {
  if (&a == &b) return;
  std::swap(a.air, b.air);
  std::swap(a.drive, b.drive);
  std::swap(a.air_mass, b.air_mass);
  std::swap(a.extremes, b.extremes);
  std::swap(a.effort.air, b.effort.air);
  std::swap(a.effort.links, b.effort.links);
  std::swap(a.effort.steps_at_reference_dt, b.effort.steps_at_reference_dt);
}

BorrowedAir::BorrowedAir(State& owner, State& borrower) : owner_(owner), borrower_(borrower) {
  exchange_air(owner_, borrower_);
}
BorrowedAir::~BorrowedAir() { exchange_air(owner_, borrower_); }

void advance_together(std::span<Companion> all, double until) {
  State& owner = *all[0].state;
  const Models& flow = *all[0].models;
  const double old_dt = owner.scale.dt, dt = flow.time_step.next(owner.time, old_dt, owner.step_factor);
  const auto each = [&](auto work) {
    for (Companion& c : all) try {
        const BorrowedAir air(owner, *c.state);
        if (!c.failure) work(*c.models, *c.state);
      } catch (const std::exception&) {
        c.failure = std::current_exception();
      }
  };
  int most = flow.steps_per_exchange_asleep;
  each([&](const Models& m, State& s) {
    until = let_go(m, until, s);
    take_time_step(m, dt, s);
    most = std::min(most, most_steps(m, s));
  });
  const Interval interval = interval_until(until, most, old_dt, owner);
  const double end = owner.time + interval.seconds;
  each([&](const Models& m, State& s) { find_stencils(m, interval, s); });
  step_air(flow, interval.steps, interval.rescale, all.subspan(1), owner);
  each([&](const Models& m, State& s) { follow_air(m, interval, until, s); });
  for (const Companion& c : all)
    if (c.failure) c.state->time = end;
}

}  // namespace puffin::coupling
