// puffin bench pareto: run time against error over the cases of cases/bench, each setting a run of its own.

#include <algorithm>
#include <cmath>

#include "cases/search_path.hpp"
#include "cases/spelling.hpp"
#include "cases/verification/pareto.hpp"
#include "tools/bench/front.hpp"
#include "tools/bench/median.hpp"
#include "tools/puffin/bench/benches.hpp"
#include "tools/puffin/bench/pareto_figure.hpp"
#include "tools/puffin/bench/pareto_trial.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/signals.hpp"

namespace puffin::tools {
namespace {

using nlohmann::json;

/// 1 where both are exact.
double ratio(double error, double best) { return error == best ? 1.0 : error / best; }

/// All runs of one case.
class CaseBench {
 public:
  CaseBench(const cases::ParetoCase& c, const BenchArguments& a, TemporaryFolder& place)
      : case_(c), quick_(a.quick), json_(a.json), by_processor_(a.processor_time), place_(place) {}

  /// Of every setting; after a signal, of those that have run.
  std::vector<ParetoRow> rows(int repeats) {
    for (const cases::ParetoPoint& p : cases::points_of(case_, quick_)) {
      ParetoRow row;
      row.case_id = case_.id;
      row.axis = p.axis;
      row.setting = p.label;
      row.metric = case_.metric;
      row.is_default = p.axis.empty();
      rows_.push_back(row);
      points_.push_back(p);
    }
    seconds_.resize(rows_.size());
    processor_seconds_.resize(rows_.size());
    try {
      find_reference();
      for (int n = 0; n < repeats; ++n)  // interleaved: a slow minute hits every setting
        for (std::size_t k = 0; k < rows_.size(); ++k)
          if (n == 0 || rows_[k].outcome == "ok") run(k);
    } catch (const BenchStopped&) {  // what has run is judged
      const auto ran = static_cast<std::ptrdiff_t>(
          std::count_if(seconds_.begin(), seconds_.end(), [](const auto& s) { return !s.empty(); }));
      rows_.erase(rows_.begin() + ran, rows_.end());
    }
    judge();
    return rows_;
  }

 private:
  /// The first reference run gives the value; the distances of the others say how far it may be off.
  void find_reference() {
    reference_uncertainty_ = case_.reference_uncertainty;
    for (const cases::ParetoSetting& s : cases::references_of(case_, quick_)) {
      const ParetoTrial t = run_trial(case_, s.sets, quick_, std::nullopt, place_);
      if (t.outcome != "ok") throw std::runtime_error(case_.id + ", reference '" + s.label + "': " + t.problem);
      if (!json_)
        print(case_.id + "  reference " + s.label + ": " + short_text(t.value) + " +- " + short_text(t.half_width) +
              ", " + short_text(t.seconds) + " s");
      const double own = std::max(t.half_width, t.value_spread);
      if (!reference_) {
        reference_ = t.value;
        reference_uncertainty_ = std::max(reference_uncertainty_, own);
      } else {
        reference_uncertainty_ = std::max(reference_uncertainty_, std::abs(t.value - *reference_));
      }
    }
  }

  void run(std::size_t k) {
    const ParetoTrial t = run_trial(case_, points_[k].sets, quick_, reference_, place_);
    ParetoRow& row = rows_[k];
    const bool first = seconds_[k].empty();
    seconds_[k].push_back(t.seconds);
    processor_seconds_[k].push_back(t.processor_seconds);
    row.foreign_load = std::max(row.foreign_load, t.foreign_load);
    if (first || t.outcome != "ok") take(t, case_, reference_uncertainty_, row);
    if (!json_ && first) print(to_text(row, t.seconds));
  }

  void judge() {
    std::vector<bench::CostAndError> settings, by_updates;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      ParetoRow& row = rows_[k];
      row.seconds = bench::median(seconds_[k]);
      row.seconds_min = *std::min_element(seconds_[k].begin(), seconds_[k].end());
      row.seconds_max = *std::max_element(seconds_[k].begin(), seconds_[k].end());
      row.processor_seconds = bench::median(processor_seconds_[k]);
      row.cost = by_processor_ ? row.processor_seconds : row.seconds;
      row.repeats = static_cast<int>(seconds_[k].size());
      settings.push_back({row.cost, row.error, row.error_half_width});
      by_updates.push_back({row.cell_updates, row.error, row.error_half_width});
    }
    const std::vector<bool> front = bench::on_front(settings);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      ParetoRow& row = rows_[k];
      row.on_front = front[k];
      if (row.outcome != "ok") continue;
      row.time_over_front = bench::time_over_front(settings, k, false);
      row.time_over_front_certain = bench::time_over_front(settings, k, true);
      const ParetoRow& best = rows_[bench::best_for_cost(settings, k)];
      row.front_setting = name_of(best);
      row.front_error = best.error;
      row.error_over_front = ratio(row.error, best.error);
      row.error_over_front_by_updates = ratio(row.error, rows_[bench::best_for_cost(by_updates, k)].error);
    }
  }

  const cases::ParetoCase& case_;
  bool quick_, json_, by_processor_;
  TemporaryFolder& place_;
  std::optional<double> reference_;
  double reference_uncertainty_ = 0.0;
  std::vector<cases::ParetoPoint> points_;
  std::vector<ParetoRow> rows_;
  std::vector<std::vector<double>> seconds_, processor_seconds_;  // of each row, its repeats
};

/// Those of --only, or all; with --quick those of the short benchmark.
std::vector<const cases::ParetoCase*> chosen(const std::vector<cases::ParetoCase>& all, const BenchArguments& a) {
  std::vector<std::string> ids, quick;
  for (const cases::ParetoCase& c : all) {
    ids.push_back(c.id);
    if (c.quick) quick.push_back(c.id);
  }
  std::vector<const cases::ParetoCase*> list;
  for (const cases::ParetoCase& c : all) {
    const bool named = std::find(a.only.begin(), a.only.end(), c.id) != a.only.end();
    if (!named && !a.only.empty()) continue;
    if (a.quick && !c.quick && named)
      throw UsageError("case " + c.id + " has no short benchmark: leave --quick out; the cases of --quick are " +
                       cases::join(quick));
    if (c.quick || !a.quick) list.push_back(&c);
  }
  for (const std::string& id : a.only)
    if (std::find(ids.begin(), ids.end(), id) == ids.end())
      throw UsageError("there is no case '" + id + "'; the cases are " + cases::join(ids));
  if (list.empty()) throw UsageError("there is no case to run in " + a.catalogue.string());
  return list;
}

}  // namespace

BenchRows bench_pareto(const BenchArguments& a) {
  const auto all = cases::read_pareto_cases(a.catalogue.empty() ? cases::bench_directory() : a.catalogue);
  const std::vector<const cases::ParetoCase*> wanted = chosen(all, a);
  TemporaryFolder place("puffin-bench");
  const Signals signals;
  json rows = json::array();
  for (const cases::ParetoCase* c : wanted) {
    if (Signals::received() != 0) break;
    if (!a.json) print(c->id + "  " + c->title + ": " + c->metric);
    const std::vector<ParetoRow> of_case = CaseBench(*c, a, place).rows(a.quick ? 1 : c->repeats);
    if (of_case.empty()) break;
    for (const ParetoRow& row : of_case) rows.push_back(to_json(row));
    if (!a.json) print(front_text(of_case));
    if (!a.out.empty()) write_figure(of_case, c->title, a.processor_time, a.out);
  }
  return {rows, Signals::code()};
}

}  // namespace puffin::tools
