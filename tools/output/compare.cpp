#include "tools/output/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tools/output/csv_file.hpp"
#include "tools/output/json_fields.hpp"

namespace puffin::output {
namespace {

/// What depends on the machine and its load, and how the run was asked for.
const std::vector<std::string> about_the_machine{"wall_clock", "mlups",         "mlups_active", "memory_peak",
                                                 "threads",    "phases",        "host",         "version",
                                                 "stop_time",  "case_stop_time"};

bool covers(const std::string& pattern, const std::string& name) {
  return name == pattern || (name.starts_with(pattern) && name[pattern.size()] == '.');
}

/// What stands in `reference` is given, or repeats a number that is judged under its own name: only who names it means
/// it.
bool is_repeated(const std::string& name, const Tolerances& tolerances) {
  return name.starts_with("reference.") && std::none_of(tolerances.named.begin(), tolerances.named.end(),
                                                        [&](const auto& given) { return covers(given.first, name); });
}

bool is_ignored(const std::string& name, const Tolerances& tolerances) {
  const auto hit = [&](const std::string& pattern) { return covers(pattern, name); };
  if (is_repeated(name, tolerances)) return true;
  return name.ends_with(".seconds_saved") || std::any_of(about_the_machine.begin(), about_the_machine.end(), hit) ||
         std::any_of(tolerances.ignored.begin(), tolerances.ignored.end(), hit);
}

/// Of the dose: what a ledger may be off by. Below it lies rounding, which differs with anything.
constexpr double of_ledgers = 1e-12;

Tolerance tolerance_for(const std::string& name, const Tolerances& tolerances) {
  const bool of_ledger = name.ends_with("ledger_error") || name.ends_with("momentum_error");
  Tolerance best = tolerances.standard;
  std::size_t longest = 0;
  for (const auto& [pattern, tolerance] : tolerances.named) {
    if (pattern == name) return tolerance;
    if (pattern.size() >= longest && covers(pattern, name)) best = tolerance, longest = pattern.size();
  }
  if (of_ledger) best.absolute = std::max(best.absolute, of_ledgers);
  return best;
}

using Numbers = std::vector<std::pair<std::string, double>>;

/// Every number of a JSON value under its dotted name.
void collect(const Json& json, const std::string& name, Numbers& numbers) {
  if (json.is_number()) numbers.emplace_back(name, json.get<double>());
  if (json.is_object())
    for (const auto& [key, item] : json.items()) collect(item, name.empty() ? key : name + "." + key, numbers);
  if (json.is_array())
    for (std::size_t n = 0; n < json.size(); ++n) {
      const bool named = json[n].is_object() && json[n].contains("name") && json[n]["name"].is_string();
      collect(json[n], name + "." + (named ? json[n]["name"].get<std::string>() : std::to_string(n)), numbers);
    }
}

const double* find(const Numbers& numbers, const std::string& name) {
  for (const auto& [key, value] : numbers)
    if (key == name) return &value;
  return nullptr;
}

Difference judged(const std::string& name, const double* a, const double* b, double scale,
                  const Tolerances& tolerances) {
  Difference d;
  d.name = name;
  if (a != nullptr) d.a = *a;
  if (b != nullptr) d.b = *b;
  const Tolerance tolerance = tolerance_for(name, tolerances);
  d.allowed = tolerance.absolute + tolerance.relative * scale;
  d.difference = a != nullptr && b != nullptr ? std::abs(*a - *b) : std::numeric_limits<double>::infinity();
  return d;
}

/// Value at `time` of a column, linear between its samples; no number outside them.
double sampled(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.end()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = static_cast<std::size_t>(after - times.begin());
  if (*after == time) return values[n];
  if (n == 0) return std::numeric_limits<double>::quiet_NaN();
  const double part = (time - times[n - 1]) / (times[n] - times[n - 1]);
  return values[n - 1] + part * (values[n] - values[n - 1]);
}

void compare_histories(const CsvTable& a, const CsvTable& b, const Tolerances& tolerances,
                       std::vector<Difference>& differences) {
  const std::vector<double> times = a.numbers("time"), other_times = b.numbers("time");
  for (const std::string& column : a.columns) {
    const std::string name = "history." + column;
    if (column == "time" || b.find(column) < 0 || is_ignored(name, tolerances)) continue;
    const std::vector<double> ours = a.numbers(column), theirs = b.numbers(column);
    double scale = 0.0, worst = -1.0;
    std::size_t at = 0;
    for (std::size_t n = 0; n < times.size(); ++n) {
      const double other = sampled(other_times, theirs, times[n]);
      if (!std::isfinite(other) || !std::isfinite(ours[n])) continue;
      scale = std::max({scale, std::abs(ours[n]), std::abs(other)});
      if (std::abs(ours[n] - other) > worst) worst = std::abs(ours[n] - other), at = n;
    }
    if (worst < 0.0) continue;  // no common time
    const double other = sampled(other_times, theirs, times[at]);
    differences.push_back(judged(name, &ours[at], &other, scale, tolerances));
    differences.back().time = times[at];
  }
}

/// How each run ended, if differently: a number that is equal by chance proves nothing then.
void compare_states(const ComparedRun& a, const ComparedRun& b, std::vector<Difference>& differences) {
  if (a.state == b.state) return;
  Difference d;
  d.name = "state";
  d.said_a = a.state, d.said_b = b.state;
  d.difference = std::numeric_limits<double>::infinity();
  differences.push_back(d);
}

ComparedRun described(const std::filesystem::path& folder, const Json& summary) {
  ComparedRun run;
  run.folder = folder.string();
  const JsonReader read{summary};
  read("name", run.name);
  read("state", run.state);
  read("simulated_time", run.time);
  return run;
}

/// The only set of fines of each run stands beside that of the other: B's takes the name of A's.
void pair_fines(const Json& a, Json& b, std::vector<std::string>& notes) {
  if (!a.contains("fines") || !b.contains("fines") || a["fines"].size() != 1 || b["fines"].size() != 1) return;
  const std::string ours = a["fines"].begin().key(), theirs = b["fines"].begin().key();
  if (ours == theirs) return;
  b["fines"] = Json{{ours, Json(b["fines"][theirs])}};
  notes.push_back("fines: \"" + ours + "\" of A beside \"" + theirs + "\" of B");
}

/// Summaries of before have no flow rate beside their pressure drops.
bool is_newer(const std::string& name, const double* other) {
  return other == nullptr && covers("pressure.flow_rate", name);
}

std::string cell(const std::optional<double>& value) {
  if (!value) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", *value);
  return text;
}

/// Names in the tolerances that fit no number of either run: most likely misspelt, and so without effect.
std::vector<std::string> unused_names(const Tolerances& tolerances, const Numbers& left, const Numbers& right,
                                      const std::vector<std::string>& columns) {
  const auto fits = [&](const std::string& pattern) {
    const auto hit = [&](const auto& number) { return covers(pattern, number.first); };
    return std::any_of(left.begin(), left.end(), hit) || std::any_of(right.begin(), right.end(), hit) ||
           std::any_of(columns.begin(), columns.end(),
                       [&](const std::string& column) { return covers(pattern, "history." + column); });
  };
  std::vector<std::string> unused;
  for (const auto& [pattern, tolerance] : tolerances.named)
    if (!fits(pattern)) unused.push_back(pattern);
  for (const std::string& pattern : tolerances.ignored)
    if (!fits(pattern)) unused.push_back(pattern);
  return unused;
}

}  // namespace

Comparison compare_runs(const std::filesystem::path& a, const std::filesystem::path& b, const Tolerances& tolerances) {
  const Json ours = read_json(a / "summary.json");
  Json theirs = read_json(b / "summary.json");
  Comparison result;
  result.a = described(a, ours), result.b = described(b, theirs);
  pair_fines(ours, theirs, result.notes);
  Numbers left, right;
  collect(ours, "", left);
  collect(theirs, "", right);
  std::vector<Difference>& differences = result.differences;
  compare_states(result.a, result.b, differences);
  for (const auto& [name, value] : left) {
    if (is_ignored(name, tolerances)) continue;
    const double* other = find(right, name);
    if (is_newer(name, other)) continue;
    const double scale = std::max(std::abs(value), other != nullptr ? std::abs(*other) : 0.0);
    differences.push_back(judged(name, &value, other, scale, tolerances));
  }
  for (const auto& [name, value] : right)
    if (!is_ignored(name, tolerances) && find(left, name) == nullptr && !is_newer(name, nullptr))
      differences.push_back(judged(name, nullptr, &value, std::abs(value), tolerances));
  const CsvTable history = read_csv(a / "history.csv"), other = read_csv(b / "history.csv");
  compare_histories(history, other, tolerances, differences);
  const double shorter = std::min(result.a.time, result.b.time), longer = std::max(result.a.time, result.b.time);
  if (shorter < 0.999 * longer)
    result.notes.push_back("histories: compared up to " + cell(shorter) + " s, where " +
                           (result.a.time < result.b.time ? "A" : "B") + " ends; the other goes on to " + cell(longer) +
                           " s");
  result.unused = unused_names(tolerances, left, right, history.columns);
  return result;
}

std::string comparison_text(const Comparison& comparison) {
  const std::vector<Difference>& differences = comparison.differences;
  std::string text, head;
  for (const auto& [letter, run] : {std::pair("A", &comparison.a), std::pair("B", &comparison.b)})
    head += std::string(letter) + "  " + run->folder + ": " + run->name + ", " + run->state + " at " + cell(run->time) +
            " s\n";
  std::size_t outside = 0, width = 8;
  for (const Difference& d : differences)
    if (d.difference != 0.0) width = std::max(width, d.name.size());
  char line[256];
  const auto row = [&](const std::string& name, const std::string& a, const std::string& b, const std::string& by,
                       const std::string& allowed, const std::string& note) {
    std::snprintf(line, sizeof line, "  %13s %13s %12s %12s  %s\n", a.c_str(), b.c_str(), by.c_str(), allowed.c_str(),
                  note.c_str());
    text += name + std::string(width - std::min(width, name.size()), ' ') + line;
  };
  for (const Difference& d : differences) {
    if (!d.within()) ++outside;
    if (d.difference == 0.0) continue;
    if (text.empty()) row("quantity", "A", "B", "difference", "allowed", "");
    std::string note = d.within() ? "" : "OUTSIDE";
    if (d.time) note += (note.empty() ? "at " : " at ") + cell(d.time) + " s";
    if (!d.said_a.empty())
      row(d.name, d.said_a, d.said_b, "", "", note);
    else
      row(d.name, cell(d.a), cell(d.b), cell(d.difference), cell(d.allowed), note);
  }
  for (const std::string& note : comparison.notes) text += note + "\n";
  return head + text + std::to_string(differences.size()) + " numbers compared, " + std::to_string(outside) +
         " outside their tolerance";
}

std::string comparison_json(const Comparison& comparison) {
  const std::vector<Difference>& differences = comparison.differences;
  Json json = Json::object();
  const auto outside =
      std::count_if(differences.begin(), differences.end(), [](const Difference& d) { return !d.within(); });
  json["ok"] = outside == 0;
  json["compared"] = differences.size();
  json["outside"] = outside;
  for (const auto& [letter, run] : {std::pair("a", &comparison.a), std::pair("b", &comparison.b)})
    json[letter] = {
        {"folder", run->folder}, {"name", run->name}, {"state", run->state}, {"simulated_time", number(run->time)}};
  json["notes"] = comparison.notes;
  json["rows"] = Json::array();
  for (const Difference& d : differences)
    json["rows"].push_back({{"name", d.name},
                            {"a", d.said_a.empty() ? number(d.a) : Json(d.said_a)},
                            {"b", d.said_b.empty() ? number(d.b) : Json(d.said_b)},
                            {"time", number(d.time)},
                            {"difference", number(d.difference)},
                            {"allowed", number(d.allowed)},
                            {"within", d.within()}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace puffin::output
