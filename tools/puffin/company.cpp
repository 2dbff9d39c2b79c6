// puffin together: one flow, several populations.

#include <oneapi/tbb/global_control.h>
#include <xmmintrin.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <thread>

#include "cases/write_case.hpp"
#include "coupling/advance_together.hpp"
#include "coupling/health.hpp"
#include "dem/failure.hpp"
#include "tools/output/report.hpp"
#include "tools/puffin/case_warnings.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/finished.hpp"
#include "tools/puffin/lattice_limits.hpp"
#include "tools/puffin/law_limits.hpp"
#include "tools/puffin/opening.hpp"
#include "tools/puffin/progress.hpp"
#include "tools/puffin/signals.hpp"
#include "tools/puffin/summarize.hpp"
#include "tools/puffin/together.hpp"

namespace puffin::tools {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// One of the cases while it runs.
struct Population {
  std::filesystem::path out;  // as the list has it
  std::unique_ptr<cases::Simulation> simulation;
  std::unique_ptr<output::OutputFolder> folder;
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<Progress> progress;
  std::unique_ptr<coupling::Health> health;
  double case_stop_time = 0.0;        // without the preset [s]
  double set_up = 0.0, output = 0.0;  // [s]
  std::int64_t checked = 0;
  bool ended = false;

  coupling::State& state() { return simulation->state; }
  double stop() const { return simulation->description.stop.time; }
  const std::string& name() const { return simulation->description.name; }
};

class Company {
 public:
  explicit Company(const TogetherOptions& options) : start_(Clock::now()), options_(options) {
    const std::vector<TogetherCase> list = read_together(options.list);
    std::vector<std::optional<cases::Case>> cases(list.size());
    std::vector<std::size_t> order;
    for (std::size_t n = 0; n < list.size(); ++n) try {
        cases[n] = cases::read_case(list[n].case_file, list[n].sets, options.preset);
        order.push_back(n);
      } catch (const std::exception& e) {
        fail(list[n], e);
      }
    for (const std::size_t n : order)
      if (const std::string why = why_apart(*cases[order.front()], *cases[n]); !why.empty())
        throw UsageError(list[n].case_file.string() + " cannot share a flow with " +
                         list[order.front()].case_file.string() + ": " + why);
    // The owner of the air is the one that needs it longest.
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return cases[a]->stop.time > cases[b]->stop.time; });
    for (const std::size_t n : order) try {
        add(*cases[n], list[n]);
      } catch (const std::exception& e) {
        fail(list[n], e);
      }
  }

  int run() {
    try {
      for (Population& p : all_) alone(p, [&] { with_air(p, [&] { p.recorder->record(*p.simulation); }); });
      while (Signals::received() == 0 &&
             std::any_of(all_.begin(), all_.end(), [](const Population& p) { return !p.ended; }))
        step();
    } catch (const std::exception& e) {  // the air
      for (Population& p : all_)
        if (!p.ended) end(p, e);
    }
    const int signal = Signals::received();
    for (Population& p : all_)
      if (!p.ended) end(p, "stopped", stopped, signal == SIGINT ? "interrupted" : "terminated");
    if (signal != 0) return signal == SIGINT ? interrupted : stopped;
    const auto bad = std::find_if(ends_.begin(), ends_.end(), [](const TogetherEnd& e) { return e.code != ok; });
    return bad == ends_.end() ? ok : bad->code;
  }

 private:
  template <class Work>
  void with_air(Population& p, const Work& work) {
    const coupling::BorrowedAir air(all_.front().state(), p.state());
    work();
  }

  /// What goes wrong in it ends this population, and no other; what a signal broke off ends with all.
  template <class Work>
  void alone(Population& p, const Work& work) {
    try {
      work();
    } catch (const dem::Interrupted&) {
    } catch (const std::exception& e) {
      end(p, e);
    }
  }

  void add(const cases::Case& c, const TogetherCase& given) {
    const Clock::time_point begin = Clock::now();
    Population p;
    p.out = given.out;
    p.case_stop_time = stop_time_of(c, given.case_file, given.sets, options_.preset);
    const std::vector<std::string> doubts = assessment_warnings(c);
    p.simulation = built(c, given.case_file, options_.beds);
    p.simulation->models.carriers.asked_to_stop = [] { return Signals::received() != 0; };
    p.simulation->warnings = first_warnings(*p.simulation);
    add_new(doubts, p.simulation->warnings);
    p.folder = std::make_unique<output::OutputFolder>(given.out, c.name);
    announce(*p.folder, c.name, c.stop.time);
    try {
      begin_in_folder(p, c);
    } catch (const std::exception&) {
      close_failed(*p.folder, {});
      throw;
    }
    p.set_up = seconds_since(begin);
    all_.push_back(std::move(p));
  }

  void begin_in_folder(Population& p, const cases::Case& c) {
    const LogToFile log(p.folder->file("log.txt"));
    for (const std::string& text : p.simulation->warnings) log_warning(c.name + ": " + text);
    keep_case(c, *p.folder);
    p.health = std::make_unique<coupling::Health>(p.simulation->models, p.state());
    p.recorder = std::make_unique<Recorder>(*p.simulation, *p.folder);
    p.progress = std::make_unique<Progress>(*p.simulation, *p.folder, options_.quiet || !all_.empty());
    log_beginning(*p.simulation, options_.threads, p.folder->path());
    if (!all_.empty()) {  // the first one's air is everybody's; it lacks what only fines need if that one has none
      auto& corners = all_.front().state().air->links.corner_images;
      if (corners.empty()) corners = std::move(p.state().air->links.corner_images);
      p.state().air.reset();
      p.simulation->lattice_speed = all_.front().simulation->lattice_speed;
      log_info("its air is that of " + all_.front().name());
    }
  }

  void step() {
    double until = 1e300;
    std::vector<coupling::Companion> members;
    std::vector<Population*> who;
    for (Population& p : all_) {
      if (!p.ended) until = std::min({until, p.recorder->next(), p.stop()});
      // The owner goes on after its end, for its air; its own carriers and fines are gone by then.
      if (!p.ended || &p == &all_.front()) {
        members.push_back({&p.simulation->models, &p.state()});
        who.push_back(&p);
      }
    }
    coupling::advance_together(members, until);
    for (std::size_t n = 0; n < members.size(); ++n) {
      Population& p = *who[n];
      if (p.ended) continue;
      const Clock::time_point begin = Clock::now();
      bool done = false;
      alone(p, [&] {
        if (members[n].failure) look_into(p, members[n].failure);
        p.health->check_impacts(p.simulation->models, p.state());
        with_air(p, [&] { done = look_after(p); });
      });
      p.output += seconds_since(begin);
      if (done) end(p, "finished", ok, "");
    }
  }

  /// A law that was asked about what is no number: the health check knows which carrier it was.
  void look_into(Population& p, const std::exception_ptr& failure) {
    try {
      std::rethrow_exception(failure);
    } catch (const std::logic_error&) {
      with_air(p, [&] { p.health->check(p.simulation->models, p.state()); });
      throw;
    }
  }

  /// Outputs and health after an interval; whether it is at its end.
  static bool look_after(Population& p) {
    p.recorder->take_events(*p.simulation);
    warn_beyond_laws(*p.simulation, p.simulation->warnings);
    p.recorder->record(*p.simulation);
    p.progress->update(*p.recorder, p.simulation->warnings, false);
    const std::int64_t steps = p.state().air->steps, next = p.simulation->models.steps_per_exchange_asleep;
    if (coupling::check_due(steps - p.checked, next)) {
      p.health->check(p.simulation->models, p.state());
      p.checked = steps;
    }
    return finished(*p.simulation);
  }

  void end(Population& p, const std::exception& why) {
    const ExitCode code = exit_code(why);
    end(p, code == diverged ? "diverged" : "failed", code, why.what());
  }

  /// Its last outputs; whatever happens in them, the others go on.
  void end(Population& p, const std::string& state, int code, std::string message) {
    p.ended = true;
    try {
      const LogToFile log(p.folder->file("log.txt"));
      if (!message.empty()) log_error(p.name() + ": " + message);
      if (state == "failed")
        close_failed(*p.folder, p.recorder->history());
      else
        with_air(p, [&] { write_end(p, state, message); });
    } catch (const std::exception& e) {
      if (code == ok) code = exit_code(e), message = e.what();
      log_error(p.name() + ": " + e.what());
      close_failed(*p.folder, p.recorder->history());
    }
    p.state().carriers = {};
    p.state().scalars = {};
    if (state == "stopped") return;
    book({p.out, code, message});
  }

  void write_end(Population& p, const std::string& state, const std::string& message) {
    auto& warnings = p.simulation->warnings;
    if (state == "finished")
      for (const std::string& text : lattice_warnings(*p.simulation)) {
        warnings.push_back(text);
        log_warning(p.name() + ": " + text);
      }
    p.recorder->finish(*p.simulation);
    p.progress->update(*p.recorder, warnings, true);
    RunFacts facts;
    facts.state = state;
    facts.message = message;
    facts.wall_clock = seconds_since(start_);
    facts.set_up = p.set_up, facts.output = p.output;
    facts.threads = options_.threads;
    facts.preset = options_.preset;
    facts.case_stop_time = p.case_stop_time;
    facts.warnings = warnings;
    output::Summary summary = summarize(*p.simulation, *p.recorder, facts);
    summary.assumptions.push_back("carriers: they do not act on the air, whose flow this run shares with others");
    output::write_summary(p.folder->file("summary.json"), summary);
    close_status(*p.folder, state, p.recorder->history(), facts.wall_clock);
    if (state == "finished") p.recorder->forget_journal();
    if (state == "stopped") return;
    try {
      output::write_whole(p.folder->path() / "report.html", output::make_report(p.folder->path()));
      log_info("report: " + (p.folder->path() / "report.html").string());
    } catch (const std::exception& e) {
      log_warning(std::string("no report: ") + e.what());
    }
  }

  /// A case that did not begin.
  void fail(const TogetherCase& given, const std::exception& why) {
    log_error(given.out.string() + ": " + why.what());
    book({given.out, exit_code(why), why.what()});
  }

  void book(const TogetherEnd& end) {
    ends_.push_back(end);
    try {
      write_ends(ends_, options_.list);
    } catch (const std::exception& e) {
      log_warning(e.what());
    }
  }

  Clock::time_point start_;
  const TogetherOptions& options_;
  std::vector<Population> all_;
  std::vector<TogetherEnd> ends_;
};

}  // namespace

int run_together(const TogetherOptions& given) {
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush denormals: air at rest would otherwise compute with them
  TogetherOptions options = given;
  set_up_log(options.quiet);
  if (options.threads <= 0) options.threads = static_cast<int>(std::thread::hardware_concurrency());
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(options.threads));
  const Signals signals;
  return Company(options).run();
}

}  // namespace puffin::tools
