#include "tools/output/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tools/output/csv_file.hpp"
#include "tools/output/json_fields.hpp"

namespace puffin::output {
namespace {

/// What depends on the machine and its load.
const std::vector<std::string> about_the_machine{"wall_clock", "mlups",  "mlups_active", "memory_peak",
                                                 "threads",    "phases", "host",         "version"};

bool covers(const std::string& pattern, const std::string& name) {
  return name == pattern || (name.starts_with(pattern) && name[pattern.size()] == '.');
}

bool is_ignored(const std::string& name, const Tolerances& tolerances) {
  const auto hit = [&](const std::string& pattern) { return covers(pattern, name); };
  return name.ends_with(".seconds_saved") || std::any_of(about_the_machine.begin(), about_the_machine.end(), hit) ||
         std::any_of(tolerances.ignored.begin(), tolerances.ignored.end(), hit);
}

const Tolerance& tolerance_for(const std::string& name, const Tolerances& tolerances) {
  const Tolerance* best = &tolerances.standard;
  std::size_t longest = 0;
  for (const auto& [pattern, tolerance] : tolerances.named)
    if (pattern.size() >= longest && covers(pattern, name)) best = &tolerance, longest = pattern.size();
  return *best;
}

using Numbers = std::vector<std::pair<std::string, double>>;

/// Every number of a JSON value under its dotted name.
void collect(const Json& json, const std::string& name, Numbers& numbers) {
  if (json.is_number()) numbers.emplace_back(name, json.get<double>());
  if (json.is_object())
    for (const auto& [key, item] : json.items()) collect(item, name.empty() ? key : name + "." + key, numbers);
  if (json.is_array())
    for (std::size_t n = 0; n < json.size(); ++n) collect(json[n], name + "." + std::to_string(n), numbers);
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
  const Tolerance& tolerance = tolerance_for(name, tolerances);
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

std::string cell(const std::optional<double>& value) {
  if (!value) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", *value);
  return text;
}

}  // namespace

std::vector<Difference> compare_runs(const std::filesystem::path& a, const std::filesystem::path& b,
                                     const Tolerances& tolerances) {
  Numbers left, right;
  collect(read_json(a / "summary.json"), "", left);
  collect(read_json(b / "summary.json"), "", right);
  std::vector<Difference> differences;
  for (const auto& [name, value] : left) {
    if (is_ignored(name, tolerances)) continue;
    const double* other = find(right, name);
    const double scale = std::max(std::abs(value), other != nullptr ? std::abs(*other) : 0.0);
    differences.push_back(judged(name, &value, other, scale, tolerances));
  }
  for (const auto& [name, value] : right)
    if (!is_ignored(name, tolerances) && find(left, name) == nullptr)
      differences.push_back(judged(name, nullptr, &value, std::abs(value), tolerances));
  compare_histories(read_csv(a / "history.csv"), read_csv(b / "history.csv"), tolerances, differences);
  return differences;
}

std::string comparison_text(const std::vector<Difference>& differences) {
  std::string text;
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
    row(d.name, cell(d.a), cell(d.b), cell(d.difference), cell(d.allowed), note);
  }
  return text + std::to_string(differences.size()) + " numbers compared, " + std::to_string(outside) +
         " outside their tolerance";
}

std::string comparison_json(const std::vector<Difference>& differences) {
  Json json = Json::object();
  const auto outside =
      std::count_if(differences.begin(), differences.end(), [](const Difference& d) { return !d.within(); });
  json["ok"] = outside == 0;
  json["compared"] = differences.size();
  json["outside"] = outside;
  json["rows"] = Json::array();
  for (const Difference& d : differences)
    json["rows"].push_back({{"name", d.name},
                            {"a", number(d.a)},
                            {"b", number(d.b)},
                            {"time", number(d.time)},
                            {"difference", number(d.difference)},
                            {"allowed", number(d.allowed)},
                            {"within", d.within()}});
  return json.dump(2);
}

}  // namespace puffin::output
