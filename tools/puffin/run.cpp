// puffin run: builds the simulation, steps it, writes everything, makes the report.

#include "tools/puffin/run.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <xmmintrin.h>

#include <chrono>
#include <thread>

#include "cases/write_case.hpp"
#include "tools/output/report.hpp"
#include "tools/puffin/case_warnings.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/opening.hpp"
#include "tools/puffin/progress.hpp"
#include "tools/puffin/stepping.hpp"
#include "tools/puffin/summarize.hpp"
#include "tools/puffin/thread_limit.hpp"

namespace puffin::tools {

namespace {

/// Pictures and the page; a failure here is told and does not spoil the results.
void make_pictures_and_report(const std::filesystem::path& run, bool quiet) {
  try {
    output::write_whole(run / "report.html", output::make_report(run));
    if (!quiet) log_info("report: " + (run / "report.html").string());
  } catch (const std::exception& e) {
    log_warning(std::string("no report: ") + e.what());
  }
}

using Clock = std::chrono::steady_clock;

/// The run in its folder, whose log.txt is open.
int run_in(const output::OutputFolder& folder, const RunOptions& options, cases::Simulation& s, RunFacts& facts,
           Clock::time_point start) {
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  Stepping stepping(s, folder, options.quiet, start, options.walltime, options.until);
  const Ending ending = stepping.run();
  stepping.finish(ending);
  facts.state = ending.state;
  facts.message = ending.message;
  if (ending.goes_on) facts.until = options.until;
  facts.warnings = stepping.memory().warnings;
  facts.output = stepping.memory().output + stepping.output_seconds();
  facts.wall_clock = stepping.memory().wall_clock + seconds();
  const output::Summary summary = summarize(s, stepping.recorder(), facts);
  output::write_summary(folder.file("summary.json"), summary);
  close_status(folder, facts.state, stepping.recorder().history(), facts.wall_clock);
  stepping.close(ending);
  if (options.report && ending.code != stopped && ending.code != interrupted)
    make_pictures_and_report(folder.path(), options.quiet);
  if (ending.code == diverged) log_error(ending.message);
  if (ending.goes_on)
    log_info("ended at --until " + as_time(options.until) + "; --resume goes on to the stop time of the case");
  if (ending.code == stopped || ending.code == interrupted)
    log_info(ending.message + " at t = " + as_time(s.state.time) + "; --resume goes on from here");
  if (options.json) print(output::summary_json(summary));
  return ending.code;
}

/// The run on the threads of the arena that it is called in.
int run_here(const RunOptions& options, cases::Case c, int threads, Clock::time_point start) {
  const std::vector<std::string> doubts = assessment_warnings(c);
  const auto simulation = built(c, options.case_file, options.beds);
  cases::Simulation& s = *simulation;
  s.warnings = first_warnings(s);  // before there is a folder: it refuses places outside the fluid
  add_new(doubts, s.warnings);
  const double case_stop_time = stop_time_of(c, options.case_file, options.sets, options.preset);
  const auto out = options.out.empty() ? std::nullopt : std::optional(options.out);
  const output::OutputFolder folder(out, c.name, options.resume);
  announce(folder, c.name, std::min(c.stop.time, options.until));
  try {
    log_to_file(folder.file("log.txt"));
    for (const std::string& text : s.warnings) log_warning(text);
    if (options.resume && !folder.resumed())
      log_warning(folder.path().string() + " was killed before its first checkpoint: the run begins anew");
    keep_case(c, folder);
    log_beginning(s, threads, folder.path());
    RunFacts facts;
    facts.threads = threads;
    facts.preset = options.preset;
    facts.case_stop_time = case_stop_time;
    facts.set_up = std::chrono::duration<double>(Clock::now() - start).count();
    return run_in(folder, options, s, facts, start);
  } catch (const std::exception&) {
    close_failed(folder, {});
    throw;
  }
}

}  // namespace

int run_command(const RunOptions& options) {
  const auto start = Clock::now();
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush denormals: air at rest would otherwise compute with them
  set_up_log(options.quiet);
  cases::Case c = cases::read_case(options.case_file, options.sets, options.preset);
  const int wanted = options.threads > 0 ? options.threads : c.numerics.threads;
  const int threads = wanted > 0 ? wanted : static_cast<int>(std::thread::hardware_concurrency());
  require_threads(threads);
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
  // Left alone, oneTBB uses no more threads than there are processors, whatever was asked for.
  oneapi::tbb::task_arena arena(threads);
  return arena.execute([&] { return run_here(options, std::move(c), threads, start); });
}

}  // namespace puffin::tools
