#include "tools/puffin/rehearsal.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <sys/resource.h>
#include <unistd.h>
#include <xmmintrin.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "cases/build.hpp"
#include "cases/case_error.hpp"
#include "coupling/air_steps.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/available_memory.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/stepping.hpp"
#include "tools/puffin/stored_field.hpp"
#include "tools/puffin/thread_limit.hpp"

namespace puffin::tools {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Removed with everything in it, however the rehearsal ends.
class ScratchFolder {
 public:
  ScratchFolder() : path_(std::filesystem::temp_directory_path() / ("puffin-estimate-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(path_);
  }
  ~ScratchFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A trace in every cell: where there are none the transport would have nothing to do.
void fill_air_with_fines(coupling::State& s) {
  constexpr double trace = 1e-6;  // fines a cell
  if (!s.air || s.scalars.scalars() == 0) return;
  for (auto& amount : s.scalars.amount)
    for (const auto& run : s.air->rows.runs())
      for (int n = 0; n < run.count; ++n) amount[run.first + n] += trace;
  // Nobody's release, as a cloud that the case puts there: the ledger knows of it.
  for (double& placed : s.fines.placed)
    placed += coupling::mechanisms * trace * static_cast<double>(s.air->rows.active_cells());
  s.airborne = true;
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Part of the air steps that come before the flow reaches `part` of its largest value. The step follows the flow, so
/// that their number goes with the integral of the flow over time; a fixed step goes with the time itself.
double steps_before(const cases::Simulation& s, double part, double end) {
  const auto& rule = s.models.time_step;
  if (!rule.follow || !rule.speed) return 0.0;
  constexpr int samples = 400;
  double largest = 0.0, all = 0.0, before = 0.0;
  for (int n = 0; n < samples; ++n) largest = std::max(largest, rule.speed((n + 0.5) / samples * end));
  bool reached = false;
  for (int n = 0; n < samples; ++n) {
    const double t = (n + 0.5) / samples * end;
    reached = reached || rule.speed(t) >= part * largest;
    all += 1.0 / rule.wanted(t);
    if (!reached) before += 1.0 / rule.wanted(t);
  }
  return before / all;
}

/// As a run builds it; what does not fit together is a mistake of the case.
std::unique_ptr<cases::Simulation> built(const cases::Case& c) try {
  return cases::build(c, read_stored_field, available_memory());
} catch (const std::invalid_argument& e) {
  throw cases::CaseError({{c.name, 0, 0, "", e.what()}});
}

}  // namespace

Rehearsal rehearse(const cases::Case& c, double seconds) {
  Rehearsal r;
  r.threads = c.numerics.threads > 0 ? c.numerics.threads : oneapi::tbb::info::default_concurrency();
  require_threads(r.threads);
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(r.threads));
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush denormals, as a run does
  const Clock::time_point begin = Clock::now();
  const auto simulation = built(c);
  cases::Simulation& s = *simulation;
  fill_air_with_fines(s.state);
  const ScratchFolder scratch;
  const output::OutputFolder folder(scratch.path(), c.name);
  Stepping stepping(s, folder, true, begin, seconds + seconds_since(begin), c.stop.time);
  r.set_up = seconds_since(begin);
  const Clock::time_point start = Clock::now();
  const Ending ending = stepping.run();
  const double gone = seconds_since(start);
  const double stepped_output = stepping.output_seconds();
  // The end of a run takes memory of its own: events.h5, wall maps. Said to be stopped, as nothing is to be warned of.
  const Clock::time_point last = Clock::now();
  stepping.finish({"stopped", "", stopped});
  r.finish = seconds_since(last);
  r.ended = ending.code == ok;
  if (!r.ended && ending.code != stopped) {
    r.failure = ending.message;
    r.failure_code = ending.code;
  }
  r.step_factor = s.state.step_factor;
  r.run_seconds = seconds_since(begin);
  const auto& e = s.state.effort;
  r.time = s.state.time;
  r.steps = coupling::computes_air(s.models, s.state) ? s.state.air->steps : s.state.carriers.statistics.steps;
  r.units = r.steps == 0 && r.time > 0.0 ? 1.0 : static_cast<double>(r.steps);
  if (r.units > 0.0) {
    const double steps = r.units;
    r.air = (e.air + e.links) / steps;
    r.carriers = (e.exchange + e.carriers + e.fines) / steps;
    r.transport = e.scalars / steps;
    r.rest =
        std::max(0.0, gone - e.air - e.links - e.exchange - e.carriers - e.fines - e.scalars - stepped_output) / steps;
  }
  for (const RepeatedOutput& kind : stepping.recorder().repeated())
    if (kind.times > 0)
      r.outputs += kind.seconds / static_cast<double>(kind.times) * (1.0 + std::floor(c.stop.time / kind.interval));
  r.at_rest = steps_before(s, 1.0 / 3.0, c.stop.time);
  if (s.state.air) r.dx = s.dx;
  r.dt = s.state.scale.dt;
  if (s.state.air) r.active = static_cast<std::int64_t>(s.state.air->rows.active_cells());
  r.memory = peak_memory();
  return r;
}

Forecast forecast(const cases::Case& c, const Rehearsal& r, double steps) {
  if (r.ended) return {r.run_seconds, 0.75 * r.run_seconds, 1.25 * r.run_seconds};
  const double always = r.set_up + r.outputs + r.finish + steps * (r.air + r.rest);
  const double busy = steps * (r.carriers + r.transport);
  Forecast f;
  f.seconds = always + (1.0 - r.at_rest) * busy;
  f.high = 1.25 * (always + busy);
  f.low = 0.75 * (c.stop.when_empty && c.carriers ? 0.6 : 1.0) * f.seconds;
  return f;
}

}  // namespace puffin::tools
