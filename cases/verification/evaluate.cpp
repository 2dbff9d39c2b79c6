#include "cases/verification/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "cases/format/toml_file.hpp"
#include "cases/units.hpp"

namespace puffin::cases {
namespace {

using Known = std::map<std::string, double>;

/// The run's own numbers, then the constants of the file, then those of the run.
Known known_of(const Verification& v, const VerificationRun& run, const RunOutput& output) {
  Known known = output.numbers;
  for (const auto* list : {&v.constants, &run.constants})
    for (const Constant& c : *list) known[c.name] = c.formula(known);
  return known;
}

/// A formula at every row of a table; what is no column is a constant.
class RowFormula {
 public:
  RowFormula(const Formula& formula, const Table& table, const Known& known) : formula_(formula) {
    Known all = known;
    for (const auto& [name, column] : table.numbers) all[name] = 0.0;
    (void)formula(all);  // names what is not known
    for (const std::string& name : formula.names()) {
      const auto column = table.numbers.find(name);
      columns_.push_back(column == table.numbers.end() ? nullptr : &column->second);
      values_.push_back(column == table.numbers.end() ? known.at(name) : 0.0);
    }
  }
  double operator()(std::size_t row) {
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (columns_[i]) values_[i] = (*columns_[i])[row];
    return formula_(values_);
  }

 private:
  const Formula& formula_;
  std::vector<const std::vector<double>*> columns_;
  std::vector<double> values_;
};

std::vector<std::size_t> rows_where(const Table& table, const std::map<std::string, std::string>& where) {
  std::vector<std::size_t> rows;
  for (const auto& [column, text] : where)
    if (!table.words.contains(column)) throw std::invalid_argument("the output has no column '" + column + "'");
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (std::all_of(where.begin(), where.end(),
                    [&](const auto& w) { return table.words.at(w.first)[row] == w.second; }))
      rows.push_back(row);
  return rows;
}

/// A CSV file with a header; lines that begin with # are comments. Cells in quotes may hold commas.
Table read_reference(const std::filesystem::path& file) {
  std::istringstream in(format::read_text(file));
  std::vector<std::string> names;
  Table table;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        cells.emplace_back();
      else
        cells.back() += c;
    }
    if (names.empty()) {
      names = cells;
      continue;
    }
    cells.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      double number = std::numeric_limits<double>::quiet_NaN();
      std::istringstream(cells[i]) >> number;
      table.numbers[names[i]].push_back(number);
      table.words[names[i]].push_back(cells[i]);
    }
  }
  return table;
}

/// Slopes between neighbours, at the middle between them.
Points derivative_of(const Points& p) {
  Points slopes;
  for (std::size_t i = 1; i < p.x.size(); ++i) {
    slopes.x.push_back(0.5 * (p.x[i] + p.x[i - 1]));
    slopes.y.push_back((p.y[i] - p.y[i - 1]) / (p.x[i] - p.x[i - 1]));
  }
  return slopes;
}

Points points_of(const Reading& r, const Table& table, const Known& known, Points& exact) {
  RowFormula y(*r.y, table, known);
  std::optional<RowFormula> x, filter, e;
  if (r.x) x.emplace(*r.x, table, known);
  if (r.filter) filter.emplace(*r.filter, table, known);
  if (r.exact) e.emplace(*r.exact, table, known);
  Points points;
  for (const std::size_t row : rows_where(table, r.where)) {
    if (filter && (*filter)(row) == 0.0) continue;
    const double at = x ? (*x)(row) : static_cast<double>(row);
    if (r.window && !(at >= (*r.window)[0] && at <= (*r.window)[1])) continue;
    points.x.push_back(at);
    points.y.push_back(y(row));
    if (e) exact.y.push_back((*e)(row));
  }
  return r.derivative ? derivative_of(points) : points;
}

double reduce_table(const Reading& r, Reduction kind, const Table& table, const Known& known) {
  ReductionArguments arguments;
  const Points points = points_of(r, table, known, arguments.exact);
  if (r.at) arguments.at = (*r.at)(known);
  if (r.level) arguments.level = (*r.level)(known);
  if (r.frequency) arguments.frequency = (*r.frequency)(known);
  if (r.against) {
    const Table reference = read_reference(r.against->file);
    RowFormula x(*r.against->x, reference, known), y(*r.against->y, reference, known);
    for (const std::size_t row : rows_where(reference, r.against->where)) {
      const double at = x(row);
      const auto& window = r.against->window;
      if (window && !(at >= (*window)[0] && at <= (*window)[1])) continue;
      arguments.exact.x.push_back(at);
      arguments.exact.y.push_back(y(row));
    }
  }
  return reduce(kind, points, arguments);
}

double reduce_fields(const Reading& r, const RunOutput& output, const Known& known) {
  const std::vector<double> times = output.field_times();
  if (times.empty()) throw std::invalid_argument("the run wrote no fields");
  if (!r.each) {
    std::size_t moment = times.size() - 1;
    if (r.time)
      for (std::size_t i = 0; i < times.size(); ++i)
        if (std::abs(times[i] - *r.time) < std::abs(times[moment] - *r.time)) moment = i;
    return reduce_table(r, r.reduce, output.field(moment), known);
  }
  Points over_time;
  Reading whole = r;
  for (std::size_t i = 0; i < times.size(); ++i) {
    over_time.x.push_back(times[i]);
    over_time.y.push_back(reduce_table(whole, *r.each, output.field(i), known));
  }
  ReductionArguments arguments;
  if (r.at) arguments.at = (*r.at)(known);
  if (r.level) arguments.level = (*r.level)(known);
  if (r.frequency) arguments.frequency = (*r.frequency)(known);
  return reduce(r.reduce, over_time, arguments);
}

/// Everything that the result of a check may name: constants, numbers and readings of its run, and "RUN.READING".
Known names_of_result(const Verification& v, const Check& check, const std::string& run_name,
                      const std::map<std::string, RunOutput>& outputs) {
  const auto run_of = [&](const std::string& name) -> const VerificationRun& {
    return *std::find_if(v.runs.begin(), v.runs.end(), [&](const auto& r) { return r.name == name; });
  };
  Known known = known_of(v, run_of(run_name), outputs.at(run_name));
  for (const std::string& name : check.result->names()) {
    const std::size_t dot = name.find('.');
    std::string run = run_name, reading = name;
    if (dot != std::string::npos && outputs.contains(name.substr(0, dot))) {
      run = name.substr(0, dot);
      reading = name.substr(dot + 1);
      const Known other = known_of(v, run_of(run), outputs.at(run));
      if (const auto found = other.find(reading); found != other.end()) known[name] = found->second;
    }
    for (const Reading& r : v.readings)
      if (r.name == reading) try {
          known[name] = evaluate(v, r, run_of(run), outputs.at(run));
        } catch (const std::exception& e) {
          throw std::invalid_argument("reading '" + reading + "' of run '" + run + "': " + e.what());
        }
  }
  return known;
}

double distance(const Check& check, double value, double reference) {
  double error = value - reference;
  if (check.bound == Bound::at_least) error = std::max(0.0, -error);
  if (check.bound == Bound::at_most) error = std::max(0.0, error);
  return std::abs(error) / (check.measure == Measure::relative ? std::abs(reference) : 1.0);
}

}  // namespace

void add_first_columns(Table& table, const std::string& key) {
  const auto keys = table.numbers.find(key);
  if (keys == table.numbers.end()) return;
  std::map<double, std::size_t> begins;
  std::vector<std::size_t> first;
  for (std::size_t row = 0; row < keys->second.size(); ++row)
    first.push_back(begins.emplace(keys->second[row], row).first->second);
  std::map<std::string, std::vector<double>> added;
  for (const auto& [name, column] : table.numbers)
    for (const std::size_t row : first) added["first_" + name].push_back(column[row]);
  table.numbers.merge(added);
}

void add_word_columns(Table& table, const std::string& key, const std::string& word) {
  const auto keys = table.numbers.find(key);
  const auto words = table.words.find(word);
  if (keys == table.numbers.end() || words == table.words.end()) return;
  std::map<std::string, std::map<double, std::size_t>> rows;
  for (std::size_t row = 0; row < keys->second.size(); ++row) rows[words->second[row]][keys->second[row]] = row;
  std::map<std::string, std::vector<double>> added;
  for (const auto& [name, column] : table.numbers)
    for (const auto& [text, row_at] : rows)
      for (const double at : keys->second) {
        const auto row = row_at.find(at);
        added[name + "." + text].push_back(row == row_at.end() ? std::nan("") : column[row->second]);
      }
  table.numbers.merge(added);
}

double evaluate(const Verification& v, const Reading& reading, const VerificationRun& run, const RunOutput& output) {
  const Known known = known_of(v, run, output);
  if (reading.output == "fields") return reduce_fields(reading, output, known);
  return reduce_table(reading, reading.reduce, output.table(reading.output), known);
}

std::vector<std::string> runs_of(const Verification& v, const Check& check) {
  std::vector<std::string> names;
  for (const VerificationRun& run : v.runs) {
    const bool own = check.order_over.empty() ? run.name == check.run
                                              : std::find(check.order_over.begin(), check.order_over.end(), run.name) !=
                                                    check.order_over.end();
    const bool named = check.result && std::any_of(check.result->names().begin(), check.result->names().end(),
                                                   [&](const auto& n) { return n.starts_with(run.name + "."); });
    if (own || named) names.push_back(run.name);
  }
  return names;
}

Outcome evaluate(const Verification& v, const Check& check, const std::map<std::string, RunOutput>& outputs) {
  Outcome outcome;
  outcome.value = outcome.reference = outcome.error = std::numeric_limits<double>::quiet_NaN();
  try {
    for (const std::string& run : runs_of(v, check))
      if (!outputs.contains(run)) throw std::invalid_argument("run '" + run + "' did not finish");
    const std::string first = check.order_over.empty() ? check.run : check.order_over.front();
    const auto run = std::find_if(v.runs.begin(), v.runs.end(), [&](const auto& r) { return r.name == first; });
    outcome.reference = (*check.reference)(known_of(v, *run, outputs.at(first)));
    if (check.order_over.empty()) {
      outcome.value = (*check.result)(names_of_result(v, check, check.run, outputs));
    } else {
      std::vector<double> sizes, errors;
      for (const std::string& name : check.order_over) {
        sizes.push_back(outputs.at(name).numbers.at("dx"));
        errors.push_back((*check.result)(names_of_result(v, check, name, outputs)));
      }
      outcome.value = fitted_order(sizes, errors);
    }
    outcome.error = distance(check, outcome.value, outcome.reference);
    // A bound's distance is 0 for a NaN too, as max() picks the other: ask for a number.
    outcome.pass = std::isfinite(outcome.value) && outcome.error <= check.tolerance;
    if (!std::isfinite(outcome.value)) outcome.problem = "the value is not a number";
  } catch (const std::exception& e) {
    outcome.problem = e.what();
  }
  return outcome;
}

}  // namespace puffin::cases
