#include "tools/puffin/rehearsal.hpp"

#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>
#include <xmmintrin.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "cases/build.hpp"
#include "tools/puffin/stored_field.hpp"

namespace puffin::tools {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Transport of one scalar over the bare lattice, a cell and step: 60 s over 58 s on L-Base quick (one core), where 45
/// % of the steps came after the first release. Each further scalar shares the stencil.
constexpr double transport_over_air = 60.0 / 58.0 / 0.45;
/// Section-mean inlet speed at which the first fines come loose: 22 m/s on L-Base (93 ms); between the speeds of first
/// motion and first emission that the thesis gives for both devices.
constexpr double release_speed = 20.0;  // [m/s]
/// Writing, bookkeeping and the release of fines: 4 % to 6 % of the measured runs.
constexpr double besides = 1.05;

/// Share of the air steps that come after time t.
double share_after(const coupling::TimeStepRule& rule, double t, double end) {
  double before = 0.0, all = 0.0;
  constexpr int samples = 400;
  for (int n = 0; n < samples; ++n) {
    const double at = (n + 0.5) / samples * end, steps = 1.0 / rule.wanted(at);
    all += steps;
    if (at < t) before += steps;
  }
  return 1.0 - before / all;
}

}  // namespace

Rehearsal rehearse(const cases::Case& c, double seconds) {
  _mm_setcsr(_mm_getcsr() | 0x8040);  // as the run does
  Rehearsal r;
  r.threads = c.numerics.threads > 0 ? c.numerics.threads : static_cast<int>(std::thread::hardware_concurrency());
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(r.threads));
  const auto start = Clock::now();
  const auto simulation = cases::build(c, read_stored_field);
  r.set_up = seconds_since(start);
  coupling::State& s = simulation->state;
  const auto advance = [&](double wall) {
    const auto begin = Clock::now();
    while (seconds_since(begin) < wall && s.time < c.stop.time) coupling::advance(simulation->models, c.stop.time, s);
  };
  advance(0.25 * seconds);
  const coupling::Effort warm = s.effort;
  const double warm_time = s.time;
  const auto warm_steps = s.air ? s.air->steps : 0;
  advance(0.75 * seconds);
  const coupling::Effort& e = s.effort;
  const double steps = s.air ? static_cast<double>(s.air->steps - warm_steps) : 0.0;
  const auto exchanges = static_cast<double>(e.exchanges - warm.exchanges);
  if (steps > 0.0) r.seconds_a_step = (e.air - warm.air + e.links - warm.links) / steps;
  if (exchanges > 0.0) {
    r.seconds_an_exchange = (e.exchange - warm.exchange) / exchanges;
    r.steps_an_exchange = std::max(1.0, steps / exchanges);
  }
  if (s.time > warm_time) r.carriers_a_second = (e.carriers - warm.carriers) / (s.time - warm_time);
  r.memory = peak_memory();
  return r;
}

RunTime run_time(const cases::Case& c, double steps, const Rehearsal& r) {
  const double air = steps * r.seconds_a_step;
  double carriers = 0.0, transport = 0.0;
  if (c.carriers) carriers = steps / r.steps_an_exchange * r.seconds_an_exchange + c.stop.time * r.carriers_a_second;
  if (c.fines && c.air.model == cases::AirModel::lbm) {
    const auto simulation_rule = cases::build(c, read_stored_field)->models.time_step;
    double released = 0.0;
    while (c.carriers && released < c.stop.time && simulation_rule.speed &&
           simulation_rule.speed(released) < release_speed)
      released += c.stop.time / 400.0;
    const double scalars = 0.7 + 0.3 * static_cast<double>(c.fines->scalars.size());
    transport = scalars * transport_over_air * 2.0 / 3.0 * air * share_after(simulation_rule, released, c.stop.time);
  }
  RunTime t;
  t.expected = r.set_up + besides * (air + carriers + transport);
  // Carriers leave early or pile up, fines come loose sooner or later; a loaded machine changes its mind in between.
  t.low = r.set_up + 0.9 * (air + 0.5 * carriers + 0.5 * transport);
  t.high = r.set_up + 1.25 * besides * (air + 1.5 * carriers + transport);
  return t;
}

}  // namespace puffin::tools
