#include "tools/puffin/stepping.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <stdexcept>

#include "coupling/air_steps.hpp"
#include "dem/failure.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/finished.hpp"
#include "tools/puffin/lattice_limits.hpp"
#include "tools/puffin/law_limits.hpp"
#include "tools/puffin/signals.hpp"

namespace puffin::tools {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int most_retreats = 3;
constexpr std::int64_t steps_between_memories = 500;  // air steps; see Stepping::steps
constexpr double patience = 10.0;                     // [s] with a step, of one who asked to stop

}  // namespace

static void fields(auto& archive, coupling::Is<RunMemory> auto& memory) {
  auto& [wall_clock, output, retreats, warnings] = memory;
  archive(wall_clock, output, retreats, warnings);
}

Stepping::Stepping(cases::Simulation& s, const output::OutputFolder& folder, bool quiet, Clock::time_point start,
                   double walltime, double until)
    : s_(s),
      folder_(folder),
      start_(start),
      walltime_(walltime),
      shortened_(until < s.description.stop.time),
      health_(s.models, s.state),
      store_(s, folder) {
  s.description.stop.time = std::min(s.description.stop.time, until);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow: its writer says so
  s.models.carriers.asked_to_stop = [this] { return wall_clock() - step_began_ > patience && shall_stop(); };
  if (folder.resumed()) {
    coupling::save(s.state, good_);  // its size, before anything moved, bounds what a checkpoint can be
    const std::size_t longest = 4 * good_.size() + (std::size_t{1} << 30);
    store_.restore_newest(longest, [&](const coupling::Checkpoint& checkpoint) {
      coupling::restore(checkpoint, s_.state);
      coupling::ByteReader reader(checkpoint.at("run"), "run");
      reader(memory_);
      reader.finish();
      const RecorderState outputs = restored(checkpoint.at("outputs"));
      recorder_ = std::make_unique<Recorder>(s_, folder_, &outputs);
    });
  } else {
    memory_.warnings = s.warnings;
    recorder_ = std::make_unique<Recorder>(s_, folder_);
  }
  progress_ = std::make_unique<Progress>(s, folder, quiet);
  checked_ = remembered_ = steps();
  remember(good_);
  if (!folder.resumed()) write_checkpoint(good_);
}

/// Air steps; steps of the carriers where there are no cells; where cells only carry fines through a frozen field, how
/// often everything was advanced.
std::int64_t Stepping::steps() const {
  if (coupling::computes_air(s_.models, s_.state)) return s_.state.air->steps;
  return s_.state.air ? advanced_ : s_.state.carriers.statistics.steps;
}

double Stepping::wall_clock() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void Stepping::step() {
  try {
    coupling::advance(s_.models, std::min(recorder_->next(), s_.description.stop.time), s_.state);
  } catch (const std::logic_error&) {  // a law that was asked about what is no number, before the next look
    health_.check(s_.models, s_.state);
    throw;
  }
  ++advanced_;
  health_.check_impacts(s_.models, s_.state);
  const auto writing = Clock::now();
  recorder_->take_events(s_);
  warn_beyond_laws(s_, memory_.warnings);
  recorder_->record(s_);
  progress_->update(*recorder_, memory_.warnings, false);
  output_seconds_ += std::chrono::duration<double>(Clock::now() - writing).count();
}

/// Health, memory and checkpoints. All of it at fixed numbers of steps, so that a retreat does not depend on the
/// clock.
void Stepping::look_after() {
  const bool lattice = coupling::computes_air(s_.models, s_.state);
  const std::int64_t next = lattice ? s_.models.steps_per_exchange_asleep : 1;  // more than one interval has
  if (!coupling::check_due(steps() - checked_, next)) return;
  health_.check(s_.models, s_.state);
  checked_ = steps();
  if (steps() - remembered_ < steps_between_memories) return;
  remember(good_);
  remembered_ = steps();
  if (store_.due()) write_checkpoint(good_);
}

void Stepping::remember(coupling::Checkpoint& checkpoint) const {
  coupling::save(s_.state, checkpoint);
  RunMemory now = memory_;
  now.wall_clock += wall_clock();
  now.output += output_seconds_;
  coupling::ByteWriter{checkpoint.renew("run")}(now);
  save(recorder_->state(), checkpoint.renew("outputs"));
}

void Stepping::write_checkpoint(coupling::Checkpoint& checkpoint) {
  const auto writing = Clock::now();
  recorder_->sync();
  store_.write(checkpoint);
  output_seconds_ += std::chrono::duration<double>(Clock::now() - writing).count();
}

/// The outputs as they were at the last good state.
void Stepping::reopen_outputs() {
  const RecorderState outputs = restored(good_.at("outputs"));
  recorder_.reset();  // its files are closed before they are cut
  recorder_ = std::make_unique<Recorder>(s_, folder_, &outputs);
  checked_ = remembered_ = steps();
}

/// By a signal or the wall time. Any thread may ask.
bool Stepping::shall_stop() const { return Signals::received() != 0 || wall_clock() > walltime_; }

Ending Stepping::stop() {
  write_checkpoint(good_);
  const int signal = Signals::received();
  return {"stopped",
          signal == SIGINT    ? "interrupted"
          : signal == SIGTERM ? "terminated"
                              : "wall time reached",
          signal == SIGINT ? interrupted : stopped};
}

bool Stepping::retreat(const std::string& why) {
  if (memory_.retreats >= most_retreats) return false;
  const double failed_at = s_.state.time;
  coupling::restore(good_, s_.state);
  forget_beyond_laws(s_.state.time, memory_.warnings);
  ++memory_.retreats;
  s_.state.step_factor = std::pow(0.5, memory_.retreats);
  char text[160];
  std::snprintf(text, sizeof text,
                "retreat %d of %d from t = %.6g s to %.6g s with 1/%d of the time step: ", memory_.retreats,
                most_retreats, failed_at, s_.state.time, 1 << memory_.retreats);
  memory_.warnings.push_back(text + why);
  progress_->finish();  // the line on the terminal ends
  log_warning(memory_.warnings.back());
  reopen_outputs();
  return true;
}

/// If the carriers took so long in the last step that the next may be given up, what comes before that is remembered.
void Stepping::get_ready() {
  const double spent = s_.state.effort.carriers;
  if (spent - spent_before_ > patience) {
    health_.check(s_.models, s_.state);
    remember(before_slow_);
  } else if (!before_slow_.sections.empty()) {
    before_slow_ = {};
  }
  spent_before_ = spent;
  step_began_ = wall_clock();
}

Ending Stepping::run() {
  const Signals signals;
  for (;;) try {
      recorder_->record(s_);
      while (!finished(s_)) {
        get_ready();
        step();
        // The step that --until cut short is none of the whole run: what goes on begins before it.
        if (shortened_ && at_stop_time(s_)) break;
        look_after();
        if (!shall_stop()) continue;
        health_.check(s_.models, s_.state);
        remember(good_);
        return stop();
      }
      health_.check(s_.models, s_.state);
      Ending ending;
      ending.goes_on = shortened_ && at_stop_time(s_);
      if (ending.goes_on) write_checkpoint(good_);
      return ending;
    } catch (const dem::Interrupted&) {  // within a step that takes long: what goes on begins before it
      if (!before_slow_.sections.empty()) good_ = before_slow_;
      coupling::restore(good_, s_.state);
      forget_beyond_laws(s_.state.time, memory_.warnings);
      reopen_outputs();
      return stop();
    } catch (const coupling::Diverged& e) {
      if (retreat(e.what())) continue;
      write_checkpoint(good_);
      return {"diverged", e.what(), diverged};
    }
}

void Stepping::finish(const Ending& ending) {
  const std::size_t told = memory_.warnings.size();
  if (ending.code == ok)
    for (const std::string& text : lattice_warnings(s_)) memory_.warnings.push_back(text);
  recorder_->finish(s_);
  progress_->update(*recorder_, memory_.warnings, true);
  progress_->finish();
  for (std::size_t n = told; n < memory_.warnings.size(); ++n) log_warning(memory_.warnings[n]);
}

void Stepping::close(const Ending& ending) {
  if (ending.code == ok && !ending.goes_on) recorder_->forget_journal();
}

}  // namespace puffin::tools
