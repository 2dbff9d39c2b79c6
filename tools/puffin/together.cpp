// puffin together: one flow, several populations. Called by puffin batch for share = ["one-way-flow"].

#include "tools/puffin/together.hpp"

#include <oneapi/tbb/global_control.h>
#include <xmmintrin.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "cases/build.hpp"
#include "cases/presets.hpp"
#include "cases/write_case.hpp"
#include "coupling/advance_together.hpp"
#include "coupling/health.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/report.hpp"
#include "tools/output/report/live_page.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/finished.hpp"
#include "tools/puffin/progress.hpp"
#include "tools/puffin/stored_field.hpp"
#include "tools/puffin/summarize.hpp"

namespace puffin::tools {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

volatile std::sig_atomic_t received = 0;

/// One of the cases while it runs.
struct Population {
  std::unique_ptr<cases::Simulation> simulation;
  std::unique_ptr<output::OutputFolder> folder;
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<Progress> progress;
  std::unique_ptr<coupling::Health> health;
  double set_up = 0.0, output = 0.0;  // [s]
  std::int64_t checked = 0;
  bool ended = false;

  coupling::State& state() { return simulation->state; }
  double stop() const { return simulation->description.stop.time; }
};

class Company {
 public:
  Company(const std::vector<TogetherCase>& list, std::string_view preset, int threads, bool quiet,
          const std::filesystem::path& beds)
      : start_(Clock::now()), beds_(beds), threads_(threads), quiet_(quiet) {
    std::vector<cases::Case> cases;
    for (const TogetherCase& one : list) {
      cases.push_back(cases::read_case(one.case_file, one.sets, preset));
      if (const std::string why = why_apart(cases.front(), cases.back()); !why.empty())
        throw UsageError(one.case_file.string() + " cannot share a flow with " + list.front().case_file.string() +
                         ": " + why);
    }
    std::vector<std::size_t> order(list.size());
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
    // The owner of the air is the one that needs it longest.
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return cases[a].stop.time > cases[b].stop.time; });
    for (const std::size_t n : order) add(cases[n], list[n].out);
  }

  int run() {
    try {
      for (Population& p : all_) with_air(p, [&] { p.recorder->record(*p.simulation); });
      while (received == 0 && std::any_of(all_.begin(), all_.end(), [](const Population& p) { return !p.ended; }))
        step();
    } catch (const coupling::Diverged& e) {  // the air
      for (Population& p : all_)
        if (!p.ended) end(p, "diverged", e.what());
      diverged_ = true;
    }
    for (Population& p : all_)
      if (!p.ended) end(p, "stopped", received == SIGINT ? "interrupted" : "terminated");
    if (received != 0) return received == SIGINT ? interrupted : stopped;
    return diverged_ ? diverged : ok;
  }

 private:
  template <class Work>
  void with_air(Population& p, const Work& work) {
    const coupling::BorrowedAir air(all_.front().state(), p.state());
    work();
  }

  void add(const cases::Case& c, const std::filesystem::path& out) {
    const Clock::time_point begin = Clock::now();
    Population p;
    p.simulation = cases::build(c, read_stored_field, std::numeric_limits<double>::infinity(), beds_);
    p.folder = std::make_unique<output::OutputFolder>(out, c.name);
    announce(*p.folder, c);
    p.folder->write_text("case.toml", cases::write_resolved(c));
    p.health = std::make_unique<coupling::Health>(p.simulation->models, p.state());
    p.recorder = std::make_unique<Recorder>(*p.simulation, *p.folder);
    p.progress = std::make_unique<Progress>(*p.simulation, *p.folder, quiet_ || !all_.empty());
    if (!all_.empty()) {  // the first one's air is everybody's; it lacks what only fines need if that one has none
      auto& corners = all_.front().state().air->links.corner_images;
      if (corners.empty()) corners = std::move(p.state().air->links.corner_images);
      p.state().air.reset();
    }
    p.set_up = seconds_since(begin);
    all_.push_back(std::move(p));
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
      try {
        if (!members[n].failure.empty()) throw coupling::Diverged(members[n].failure);
        p.health->check_impacts(p.simulation->models, p.state());
        with_air(p, [&] {
          p.recorder->take_events(*p.simulation);
          p.recorder->record(*p.simulation);
          p.progress->update(*p.recorder, {}, false);
          const std::int64_t steps = p.state().air->steps, next = p.simulation->models.steps_per_exchange_asleep;
          if (coupling::check_due(steps - p.checked, next)) {
            p.health->check(p.simulation->models, p.state());
            p.checked = steps;
          }
          done = finished(*p.simulation);
        });
        p.output += seconds_since(begin);
        if (done) end(p, "finished", "");
      } catch (const coupling::Diverged& e) {
        diverged_ = true;
        end(p, "diverged", e.what());
      }
    }
  }

  void end(Population& p, const std::string& state, const std::string& message) {
    with_air(p, [&] {
      p.ended = true;
      p.recorder->finish(*p.simulation);
      if (state == "finished") p.recorder->forget_journal();
      p.progress->update(*p.recorder, {}, true);
      RunFacts facts;
      facts.state = state;
      facts.message = message;
      facts.wall_clock = seconds_since(start_);
      facts.set_up = p.set_up;
      facts.output = p.output;
      facts.threads = threads_;
      facts.warnings = p.simulation->warnings;
      output::Summary summary = summarize(*p.simulation, *p.recorder, facts);
      summary.assumptions.push_back("carriers: they do not act on the air, whose flow this run shares with others");
      output::write_summary(p.folder->file("summary.json"), summary);
      output::Status last = output::read_status(p.folder->file("status.json"));
      last.state = state;
      output::write_status(p.folder->file("status.json"), last);
      output::write_whole(p.folder->file("index.html"), output::live_page(last, p.recorder->history()));
    });
    p.state().carriers = {};
    p.state().scalars = {};
    if (state == "stopped") return;
    if (!message.empty()) log_error(p.simulation->description.name + ": " + message);
    try {
      output::write_whole(p.folder->path() / "report.html", output::make_report(p.folder->path()));
    } catch (const std::exception& e) {
      log_warning(std::string("no report: ") + e.what());
    }
  }

  Clock::time_point start_;
  std::filesystem::path beds_;
  int threads_;
  bool quiet_, diverged_ = false;
  std::vector<Population> all_;
};

}  // namespace

std::string flow_key(const cases::Case& given) {
  if (given.air.model != cases::AirModel::lbm || !given.carriers) return "";
  cases::Case c = given;
  c.name = "flow";
  c.carriers.reset();
  c.fines.reset();
  c.reference.clear();
  c.provenance.clear();
  c.output = {};
  c.stop = {};
  c.numerics.seed = 1;  // of the carriers alone, unless an inlet is turbulent
  const bool turbulent = std::any_of(c.air.boundaries.begin(), c.air.boundaries.end(),
                                     [](const cases::Boundary& b) { return b.turbulence > 0.0; });
  if (turbulent) c.numerics.seed = given.numerics.seed;
  return cases::write_resolved(c);
}

std::string why_apart(const cases::Case& flow, const cases::Case& other) {
  if (flow_key(other).empty()) return "it has no carriers in air on a lattice";
  if (other.carriers->two_way) return "carriers.two_way is true";
  if (flow_key(other) != flow_key(flow)) return "geometry, air or numerics differ";
  return "";
}

std::vector<TogetherCase> read_together(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_array() || json.empty()) throw output::OutputError(file.string() + " holds no list of cases");
  std::vector<TogetherCase> list;
  for (const auto& item : json) {
    TogetherCase one{item.value("case", ""), item.value("out", ""), {}};
    for (const auto& set : item.value("set", nlohmann::json::array()))
      one.sets.push_back(cases::parse_override(set.get<std::string>()));
    list.push_back(one);
  }
  return list;
}

int run_together(const std::vector<TogetherCase>& list, std::string_view preset, int threads, bool quiet,
                 const std::filesystem::path& beds) {
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush denormals: air at rest would otherwise compute with them
  set_up_log(quiet);
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
  received = 0;
  const auto previous_term = std::signal(SIGTERM, [](int n) { received = n; });
  const auto previous_int = std::signal(SIGINT, [](int n) { received = n; });
  const int code = Company(list, preset, threads, quiet, beds).run();
  std::signal(SIGTERM, previous_term);
  std::signal(SIGINT, previous_int);
  return code;
}

namespace commands {
Command together() {
  return {"together", "one flow for several cases whose carriers do not act on the air; see puffin batch",
          [](CLI::App& app) -> Action {
            struct Given {
              std::filesystem::path list;
              std::string preset;
              int threads = 0;
              bool quiet = false;
              std::filesystem::path beds;
            };
            auto g = std::make_shared<Given>();
            app.add_option("list", g->list, "the list of cases, as puffin batch writes it")
                ->required()
                ->type_name("LIST.json");
            app.add_option("--preset", g->preset, "for every case")->type_name("NAME");
            app.add_option("--threads", g->threads, "0: all")->check(CLI::Range(0, 4096));
            app.add_option("--beds", g->beds, "where settled beds are kept")->type_name("DIR");
            app.add_flag("--quiet", g->quiet, "warnings only");
            return [g] { return run_together(read_together(g->list), g->preset, g->threads, g->quiet, g->beds); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
