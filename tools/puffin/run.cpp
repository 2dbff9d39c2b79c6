// puffin run: builds the simulation, steps it, writes everything, makes the report.

#include "tools/puffin/run.hpp"

#include <oneapi/tbb/global_control.h>
#include <unistd.h>
#include <xmmintrin.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <thread>

#include "cases/write_case.hpp"
#include "tools/output/render.hpp"
#include "tools/output/report.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/stored_field.hpp"
#include "tools/puffin/summarize.hpp"

namespace puffin::tools {

namespace {

volatile std::sig_atomic_t received_signal = 0;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Shows how far the run is: a line that is rewritten on a terminal, plain lines elsewhere.
class Progress {
 public:
  Progress(const cases::Simulation& s, const output::OutputFolder& folder, double end, bool quiet)
      : sim_(s), folder_(folder), end_(end), quiet_(quiet), terminal_(isatty(STDERR_FILENO)), start_(Clock::now()) {}

  void update(const Recorder& recorder, bool now) {
    const double wall = seconds_since(start_);
    if (!now && wall - last_ < (terminal_ ? 0.5 : 10.0)) return;
    last_ = wall;
    const auto& state = sim_.state;
    output::Status status;
    status.name = sim_.description.name;
    status.state = "running";
    status.phase = phase();
    status.simulated_time = state.time;
    status.end_time = end_;
    status.wall_clock = wall;
    if (state.air) {
      status.steps = state.air->steps;
      const double busy = state.effort.air + state.effort.links;
      if (busy > 0.0)
        status.mlups =
            1e-6 * static_cast<double>(state.air->rows.active_cells()) * static_cast<double>(status.steps) / busy;
    }
    // Air steps, not simulated time, are what costs: in a ramp the end is dearer than the beginning.
    const double done = work(state.time), all = work(end_);
    if (done > 0.0) status.eta = wall * (all - done) / done;
    if (!recorder.history().empty() && sim_.description.fines)
      status.ledger_error = recorder.history().back().ledger_error;
    output::write_status(folder_.file("status.json"), status);
    if (quiet_) return;
    char line[240];
    std::snprintf(line, sizeof line, "%-9s %7.2f of %.0f ms  %5.1f %%  %6.1f MLUPS  ETA %4.0f s  ledger %.1e",
                  status.phase.c_str(), 1e3 * state.time, 1e3 * end_, all > 0.0 ? 100.0 * done / all : 0.0,
                  status.mlups, status.eta.value_or(0.0), status.ledger_error.value_or(0.0));
    std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line);
    std::fflush(stderr);
  }
  void finish() const {
    if (!quiet_ && terminal_) std::fprintf(stderr, "\n");
  }

 private:
  const char* phase() const {
    const auto& s = sim_.state;
    if (s.carriers.carriers.size() == 0) return s.departures.empty() ? "air" : "clearing";
    if (!s.first_motion.time()) return "lift-off";
    return s.departures.empty() ? "flight" : "emission";
  }
  /// Number of air steps until t, in arbitrary units.
  double work(double t) const {
    const auto& rule = sim_.models.time_step;
    if (!rule.follow) return t;
    double sum = 0.0;
    constexpr int samples = 64;
    for (int n = 0; n < samples; ++n) sum += t / samples / rule.wanted((n + 0.5) / samples * t);
    return sum;
  }

  const cases::Simulation& sim_;
  const output::OutputFolder& folder_;
  double end_;
  bool quiet_, terminal_;
  Clock::time_point start_;
  double last_ = -1e9;
};

bool is_empty(const cases::Simulation& s) {
  if (!s.description.stop.when_empty || !s.description.carriers) return false;
  if (s.state.carriers.carriers.size() > 0) return false;
  if (s.state.scalars.scalars() == 0) return true;
  const auto ledger = coupling::ledger(s.state.fines, s.state.scalars, s.state.budget, 0);
  return ledger.in_air < 1e-6 * ledger.loaded;
}

/// Pictures and the page; a failure here is told and does not spoil the results.
void make_pictures_and_report(const std::filesystem::path& run, bool quiet) {
  try {
    output::write_whole(run / "report.html", output::make_report(run));
    if (!quiet) log_info("report: " + (run / "report.html").string());
  } catch (const std::exception& e) {
    log_warning(std::string("no report: ") + e.what());
  }
}

}  // namespace

int run_command(const RunOptions& options) {
  if (options.resume)
    throw UsageError("--resume: this version writes no checkpoints, so there is nothing to resume from");
  const auto start = Clock::now();
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush denormals: air at rest would otherwise compute with them
  set_up_log(options.quiet);
  cases::Case c = cases::read_case(options.case_file, options.sets, options.preset);
  c.stop.time = std::min(c.stop.time, options.until);
  const int wanted = options.threads > 0 ? options.threads : c.numerics.threads;
  const int threads = wanted > 0 ? wanted : static_cast<int>(std::thread::hardware_concurrency());
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
  const auto simulation = cases::build(c, read_stored_field);
  cases::Simulation& s = *simulation;
  PointReader(s).check_places(s);
  const output::OutputFolder folder(options.out.empty() ? std::nullopt : std::optional(options.out), c.name);
  folder.write_text("case.toml", cases::write_resolved(c));
  if (!options.quiet && s.state.air)
    log_info(c.name + ": " + std::to_string(s.state.air->rows.active_cells()) + " cells of " + as_length(s.dx) + ", " +
             std::to_string(threads) + " threads, " + lbm::name(lbm::detect_isa()) + "; output in " +
             folder.path().string());
  Recorder recorder(s, folder);
  RunFacts facts;
  facts.threads = threads;
  facts.set_up = seconds_since(start);

  received_signal = 0;
  const auto previous_term = std::signal(SIGTERM, [](int n) { received_signal = n; });
  const auto previous_int = std::signal(SIGINT, [](int n) { received_signal = n; });
  Progress progress(s, folder, c.stop.time, options.quiet);
  int code = ok;
  facts.state = "finished";
  try {
    recorder.record(s);
    while (s.state.time < c.stop.time * (1.0 - 1e-12) && !is_empty(s)) {
      coupling::advance(s.models, std::min(recorder.next(), c.stop.time), s.state);
      const auto writing = Clock::now();
      recorder.take_events(s);
      recorder.record(s);
      progress.update(recorder, false);
      facts.output += seconds_since(writing);
      if (received_signal != 0 || seconds_since(start) > options.walltime) {
        facts.state = "stopped";
        facts.message = received_signal == SIGINT    ? "interrupted"
                        : received_signal == SIGTERM ? "terminated"
                                                     : "wall time reached";
        code = received_signal == SIGINT ? interrupted : stopped;
        break;
      }
    }
  } catch (const coupling::Diverged& e) {
    facts.state = "diverged";
    facts.message = e.what();
    code = diverged;
  }
  std::signal(SIGTERM, previous_term);
  std::signal(SIGINT, previous_int);
  const auto writing = Clock::now();
  recorder.finish(s);
  progress.update(recorder, true);
  progress.finish();
  facts.output += seconds_since(writing);
  facts.wall_clock = seconds_since(start);
  const output::Summary summary = summarize(s, recorder, facts);
  output::write_summary(folder.file("summary.json"), summary);
  output::Status last = output::read_status(folder.file("status.json"));
  last.state = facts.state;
  output::write_status(folder.file("status.json"), last);
  if (options.report) make_pictures_and_report(folder.path(), options.quiet);
  if (code == diverged) log_error(facts.message);
  if (options.json) print(output::summary_json(summary));
  return code;
}

}  // namespace puffin::tools
