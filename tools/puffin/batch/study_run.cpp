#include "tools/puffin/batch/study_run.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <thread>

#include "tools/puffin/batch/pool.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

volatile std::sig_atomic_t received = 0;

/// The last line that is not empty.
std::string last_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string last;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) last = line;
  return last.substr(0, 400);
}

struct Running {
  std::size_t job;
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
    sort_out();
    book_.write();
    while (!(running_.empty() && (waiting_.empty() || received != 0))) {
      while (received == 0 && !waiting_.empty() && static_cast<int>(running_.size()) < places_) start_next();
      if (received != 0 && !told_) tell_to_stop();
      collect();
      live(false);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    book_.write();
    const int code = exit_code();
    live_state_ = code == ok ? "finished" : code == batch_failed ? "failed" : "stopped";
    live(true);
    return code;
  }

 private:
  bool wanted(const Job& job) const {
    return options_.only.empty() || std::any_of(job.members.begin(), job.members.end(), [&](const Member& m) {
             return fnmatch(options_.only.c_str(), study_.cases[m.which].name.c_str(), 0) == 0;
           });
  }

  /// Which runs are to do; the dearest first, so that no long one is left alone at the end.
  void sort_out() {
    for (std::size_t n = 0; n < plan_.jobs.size(); ++n) {
      JobRecord& r = book_.record(n);
      if (!wanted(plan_.jobs[n])) continue;
      if (!plan_.jobs[n].problem.empty()) {
        fail(n, case_invalid, plan_.jobs[n].problem);
        continue;
      }
      if (book_.finished(n)) {
        r.state = JobState::done;
        r.exit_code = ok;
        r.message.clear();
        continue;
      }
      if (r.state == JobState::failed && !options_.retry_failed) {
        log_warning(plan_.jobs[n].id + " failed before (" + r.message + "); --retry-failed tries it again");
        continue;
      }
      if (r.state == JobState::failed && (r.exit_code == diverged || !book_.resumable(n))) book_.move_aside(n);
      r.state = JobState::waiting;
      waiting_.push_back(n);
    }
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [&](std::size_t a, std::size_t b) { return plan_.jobs[a].cost > plan_.jobs[b].cost; });
  }

  void start_next() {
    const std::size_t n = waiting_.front();
    int used = 0;
    for (const Running& r : running_) used += book_.record(r.job).threads;
    const int threads =
        threads_for_next(cores_ - used, places_ - static_cast<int>(running_.size()), static_cast<int>(waiting_.size()));
    waiting_.erase(waiting_.begin());
    const Job& job = plan_.jobs[n];
    std::vector<std::string> arguments{"run",       job.base.string(),      "--out", book_.run_folder(n).string(),
                                       "--threads", std::to_string(threads)};
    if (!options_.preset.empty()) arguments.insert(arguments.end(), {"--preset", options_.preset});
    for (const cases::Override& o : job.sets) arguments.insert(arguments.end(), {"--set", o.key + "=" + o.value});
    if (book_.resumable(n)) arguments.emplace_back("--resume");
    std::filesystem::create_directories(book_.run_folder(n));
    JobRecord& r = book_.record(n);
    r.state = JobState::running;
    r.threads = threads;
    r.message.clear();
    ++r.attempts;
    if (!options_.quiet) log_info(job.id + ": starts on " + std::to_string(threads) + " threads");
    running_.push_back({n, Child(arguments, book_.log_file(n)), Clock::now()});
    book_.write();
  }

  void collect() {
    for (std::size_t k = 0; k < running_.size();) {
      const std::optional<int> code = running_[k].child.ended();
      if (!code) {
        ++k;
        continue;
      }
      const std::size_t n = running_[k].job;
      book_.record(n).seconds = seconds_since(running_[k].start);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(k));
      ended(n, *code);
      book_.write();
    }
  }

  void ended(std::size_t n, int code) {
    JobRecord& r = book_.record(n);
    r.exit_code = code;
    if (code == ok && book_.finished(n)) {
      r.state = JobState::done;
      if (!options_.quiet) log_info(plan_.jobs[n].id + ": done in " + as_time(r.seconds));
    } else if (code == stopped || code == interrupted) {
      r.state = JobState::stopped;
      log_warning(plan_.jobs[n].id + ": stopped; the same command goes on with it");
    } else {
      fail(n, code == ok ? internal_error : code, last_line(book_.log_file(n)));
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
    if (received == SIGINT) return interrupted;
    if (received == SIGTERM || (unfinished && !failed)) return stopped;
    return failed ? batch_failed : ok;
  }

  const BatchOptions& options_;
  const cases::Study& study_;
  const Jobs& plan_;
  Book& book_;
  Clock::time_point start_;
  int cores_ = 1, places_ = 1;
  std::vector<std::size_t> waiting_;
  std::vector<Running> running_;
  bool told_ = false;
  double last_live_ = -1e9;
  std::string live_state_ = "running";
};

}  // namespace

int run_jobs(const BatchOptions& options, const cases::Study& study, const Jobs& plan, Book& book) {
  received = 0;
  const auto previous_term = std::signal(SIGTERM, [](int n) { received = n; });
  const auto previous_int = std::signal(SIGINT, [](int n) { received = n; });
  const int code = Batch(options, study, plan, book).run();
  std::signal(SIGTERM, previous_term);
  std::signal(SIGINT, previous_int);
  return code;
}

}  // namespace puffin::tools
