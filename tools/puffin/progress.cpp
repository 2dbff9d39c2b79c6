#include "tools/puffin/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "tools/output/report/live_page.hpp"

namespace puffin::tools {

using Clock = std::chrono::steady_clock;

Progress::Progress(const cases::Simulation& s, const output::OutputFolder& folder, bool quiet)
    : sim_(s),
      folder_(folder),
      end_(s.description.stop.time),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO)),
      start_(Clock::now()),
      begun_at_(work(s.state.time)) {}

void Progress::update(const Recorder& recorder, const std::vector<std::string>& warnings, bool now) {
  const double wall = std::chrono::duration<double>(Clock::now() - start_).count();
  if (!now && wall - last_ < (terminal_ ? 0.5 : 1.0)) return;
  last_ = wall;
  const auto& state = sim_.state;
  output::Status status;
  status.name = sim_.description.name;
  status.state = "running";
  status.phase = phase();
  status.simulated_time = state.time;
  status.end_time = end_;
  status.wall_clock = wall;
  status.warnings = warnings;
  if (state.air_mass.cells > 0) status.air_lost = state.air_mass.lost_share();
  if (state.air) {
    status.steps = state.air->steps;
    const double busy = state.effort.air + state.effort.links;
    if (busy > 0.0)
      status.mlups = 1e-6 * static_cast<double>(state.air->fluid_cells) * static_cast<double>(status.steps) / busy;
  }
  // Air steps, not simulated time, are what costs: in a ramp the end is dearer than the beginning.
  const double done = work(state.time), all = work(end_);
  if (done > begun_at_) status.eta = std::max(0.0, wall * (all - done) / (done - begun_at_));
  if (!recorder.history().empty() && sim_.description.fines)
    status.ledger_error = recorder.history().back().ledger_error;
  output::write_status(folder_.file("status.json"), status);
  if (now || wall - last_page_ >= 3.0) {
    last_page_ = wall;
    output::write_whole(folder_.file("index.html"), output::live_page(status, recorder.history()));
  }
  if (quiet_ || (!terminal_ && !now && wall - last_line_ < 10.0)) return;
  last_line_ = wall;
  char line[240];
  std::snprintf(line, sizeof line, "%-9s %7.2f of %.4g ms  %5.1f %%  %6.1f MLUPS  ETA %4.0f s  ledger %.1e",
                status.phase.c_str(), 1e3 * state.time, 1e3 * end_, all > 0.0 ? 100.0 * done / all : 0.0, status.mlups,
                status.eta.value_or(0.0), status.ledger_error.value_or(0.0));
  std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line);
  std::fflush(stderr);
}

void Progress::finish() const {
  if (!quiet_ && terminal_) std::fprintf(stderr, "\n");
}

const char* Progress::phase() const {
  const auto& s = sim_.state;
  if (s.carriers.carriers.size() == 0) return s.departures.empty() ? "air" : "clearing";
  if (!s.first_motion.time()) return "lift-off";
  return s.departures.empty() ? "flight" : "emission";
}

/// Number of air steps until t, in arbitrary units.
double Progress::work(double t) const {
  const auto& rule = sim_.models.time_step;
  if (!rule.follow) return t;
  double sum = 0.0;
  constexpr int samples = 64;
  for (int n = 0; n < samples; ++n) sum += t / samples / rule.wanted((n + 0.5) / samples * t);
  return sum;
}

void announce(const output::OutputFolder& folder, const std::string& name, double end_time) {
  output::Status status;
  status.name = name;
  status.state = "running";
  status.phase = "set-up";
  status.end_time = end_time;
  output::write_status(folder.file("status.json"), status);
}

void close_status(const output::OutputFolder& folder, const std::string& state,
                  const std::vector<output::HistoryRow>& history, double wall_clock) {
  output::Status last = output::read_status(folder.file("status.json"));
  last.state = state;
  if (wall_clock > 0.0) last.wall_clock = wall_clock;
  if (state == "finished") last.eta = 0.0;
  output::write_status(folder.file("status.json"), last);
  output::write_whole(folder.file("index.html"), output::live_page(last, history));
}

void close_failed(const output::OutputFolder& folder, const std::vector<output::HistoryRow>& history) noexcept try {
  if (output::read_status(folder.file("status.json")).state == "running") close_status(folder, "failed", history);
} catch (const std::exception&) {  // what ended the run is told by whoever caught it
}

}  // namespace puffin::tools
