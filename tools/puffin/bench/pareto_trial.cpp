#include "tools/puffin/bench/pareto_trial.hpp"

#include <algorithm>
#include <cmath>

#include "cases/verification/evaluate.hpp"

namespace puffin::tools {
namespace {

/// What a run came to, in the metric's unit.
struct Value {
  double value = not_known, half_width = 0.0, reference = not_known;
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
  if (v.problem.empty() && !std::isfinite(v.value + v.reference + v.half_width)) v.problem = "the value is no number";
  return v;
}

double number(const cases::RunOutput& output, const std::string& key) {
  const auto found = output.numbers.find(key);
  return found == output.numbers.end() ? not_known : found->second;
}

void count_work(const cases::RunOutput& output, bool first, ParetoTrial& t) {
  const double cells = number(output, "cells_fluid"), steps = number(output, "steps");
  if (first) t.cells = cells, t.steps = steps, t.cell_updates = 0.0, t.memory_peak = 0.0;
  t.cell_updates += cells * steps;
  t.memory_peak = std::max(t.memory_peak, number(output, "memory_peak"));
  for (const auto& [key, value] : output.numbers)
    if (key.starts_with("phases.")) t.phases[key.substr(7)] += value;
}

void summarize(const std::vector<Value>& values, ParetoTrial& t) {
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0, widths = 0.0, references = 0.0;
  for (const Value& v : values) {
    sum += v.value;
    references += v.reference;
    squares += std::pow(v.value - v.reference, 2);
    widths += std::pow(v.half_width, 2);
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end(),
                                               [](const Value& a, const Value& b) { return a.value < b.value; });
  t.value = sum / n;
  t.value_spread = 0.5 * (high->value - low->value);
  t.half_width = std::sqrt(widths) / n;
  t.reference = references / n;
  t.deviation = std::sqrt(squares / n);
}

}  // namespace

ParetoTrial run_trial(const cases::ParetoCase& c, const std::vector<cases::Override>& sets, bool quick,
                      std::optional<double> reference, TemporaryFolder& place) {
  ParetoTrial t;
  std::vector<Value> values;
  for (const cases::VerificationRun& run : cases::runs_of(c, sets, quick)) {
    const std::filesystem::path folder = place.fresh();
    const ChildRun child = run_child(run.case_file, run.sets, folder);
    t.seconds += child.seconds;
    t.processor_seconds += child.processor_seconds;
    t.foreign_load = std::max(t.foreign_load, child.foreign_load);
    if (!child.output) {
      t.outcome = child.exit_code == 5 ? "diverged" : "exit " + std::to_string(child.exit_code);
      t.problem = child.problem;
      return t;
    }
    count_work(*child.output, values.empty(), t);
    Value v = value_of(c, *child.output);
    if (reference) v.reference = *reference;
    if (!v.problem.empty()) {
      t.outcome = "no value";
      t.problem = v.problem;
      return t;
    }
    values.push_back(v);
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  summarize(values, t);
  return t;
}

void take(const ParetoTrial& t, const cases::ParetoCase& c, double reference_uncertainty, ParetoRow& row) {
  row.outcome = t.outcome;
  row.problem = t.problem;
  row.phases = t.phases;
  row.cells = t.cells;
  row.steps = t.steps;
  row.cell_updates = t.cell_updates;
  row.memory_peak = t.memory_peak;
  if (t.outcome != "ok") {  // what an earlier repeat found is not what this setting can
    for (double* number : {&row.value, &row.value_spread, &row.value_half_width, &row.reference,
                           &row.reference_uncertainty, &row.error, &row.error_half_width})
      *number = not_known;
    return;
  }
  row.value = t.value;
  row.value_spread = t.value_spread;
  row.value_half_width = t.half_width;
  row.reference = t.reference;
  row.reference_uncertainty = reference_uncertainty;
  const double scale = c.check.measure == cases::Measure::relative ? std::abs(t.reference) : 1.0;
  row.error = t.deviation / scale;
  row.error_half_width = std::hypot(t.half_width, reference_uncertainty) / scale;
}

}  // namespace puffin::tools
