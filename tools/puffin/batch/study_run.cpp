#include "tools/puffin/batch/study_run.hpp"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>

#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"
#include "tools/puffin/batch/pool.hpp"
#include "tools/puffin/batch/program_calls.hpp"
#include "tools/puffin/batch/slurm.hpp"
#include "tools/puffin/checkpoint_store.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/signals.hpp"

namespace puffin::tools {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr int killed_by = 128;  // and the signal's number: Child::ended
struct Running {
  std::size_t job;
  std::vector<std::size_t> group;  // that run in its process, itself included
  Child child;
  Clock::time_point start;
};

class Batch {
 public:
  Batch(const BatchOptions& options, const cases::Study& study, const Jobs& plan, Book& book)
      : options_(options), study_(study), plan_(plan), book_(book), start_(Clock::now()) {
    cores_ =
        options.threads > 0 ? options.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    places_ = options.jobs > 0 ? options.jobs : cores_;
  }
  int run() {
    try {
      sort_out();
      book_.write();
      options_.slurm ? run_with_slurm() : run_here();
      book_.write();
    } catch (const std::exception&) {  // the page must not wait for ever
      live_state_ = "failed";
      live(true);
      throw;
    }
    const int code = exit_code();
    live_state_ = code == ok ? "finished" : code == batch_failed ? "failed" : "stopped";
    live(true);
    return code;
  }

 private:
  void run_here() {
    while (!(running_.empty() && (waiting_.empty() || Signals::received() != 0))) {
      while (Signals::received() == 0 && !waiting_.empty() && static_cast<int>(running_.size()) < places_) start_next();
      if (Signals::received() != 0 && !told_) tell_to_stop();
      collect();
      live(false);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  /// An array still in the queue from an earlier call is watched. Then all that waits goes out as one.
  void run_with_slurm() {
    std::vector<std::string> names;
    for (const Job& job : plan_.jobs) names.push_back(job.id);
    SlurmArray array(book_.folder(), names);
    if (array.queued()) watch(array);
    std::erase_if(waiting_, [&](std::size_t n) { return book_.record(n).state != JobState::waiting; });
    if (Signals::received() != 0 || waiting_.empty()) return;
    std::vector<SlurmTask> tasks;
    const int threads = std::max(1, options_.threads);
    for (const std::size_t n : waiting_) {
      const std::vector<std::size_t> group = group_of(n);
      for (const std::size_t m : group) {
        std::filesystem::create_directories(book_.run_folder(m));
        book_.record(m).threads = threads;
      }
      if (std::none_of(tasks.begin(), tasks.end(), [&](const SlurmTask& t) { return group_of(t.job) == group; }))
        tasks.push_back({n, arguments_of(group, threads), book_.log_file(n)});
    }
    array.submit(study_.file.stem().string(), tasks, threads, options_.jobs);
    watch(array);
  }

  void watch(SlurmArray& array) {
    if (!options_.quiet) log_info("Slurm job " + array.id() + ": " + std::to_string(array.open().size()) + " runs");
    for (const std::size_t n : array.open())
      for (const std::size_t m : group_of(n)) book_.record(m).state = JobState::waiting;
    while (Signals::received() == 0 && !array.open().empty()) {
      for (const SlurmArray::Change& change : array.poll()) {
        for (const std::size_t n : group_of(change.job)) {
          JobRecord& r = book_.record(n);
          if (change.ended) {
            book_end(n, change.job, change.exit_code);
          } else if (r.state != JobState::running) {
            r.state = JobState::running;
            ++r.attempts;
          }
        }
        book_.write();
      }
      live(false);
      for (int n = 0; n < 20 && Signals::received() == 0; ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    if (Signals::received() == 0) return;
    for (const std::size_t n : array.open())
      for (const std::size_t m : group_of(n)) book_.record(m).state = JobState::stopped;
    log_warning("Slurm job " + array.id() + " goes on; the same command watches it again, 'scancel " + array.id() +
                "' ends it");
  }

  bool wanted(const Job& job) const { return is_named(study_, job, options_.only); }

  /// Which runs are to do; the dearest first, so that no long one is left alone at the end.
  void sort_out() {
    for (std::size_t n = 0; n < plan_.jobs.size(); ++n) {
      JobRecord& r = book_.record(n);
      if (!wanted(plan_.jobs[n])) continue;
      if (!plan_.jobs[n].problem.empty()) {
        fail(n, case_invalid, plan_.jobs[n].problem);
        std::filesystem::create_directories(book_.run_folder(n));
        std::ofstream(book_.log_file(n), std::ios::app) << plan_.jobs[n].problem << '\n';
        continue;
      }
      if (book_.set_damaged_aside(n)) r = {};
      if (book_.finished(n)) {
        r.state = JobState::done;
        r.exit_code = ok;
        r.message.clear();
        incomplete_ = !complete(n, study_, plan_, book_) || incomplete_;
        continue;
      }
      if (r.state == JobState::failed && !options_.retry_failed) {
        log_warning(plan_.jobs[n].id + " failed before (" + r.message + "); --retry-failed tries it again");
        continue;
      }
      const bool useless = r.exit_code == diverged || cannot_go_on(r.message) || !book_.resumable(n);
      if (r.state == JobState::failed && useless) book_.move_aside(n);
      r.state = JobState::waiting;
      waiting_.push_back(n);
    }
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [&](std::size_t a, std::size_t b) { return plan_.jobs[a].cost > plan_.jobs[b].cost; });
  }

  /// The jobs that are not done and run in one process with this one, itself included, in the order of the plan. One
  /// with a checkpoint goes on alone.
  std::vector<std::size_t> group_of(std::size_t n) const {
    if (plan_.jobs[n].flow.empty() || book_.resumable(n)) return {n};
    std::vector<std::size_t> group;
    for (std::size_t m = 0; m < plan_.jobs.size(); ++m) {
      const JobState state = book_.record(m).state;
      const bool now = m == n || std::find(waiting_.begin(), waiting_.end(), m) != waiting_.end() ||
                       state == JobState::running || state == JobState::stopped;
      if (plan_.jobs[m].flow == plan_.jobs[n].flow && now && wanted(plan_.jobs[m]) && state != JobState::done &&
          !book_.resumable(m))
        group.push_back(m);
    }
    return group;
  }

  std::vector<std::string> arguments_of(const std::vector<std::size_t>& group, int threads) const {
    return run_arguments(group, threads, options_.preset, plan_, book_);
  }

  void start_next() {
    const std::size_t n = waiting_.front();
    int used = 0;
    for (const Running& r : running_) used += book_.record(r.job).threads;
    int waiting = 0;  // processes; a group is one
    for (const std::size_t m : waiting_) waiting += group_of(m).front() == m;
    const int threads = threads_for_next(cores_ - used, places_ - static_cast<int>(running_.size()), waiting);
    const std::vector<std::size_t> group = group_of(n);
    const std::vector<std::string> arguments = arguments_of(group, threads);
    for (const std::size_t m : group) {
      std::erase(waiting_, m);
      std::filesystem::create_directories(book_.run_folder(m));
      JobRecord& r = book_.record(m);
      if (r.attempts > 0) book_.wait_until_free(m);
      r.state = JobState::running;
      r.threads = m == n ? threads : 0;  // the cores of a group are counted once
      r.message.clear();
      ++r.attempts;
      if (!options_.quiet)
        log_info(plan_.jobs[m].id + (m == n ? ": starts on " + std::to_string(threads) + " threads"
                                            : ": runs in the flow of " + plan_.jobs[n].id));
    }
    running_.push_back({n, group, Child(arguments, book_.log_file(n)), Clock::now()});
    book_.write();
  }

  void collect() {
    for (std::size_t k = 0; k < running_.size();) {
      const std::optional<int> code = running_[k].child.ended();
      if (!code) {
        ++k;
        continue;
      }
      const std::vector<std::size_t> group = running_[k].group;
      const std::size_t starter = running_[k].job;
      for (const std::size_t n : group) book_.record(n).seconds = seconds_since(running_[k].start);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(k));
      for (const std::size_t n : group) book_end(n, starter, *code);
      book_.write();
    }
  }

  /// The end of the process of `starter` for a run in it. One that was of another case than the study had when the
  /// batch began, since a file was edited meanwhile, fails alone.
  void book_end(std::size_t n, std::size_t starter, int code) {
    try {
      ended(n, own_code(n, starter, code, plan_, book_));
    } catch (const output::OutputError& e) {
      fail(n, input_output, e.what());
    }
  }

  void ended(std::size_t n, int code) {
    JobRecord& r = book_.record(n);
    r.exit_code = code;
    if (code == ok && book_.finished(n)) {
      r.state = JobState::done;
      incomplete_ = !complete(n, study_, plan_, book_) || incomplete_;
      if (options_.slurm) r.seconds = output::read_summary(book_.run_folder(n) / "summary.json").wall_clock;
      if (!options_.quiet) log_info(plan_.jobs[n].id + ": done in " + as_time(r.seconds));
    } else if (code == stopped || code == interrupted || ((told_ || options_.slurm) && code == killed_by + SIGTERM)) {
      r.state = JobState::stopped;
      log_warning(plan_.jobs[n].id + ": stopped; the same command goes on with it");
    } else {
      fail(n, code == ok ? internal_error : code,
           code > killed_by ? "ended by signal " + std::to_string(code - killed_by) + " (" +
                                  strsignal(code - killed_by) + "); the same command with --retry-failed tries it again"
                            : last_line(book_.log_file(n)));
    }
  }

  void fail(std::size_t n, int code, const std::string& why) {
    JobRecord& r = book_.record(n);
    r.state = JobState::failed;
    r.exit_code = code;
    r.message = why;
    log_error(plan_.jobs[n].id + " failed with exit code " + std::to_string(code) + ": " + why);
  }

  void tell_to_stop() {
    told_ = true;
    log_warning("stopping: " + std::to_string(running_.size()) + " runs write a checkpoint; the same command goes on");
    for (const Running& r : running_) r.child.terminate();
  }

  void live(bool now) {
    const double wall = seconds_since(start_);
    if (!now && wall - last_live_ < 1.0) return;
    last_live_ = wall;
    book_.write_live(live_state_, wall);
  }

  int exit_code() const {
    bool failed = false, unfinished = false;
    for (std::size_t n = 0; n < plan_.jobs.size(); ++n) {
      if (!wanted(plan_.jobs[n])) continue;
      failed = failed || book_.record(n).state == JobState::failed;
      unfinished = unfinished || book_.record(n).state == JobState::stopped;
    }
    if (Signals::received() == SIGINT) return interrupted;
    if (Signals::received() == SIGTERM || (unfinished && !failed)) return stopped;
    return failed || incomplete_ ? batch_failed : ok;
  }

  const BatchOptions& options_;
  const cases::Study& study_;
  const Jobs& plan_;
  Book& book_;
  Clock::time_point start_;
  int cores_ = 1, places_ = 1;
  std::vector<std::size_t> waiting_;
  std::vector<Running> running_;
  bool told_ = false, incomplete_ = false;  // incomplete: a case that shares a run has no results
  double last_live_ = -1e9;
  std::string live_state_ = "running";
};

}  // namespace

int run_jobs(const BatchOptions& options, const cases::Study& study, const Jobs& plan, Book& book) {
  const Signals signals;
  return Batch(options, study, plan, book).run();
}

}  // namespace puffin::tools
