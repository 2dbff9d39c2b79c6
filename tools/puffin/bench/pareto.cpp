// puffin bench pareto: run time against error over the cases of cases/bench, each setting a run of its own.

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/search_path.hpp"
#include "cases/verification/evaluate.hpp"
#include "cases/verification/pareto.hpp"
#include "tools/bench/front.hpp"
#include "tools/puffin/bench/benches.hpp"
#include "tools/puffin/bench/child_run.hpp"
#include "tools/puffin/bench/pareto_figure.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

using nlohmann::json;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v.empty() ? not_a_number : 0.5 * (v[(v.size() - 1) / 2] + v[v.size() / 2]);
}

/// What a run came to, in the unit of the reference.
struct Value {
  double value = not_a_number, half_width = 0.0, reference = not_a_number;
  std::string problem;
};

Value value_of(const cases::ParetoCase& c, const cases::RunOutput& output) {
  const std::map<std::string, cases::RunOutput> outputs{{cases::pareto_run, output}};
  const cases::Outcome outcome = cases::evaluate(c.verification, c.check, outputs);
  Value v{outcome.value, 0.0, outcome.reference, outcome.problem};
  if (c.half_width) {
    const cases::Outcome width = cases::evaluate(c.verification, *c.half_width, outputs);
    v.half_width = std::abs(width.value);
    if (v.problem.empty()) v.problem = width.problem;
  }
  return v;
}

/// All runs of one case.
class CaseBench {
 public:
  CaseBench(const cases::ParetoCase& c, const BenchArguments& a, TemporaryFolder& place)
      : case_(c), quick_(a.quick), json_(a.json), place_(place) {}

  std::vector<ParetoRow> rows(int repeats) {
    find_reference();
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
    for (int n = 0; n < repeats; ++n)  // interleaved: a slow minute hits every setting
      for (std::size_t k = 0; k < rows_.size(); ++k)
        if (n == 0 || rows_[k].outcome == "ok") run(k);
    judge();
    return rows_;
  }

 private:
  ChildRun child(const std::vector<cases::Override>& sets) {
    const cases::VerificationRun run = cases::run_of(case_, sets, quick_);
    const std::filesystem::path folder = place_.fresh();
    return run_child(run.case_file, run.sets, folder);
  }

  /// The first reference run gives the value; the distances of the others say how far it may be off. Those marked quick
  /// are of the short benchmark alone.
  void find_reference() {
    reference_uncertainty_ = case_.reference_uncertainty;
    for (const cases::ParetoSetting& s : case_.references) {
      if (quick_ != s.quick) continue;
      const ChildRun run = child(s.sets);
      if (!run.output) throw std::runtime_error(case_.id + ", reference '" + s.label + "': " + run.problem);
      const Value v = value_of(case_, *run.output);
      if (!v.problem.empty()) throw std::runtime_error(case_.id + ", reference '" + s.label + "': " + v.problem);
      if (!json_)
        print(case_.id + "  reference " + s.label + ": " + short_text(v.value) + " +- " + short_text(v.half_width) +
              ", " + short_text(run.seconds) + " s");
      if (!reference_) {
        reference_ = v.value;
        reference_uncertainty_ = std::max(reference_uncertainty_, v.half_width);
      } else {
        reference_uncertainty_ = std::max(reference_uncertainty_, std::abs(v.value - *reference_));
      }
    }
  }

  void run(std::size_t k) {
    const ChildRun run = child(points_[k].sets);
    ParetoRow& row = rows_[k];
    seconds_[k].push_back(run.seconds);
    row.foreign_load = std::max(row.foreign_load, run.foreign_load);
    if (!run.output) {
      row.outcome = run.exit_code == 5 ? "diverged" : "exit " + std::to_string(run.exit_code);
      row.problem = run.problem;
    } else if (seconds_[k].size() == 1) {
      take(*run.output, row);
    }
    if (!json_ && seconds_[k].size() == 1) print(to_text(row, run.seconds));
  }

  void take(const cases::RunOutput& output, ParetoRow& row) const {
    const auto number = [&](const std::string& key) {
      const auto found = output.numbers.find(key);
      return found == output.numbers.end() ? 0.0 : found->second;
    };
    row.cells = number("cells_fluid");
    row.steps = number("steps");
    row.cell_updates = row.cells * row.steps;
    row.memory_peak = number("memory_peak");
    for (const auto& [key, value] : output.numbers)
      if (key.starts_with("phases.")) row.phases[key.substr(7)] = value;
    const Value v = value_of(case_, output);
    row.value = v.value;
    row.reference = reference_.value_or(v.reference);
    const double scale = case_.check.measure == cases::Measure::relative ? std::abs(row.reference) : 1.0;
    row.error = std::abs(v.value - row.reference) / scale;
    row.value_half_width = v.half_width / scale;
    row.reference_uncertainty = reference_uncertainty_ / scale;
    row.outcome = v.problem.empty() && std::isfinite(row.error) ? "ok" : "no value";
    row.problem = v.problem;
  }

  void judge() {
    std::vector<bench::CostAndError> settings;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      ParetoRow& row = rows_[k];
      row.seconds = median(seconds_[k]);
      row.seconds_min = *std::min_element(seconds_[k].begin(), seconds_[k].end());
      row.seconds_max = *std::max_element(seconds_[k].begin(), seconds_[k].end());
      row.repeats = static_cast<int>(seconds_[k].size());
      const bool counts = row.outcome == "ok";
      settings.push_back({row.seconds, counts ? row.error : not_a_number,
                          std::hypot(row.value_half_width, row.reference_uncertainty)});
    }
    const std::vector<bool> front = bench::on_front(settings);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      rows_[k].on_front = front[k];
      if (rows_[k].outcome != "ok") continue;
      rows_[k].time_over_front = bench::time_over_front(settings, k, false);
      rows_[k].time_over_front_certain = bench::time_over_front(settings, k, true);
    }
  }

  const cases::ParetoCase& case_;
  bool quick_, json_;
  TemporaryFolder& place_;
  std::optional<double> reference_;
  double reference_uncertainty_ = 0.0;
  std::vector<cases::ParetoPoint> points_;
  std::vector<ParetoRow> rows_;
  std::vector<std::vector<double>> seconds_;
};

}  // namespace

json bench_pareto(const BenchArguments& a) {
  const auto all = cases::read_pareto_cases(cases::bench_directory());
  std::vector<const cases::ParetoCase*> wanted;
  for (const cases::ParetoCase& c : all) {
    const bool named = std::find(a.only.begin(), a.only.end(), c.id) != a.only.end();
    if (named || (a.only.empty() && (c.quick || !a.quick))) wanted.push_back(&c);
  }
  for (const std::string& id : a.only)
    if (std::none_of(all.begin(), all.end(), [&](const auto& c) { return c.id == id; }))
      throw UsageError("there is no case '" + id + "' in " + cases::bench_directory().string());
  TemporaryFolder place("puffin-bench");
  json rows = json::array();
  for (const cases::ParetoCase* c : wanted) {
    if (!a.json) print(c->id + "  " + c->title + ": " + c->metric);
    const std::vector<ParetoRow> of_case = CaseBench(*c, a, place).rows(a.quick ? 1 : c->repeats);
    for (const ParetoRow& row : of_case) rows.push_back(to_json(row));
    if (!a.json) print(front_text(of_case));
    if (!a.out.empty()) write_figure(of_case, c->title, a.out);
  }
  return rows;
}

}  // namespace puffin::tools
