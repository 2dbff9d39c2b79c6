#include "cases/study.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <stdexcept>

#include "cases/format/toml_fields.hpp"
#include "cases/format/toml_file.hpp"
#include "cases/sweep.hpp"
#include "cases/toml_string.hpp"
#include "cases/units.hpp"

namespace puffin::cases {
namespace {

using format::Findings;
using format::Place;

constexpr std::array methods{Choice{0, "list", true}, Choice{1, "factorial", true}, Choice{2, "lhs", true}};

Place place_of(const toml::node& node, const Findings& findings) {
  const toml::source_position at = node.source().begin;
  return {findings.file(), static_cast<int>(at.line), static_cast<int>(at.column)};
}

/// A value as it would stand in a TOML file.
std::string text_of(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return shortest(*number);  // not 0.018 as 0.017999999999999999
  toml::table holder;
  holder.insert_or_assign("v", node);
  if (toml::table* t = holder.get("v")->as_table()) t->is_inline(true);
  std::ostringstream text;
  text << holder;
  return text.str().substr(text.str().find('=') + 2);
}

struct Change {
  std::string key;
  const toml::node* value;
};

/// The values below a table of changes: keys are dotted, or nested tables; a table in braces is a value.
void collect(const toml::table& table, const std::string& path, std::vector<Change>& changes) {
  for (auto&& [k, node] : table) {
    const std::string key = path + std::string(k.str());
    const toml::table* inner = node.as_table();
    if (inner && !inner->is_inline())
      collect(*inner, key + ".", changes);
    else
      changes.push_back({key, &node});
  }
}

std::vector<Change> changes_in(const toml::node* node, const std::string& key, Findings& findings) {
  std::vector<Change> changes;
  if (!node) return changes;
  if (const toml::table* table = node->as_table())
    collect(*table, "", changes);
  else
    findings.problem(key, place_of(*node, findings),
                     key + ": must be a table of dotted keys, like { \"carriers.count\" = 1000 }");
  return changes;
}

std::optional<double> number_of(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* text = node.as_string()) try {
      return parse_quantity(text->get()).value;
    } catch (const UnitError&) {
    }
  return std::nullopt;
}

/// The keys that a case takes whole numbers for (`integer` in cases/format); on any other one [0, 1] are but two ends.
bool takes_whole_numbers(const std::string& key) {
  constexpr std::array<std::string_view, 8> names{"count",   "parcel", "cells",  "coupling_interval",
                                                  "threads", "seed",   "points", "keep"};
  const std::string_view last = std::string_view(key).substr(key.rfind('.') + 1);
  return std::find(names.begin(), names.end(), last) != names.end();
}

SweepRange range_of(const Change& change, Findings& findings) {
  SweepRange r;
  r.key = change.key;
  const toml::array* list = change.value->as_array();
  if (!list || list->empty()) {
    findings.problem(r.key, place_of(*change.value, findings), r.key + ": must be a list of values, like [0.1, 0.6]");
    return r;
  }
  r.whole = takes_whole_numbers(r.key);
  for (const toml::node& element : *list) {
    r.texts.push_back(text_of(element));
    if (const auto number = number_of(element)) r.numbers.push_back(*number);
    r.whole = r.whole && element.is_integer();
  }
  if (r.numbers.size() != r.texts.size()) r.numbers.clear();
  return r;
}

constexpr std::int64_t most_replicates = 1000;
constexpr std::size_t most_runs = 100000;

struct Sweep {
  int method = 0;
  std::int64_t samples = 0, seed = 1;
};

struct Draft {
  std::string base, experiments;
  std::vector<std::string> share;
  std::int64_t replicates = 1;
  std::vector<StudyCase> cases;
  std::optional<Sweep> sweep;
};

void describe(format::TomlFields& io, Draft& d) {
  if (io.has("base", false)) io.file("base", d.base, {});
  io.texts("share", d.share, format::otherwise(std::vector<std::string>{}));
  io.integer("replicates", d.replicates, format::Range::positive, format::otherwise<std::int64_t>(1));
  if (io.has("experiments", false)) io.file("experiments", d.experiments, {});
  io.list("case", d.cases, [](format::Fields& f, StudyCase& c) {
    f.text("name", c.name, format::required);
    std::string base;
    if (f.has("base", false)) f.file("base", base, {});
    c.base = base;
    f.has("set", false);
  });
  if (!io.has("sweep", false)) return;
  d.sweep.emplace();
  io.section("sweep", [&](format::Fields& f) {
    d.sweep->method = f.pick("method", methods, 0, format::required);
    f.integer("samples", d.sweep->samples, format::Range::positive, format::otherwise<std::int64_t>(0));
    f.integer("seed", d.sweep->seed, format::Range::non_negative, format::otherwise<std::int64_t>(1));
    if (!f.has("range", false)) f.problem("range", "missing table [sweep.range]");
  });
}

Share share_of(const std::vector<std::string>& words, format::TomlFields& io) {
  Share s;
  for (const std::string& word : words) {
    if (word == "geometry")
      s.geometry = true;
    else if (word == "scalars")
      s.scalars = true;
    else if (word == "micromodels")
      s.micromodels = true;
    else if (word == "start")
      s.start = true;
    else if (word == "one-way-flow")
      s.one_way_flow = true;
    else
      io.problem("share", "'" + word + "' is none of geometry, scalars, micromodels, start, one-way-flow");
  }
  return s;
}

void add(StudyCase& c, const std::string& key, const std::string& value, const Place& where) {
  std::erase_if(c.sets, [&](const Override& o) { return o.key == key; });
  c.sets.push_back({key, value});
  c.where[key] = {where.file, where.line, where.column};
}

/// Every case at every point of the sweep.
std::vector<StudyCase> swept(const std::vector<StudyCase>& cases, const Sweep& sweep, const toml::node* range,
                             Findings& findings) {
  std::vector<SweepRange> ranges;
  std::vector<Place> places;
  for (const Change& change : changes_in(range, "sweep.range", findings)) {
    ranges.push_back(range_of(change, findings));
    places.push_back(place_of(*change.value, findings));
  }
  if (!findings.problems().empty()) return cases;
  std::vector<StudyCase> all;
  try {
    const auto points = sweep_points(static_cast<SweepMethod>(sweep.method), ranges, sweep.samples,
                                     static_cast<std::uint64_t>(sweep.seed));
    if (cases.size() * points.size() > most_runs)
      throw std::invalid_argument("the sweep has " + std::to_string(points.size()) + " points, for each of " +
                                  std::to_string(cases.size()) + " cases: at most 100000 runs");
    for (const StudyCase& c : cases)
      for (std::size_t n = 0; n < points.size(); ++n) {
        all.push_back(c);
        all.back().name += '-';
        all.back().name += std::to_string(n + 1);
        for (std::size_t k = 0; k < ranges.size(); ++k) {
          add(all.back(), ranges[k].key, points[n][k], places[k]);
          all.back().swept.push_back(ranges[k].key);
        }
      }
  } catch (const std::invalid_argument& e) {
    findings.problem("sweep", e.what());
  }
  return all;
}

/// The name that a case file gives itself, for a study without [[case]].
std::string name_in(const std::string& base) {
  const toml::table root = format::parse_toml(format::read_text(base), base);
  return root["name"].value_or(std::string("case"));
}

void check_names(const std::vector<StudyCase>& cases, Findings& findings) {
  std::set<std::string> seen;
  for (std::size_t n = 0; n < cases.size(); ++n)
    if (!seen.insert(cases[n].name).second)
      findings.problem("case[" + std::to_string(n) + "].name", "two cases are called '" + cases[n].name + "'");
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
  const std::string name = file.string(), text = format::read_text(file);
  const toml::table root = format::parse_toml(text, name);
  if (format::describes_case(root))
    throw CaseError(
        {{name, 1, 1, "", "this is a case, not a study: run it with puffin run, or name it as the base of a study"}});
  Findings findings(name, text);
  format::TomlFields fields(root, "", findings, file.parent_path());
  Draft d;
  describe(fields, d);
  fields.finish();
  Study study;
  study.file = file;
  study.share = share_of(d.share, fields);
  study.experiments = d.experiments;
  if (d.replicates > most_replicates)
    findings.problem("replicates",
                     "replicates = " + std::to_string(d.replicates) + ": at most " + std::to_string(most_replicates));
  study.replicates = static_cast<int>(std::min(d.replicates, most_replicates));
  if (d.cases.empty() && d.base.empty() && findings.problems().empty())
    findings.problem("base", {name, 1, 1}, "missing key 'base': the case file that the study starts from");
  const bool alone = d.cases.empty();
  if (alone && findings.problems().empty()) d.cases.push_back({name_in(d.base), d.base, {}, {}, {}});
  for (std::size_t n = 0; n < d.cases.size(); ++n) {
    StudyCase& c = d.cases[n];
    const std::string key = "case[" + std::to_string(n) + "]";
    if (c.base.empty()) c.base = d.base;
    if (!c.base.empty()) c.base = std::filesystem::weakly_canonical(c.base);  // the same from every folder
    if (c.base.empty() && !findings.broken("base") && !findings.broken(key))
      findings.problem(key, "[[case]] has no base, and neither has the study: give base = \"case.toml\"");
    const toml::node* set = alone ? nullptr : root["case"][n]["set"].node();
    for (const Change& change : changes_in(set, key + ".set", findings))
      add(c, change.key, text_of(*change.value), place_of(*change.value, findings));
  }
  if (d.sweep && findings.problems().empty())
    d.cases = swept(d.cases, *d.sweep, root["sweep"]["range"].node(), findings);
  check_names(d.cases, findings);
  if (d.cases.size() * static_cast<std::size_t>(study.replicates) > most_runs)
    findings.problem("replicates", std::to_string(study.replicates) + " replicates of " +
                                       std::to_string(d.cases.size()) + " cases: at most 100000 runs");
  if (!findings.problems().empty()) throw CaseError(findings.sorted_problems());
  study.cases = std::move(d.cases);
  return study;
}

std::vector<Override> overrides_of(const StudyCase& c, int replicate) {
  std::vector<Override> sets = c.sets;
  if (std::none_of(sets.begin(), sets.end(), [](const Override& o) { return o.key == "name"; }))
    sets.push_back({"name", toml_string(c.name)});
  if (replicate == 0) return sets;
  const Case own = read_case(c.base, c.sets);
  std::erase_if(sets, [](const Override& o) { return o.key == "numerics.seed"; });
  sets.push_back({"numerics.seed", std::to_string(own.numerics.seed + static_cast<std::uint64_t>(replicate))});
  return sets;
}

Case read_study_case(const StudyCase& c, int replicate, std::string_view preset) try {
  return read_case(c.base, overrides_of(c, replicate), preset);
} catch (const CaseError& e) {
  std::vector<Problem> problems = e.problems;
  for (Problem& p : problems)
    if (p.file.starts_with("--set "))
      if (const auto found = c.where.find(p.file.substr(6)); found != c.where.end())
        p.file = found->second.file, p.line = found->second.line, p.column = found->second.column;
  throw CaseError(problems);
}

}  // namespace puffin::cases
