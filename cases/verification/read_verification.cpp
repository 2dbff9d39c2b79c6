#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "cases/format/read_fields.hpp"
#include "cases/spelling.hpp"
#include "cases/verification/overrides.hpp"
#include "cases/verification/verification.hpp"

namespace puffin::cases {
namespace {

using format::Fields;
using format::otherwise;
using format::Range;
using format::required;
using format::Shape;

constexpr std::array suites{Choice{0, "flow", true}, Choice{1, "scalar", true}, Choice{2, "dem", true},
                            Choice{3, "coupling", true}};
constexpr std::array measures{Choice{0, "absolute", true}, Choice{1, "relative", true}};
constexpr std::array bounds{Choice{0, "both", true}, Choice{1, "at-least", true}, Choice{2, "at-most", true}};
constexpr std::array outputs{
    Choice{0, "history.csv", true}, Choice{1, "stats.h5", true},   Choice{2, "probes.csv", true},
    Choice{3, "lines.csv", true},   Choice{4, "planes.csv", true}, Choice{5, "forces.csv", true},
    Choice{6, "tracks.csv", true},  Choice{7, "events.h5", true},  Choice{8, "fields", true}};

const std::vector<Choice>& reduction_words() {
  static const std::vector<Choice> words = [] {
    std::vector<Choice> list;
    for (const ReductionName& r : reductions()) list.push_back({static_cast<int>(r.reduction), r.name, true});
    return list;
  }();
  return words;
}

std::optional<Formula> to_formula(Fields& io, std::string_view key, const std::string& text) try {
  return Formula(text);
} catch (const std::invalid_argument& e) {
  io.problem(key, e.what());
  return std::nullopt;
}

/// A number or a formula in quotes; absent: nothing.
std::optional<Formula> formula(Fields& io, std::string_view key, bool must = false) {
  const Shape shape = io.shape(key, Shape::absent);
  if (shape == Shape::absent && !must) return std::nullopt;
  if (shape == Shape::number) {
    double number = 0.0;
    io.number(key, number, unit::number, Range::any, required);
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", std::abs(number));
    return to_formula(io, key, (number < 0.0 ? "-" : "") + std::string(text));
  }
  std::string text;
  io.text(key, text, required);
  return text.empty() ? std::nullopt : to_formula(io, key, text);
}

std::vector<Constant> constants(Fields& io) {
  std::vector<std::string> lines;
  io.texts("constants", lines, otherwise(lines));
  std::vector<Constant> list;
  for (const std::string& line : lines) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) {
      io.problem("constants", "'" + line + "' must read \"name = formula\"");
      continue;
    }
    std::string name = line.substr(0, equals);
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    if (auto f = to_formula(io, "constants", line.substr(equals + 1))) list.push_back({name, *f});
  }
  return list;
}

std::map<std::string, std::string> where(Fields& io) {
  std::map<std::string, Parameter> given;
  io.section("where", [&](Fields& f) {
    f.everything(
        given, [](const std::string&) { return nullptr; }, false);
  });
  std::map<std::string, std::string> rows;
  for (const auto& [column, value] : given) {
    if (const auto* text = std::get_if<std::string>(&value))
      rows[column] = *text;
    else
      io.problem("where", "'" + column + "' must be a text in quotes; for numbers use filter");
  }
  return rows;
}

std::optional<std::array<double, 2>> window(Fields& io) {
  if (!io.has("window", false)) return std::nullopt;
  std::vector<double> ends{0.0, 0.0};
  io.numbers("window", ends, 2, unit::number, required);
  if (ends.size() != 2) return std::nullopt;
  return std::array<double, 2>{ends[0], ends[1]};
}

void describe(Fields& io, VerificationRun& run, const std::filesystem::path& folder) {
  io.text("name", run.name, required);
  if (run.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") !=
      std::string::npos)
    io.problem("name", "a run's name holds letters, digits and '_' only");
  io.text("label", run.label, otherwise(run.name));
  std::string file = (folder / "case.toml").string();
  if (io.has("case", false)) io.file("case", file, {});
  run.case_file = file;
  io.flag("quick", run.quick, otherwise(true));
  run.sets = overrides(io, "set");
  run.constants = constants(io);
}

void describe(Fields& io, Reading& r) {
  io.text("name", r.name, required);
  r.output = outputs[static_cast<std::size_t>(io.pick("output", outputs, 0, required))].name;
  r.where = where(io);
  r.filter = formula(io, "filter");
  r.x = formula(io, "x");
  r.y = formula(io, "y", true);
  r.window = window(io);
  if (r.window && !r.x) io.problem("window", "a window needs 'x', of which it is a range");
  io.flag("derivative", r.derivative, otherwise(false));
  if (r.derivative && (!r.x || r.exact)) io.problem("derivative", "needs 'x', and takes 'against' rather than 'exact'");
  if (io.has("time", false)) {
    double time = 0.0;
    io.number("time", time, unit::time, Range::non_negative, required);
    r.time = time;
  }
  if (io.has("each", false)) r.each = static_cast<Reduction>(io.pick("each", reduction_words(), 0, required));
  if ((r.each || r.time) && r.output != "fields") io.problem("output", "'each' and 'time' are for output = \"fields\"");
  r.reduce = static_cast<Reduction>(io.pick("reduce", reduction_words(), 0, required));
  r.at = formula(io, "at");
  r.level = formula(io, "level");
  r.frequency = formula(io, "frequency");
  r.exact = formula(io, "exact");
  if (io.has("against", false)) {
    ReferenceCurve curve;
    io.section("against", [&](Fields& f) {
      std::string file;
      f.file("file", file, {});
      curve.file = file;
      curve.where = where(f);
      curve.x = formula(f, "x", true);
      curve.y = formula(f, "y", true);
      curve.window = window(f);
    });
    r.against = curve;
  }
  if (r.exact && r.against) io.problem("exact", "give 'exact' or 'against', not both");
}

/// A check as the file has it: `runs` makes one line of the results for each.
struct CheckOfRuns {
  Check check;
  std::vector<std::string> runs;
};

void describe(Fields& io, CheckOfRuns& many, const Verification& v) {
  Check& c = many.check;
  io.text("quantity", c.quantity, required);
  c.result = formula(io, "result", true);
  std::vector<std::string> names;
  for (const VerificationRun& run : v.runs) names.push_back(run.name);
  const auto known = [&](std::string_view key, const std::string& run) {
    if (std::find(names.begin(), names.end(), run) == names.end())
      io.problem(key, "there is no run '" + run + "'; the runs are " + join(names));
  };
  io.text("run", c.run, otherwise(names.empty() ? std::string() : names.back()));
  known("run", c.run);
  io.texts("runs", many.runs, otherwise(many.runs));
  for (const std::string& run : many.runs) known("runs", run);
  io.texts("order_over", c.order_over, otherwise(c.order_over));
  for (const std::string& run : c.order_over) known("order_over", run);
  if (c.order_over.size() == 1) io.problem("order_over", "an order needs at least two runs");
  if (!many.runs.empty() && (io.has("run", false) || !c.order_over.empty()))
    io.problem("runs", "a check has one of 'run', 'runs' and 'order_over'");
  c.reference = formula(io, "reference", true);
  io.number("tolerance", c.tolerance, unit::number, Range::non_negative, required);
  c.measure = static_cast<Measure>(io.pick("measure", measures, 0, required));
  c.bound = static_cast<Bound>(io.pick("bound", bounds, 0, otherwise(0)));
  io.text("reason", c.reason, required);
  io.text("source", c.source, otherwise(v.source));
}

/// The check itself, or one of each of its runs: "QUANTITY, LABEL OF THE RUN".
void append(std::vector<Check>& checks, const CheckOfRuns& many, const std::vector<VerificationRun>& runs) {
  if (many.runs.empty()) checks.push_back(many.check);
  for (const std::string& name : many.runs)
    for (const VerificationRun& run : runs) {
      if (run.name != name) continue;
      checks.push_back(many.check);
      checks.back().run = name;
      checks.back().quantity += ", " + run.label;
    }
}

void describe(Fields& io, Verification& v) {
  io.text("id", v.id, required);
  v.suite = suites[static_cast<std::size_t>(io.pick("suite", suites, 0, required))].name;
  io.text("title", v.title, required);
  io.text("source", v.source, required);
  v.constants = constants(io);
  io.list("run", v.runs, [&](Fields& f, VerificationRun& run) { describe(f, run, v.folder); });
  if (v.runs.empty()) io.problem("run", "at least one [[run]] is needed");
  io.list("reading", v.readings, [](Fields& f, Reading& r) { describe(f, r); });
  std::vector<CheckOfRuns> checks;
  io.list("check", checks, [&](Fields& f, CheckOfRuns& c) { describe(f, c, v); });
  for (const CheckOfRuns& many : checks) append(v.checks, many, v.runs);
  if (v.checks.empty()) io.problem("check", "at least one [[check]] is needed");
}

}  // namespace

Verification read_verification(const std::filesystem::path& folder) {
  Verification v;
  v.folder = folder;
  format::read_fields(folder / "verify.toml", [&](Fields& f) { describe(f, v); });
  return v;
}

std::vector<Verification> read_catalogue(const std::filesystem::path& folder) {
  std::vector<Verification> list;
  std::vector<Problem> problems;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!std::filesystem::exists(entry.path() / "verify.toml")) continue;
    try {
      list.push_back(read_verification(entry.path()));
    } catch (const CaseError& e) {
      problems.insert(problems.end(), e.problems.begin(), e.problems.end());
    }
  }
  if (!problems.empty()) throw CaseError(problems);
  std::sort(list.begin(), list.end(), [](const Verification& a, const Verification& b) { return a.id < b.id; });
  for (std::size_t i = 1; i < list.size(); ++i)
    if (list[i].id == list[i - 1].id)
      throw std::invalid_argument(list[i].folder.string() + " and " + list[i - 1].folder.string() +
                                  " have the same id '" + list[i].id + "'");
  return list;
}

}  // namespace puffin::cases
