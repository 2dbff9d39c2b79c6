#include <algorithm>
#include <stdexcept>

#include "cases/format/read_fields.hpp"
#include "cases/spelling.hpp"
#include "cases/verification/overrides.hpp"
#include "cases/verification/pareto.hpp"

namespace puffin::cases {
namespace {

using format::Fields;
using format::otherwise;
using format::Range;
using format::required;

void describe(Fields& io, ParetoSetting& s) {
  io.text("label", s.label, required);
  s.sets = overrides(io, "set");
  io.flag("quick", s.quick, otherwise(false));
}

void describe(Fields& io, ParetoAxis& axis) {
  io.text("name", axis.name, required);
  io.list("setting", axis.settings, [](Fields& f, ParetoSetting& s) { describe(f, s); });
  if (axis.settings.empty()) io.problem("setting", "an axis needs at least one [[axis.setting]]");
}

/// The run of the verification that the settings are variations of.
void take_run(Fields& io, ParetoCase& c) {
  std::string name = c.verification.runs.back().name;
  io.text("run", name, otherwise(name));
  const auto run = std::find_if(c.verification.runs.begin(), c.verification.runs.end(),
                                [&](const VerificationRun& r) { return r.name == name; });
  if (run == c.verification.runs.end()) {
    io.problem("run", "the verification has no run '" + name + "'");
    return;
  }
  VerificationRun base = *run;
  base.name = pareto_run;
  c.verification.runs = {base};
}

void take_check(Fields& io, ParetoCase& c) {
  std::string quantity;
  io.text("check", quantity, required);
  const auto& checks = c.verification.checks;
  const auto check = std::find_if(checks.begin(), checks.end(), [&](const Check& k) { return k.quantity == quantity; });
  if (check == checks.end()) {
    std::vector<std::string> known;
    known.reserve(checks.size());
    for (const Check& k : checks) known.push_back("'" + k.quantity + "'");
    if (!quantity.empty())
      io.problem("check", "the verification has no check '" + quantity + "'; it has " + join(known));
    return;
  }
  c.check = *check;
  c.check.run = pareto_run;
  if (!c.check.order_over.empty()) io.problem("check", "an order needs several runs: it is no error of one setting");
  io.text("metric", c.metric, otherwise(quantity));
  if (!io.has("half_width", false)) return;
  std::string formula;
  io.text("half_width", formula, required);
  try {
    Check width = c.check;
    width.result = Formula(formula);
    width.reference = Formula("0");
    width.measure = Measure::absolute;
    c.half_width = width;
  } catch (const std::invalid_argument& e) {
    io.problem("half_width", e.what());
  }
}

void take_products(Fields& io, ParetoCase& c) {
  std::vector<std::string> texts;
  io.texts("products", texts, otherwise(texts));
  for (const std::string& text : texts) {
    std::vector<std::string> names;
    for (std::size_t at = 0; at <= text.size();) {
      const std::size_t end = std::min(text.find('*', at), text.size());
      std::string name = text.substr(at, end - at);
      name.erase(0, name.find_first_not_of(' '));
      name.erase(name.find_last_not_of(' ') + 1);
      if (std::none_of(c.axes.begin(), c.axes.end(), [&](const ParetoAxis& a) { return a.name == name; }))
        io.problem("products", "there is no axis '" + name + "'; a product reads \"dx * lattice_speed\"");
      names.push_back(name);
      at = end + 1;
    }
    c.products.push_back(names);
  }
}

void describe(Fields& io, ParetoCase& c) {
  io.text("id", c.id, required);
  io.text("title", c.title, required);
  io.flag("quick", c.quick, otherwise(true));
  std::int64_t repeats = c.repeats;
  io.integer("repeats", repeats, Range::positive, otherwise<std::int64_t>(1));
  c.repeats = static_cast<int>(repeats);
  std::string folder = ".";
  io.text("verify", folder, otherwise(folder));
  c.verification = read_verification((c.folder / folder).lexically_normal());
  take_run(io, c);
  take_check(io, c);
  io.number("reference_uncertainty", c.reference_uncertainty, unit::number, Range::non_negative, otherwise(0.0));
  c.sets = overrides(io, "set");
  c.quick_sets = overrides(io, "quick_set");
  io.list("variant", c.variants, [](Fields& f, ParetoSetting& s) { describe(f, s); });
  io.list("reference", c.references, [](Fields& f, ParetoSetting& s) { describe(f, s); });
  io.list("axis", c.axes, [](Fields& f, ParetoAxis& a) { describe(f, a); });
  take_products(io, c);
}

const ParetoAxis& axis_of(const ParetoCase& c, const std::string& name) {
  return *std::find_if(c.axes.begin(), c.axes.end(), [&](const ParetoAxis& a) { return a.name == name; });
}

}  // namespace

std::vector<ParetoPoint> points_of(const ParetoCase& c, bool quick) {
  std::vector<ParetoPoint> points{{"", "default", {}}};
  for (const ParetoAxis& axis : c.axes)
    for (const ParetoSetting& s : axis.settings)
      if (s.quick || !quick) points.push_back({axis.name, s.label, s.sets});
  if (quick) return points;
  for (const auto& names : c.products) {
    std::vector<ParetoPoint> grid{{"", "", {}}};
    for (const std::string& name : names) {
      std::vector<ParetoPoint> finer;
      for (const ParetoPoint& p : grid)
        for (const ParetoSetting& s : axis_of(c, name).settings) {
          ParetoPoint q = p;
          q.axis += (q.axis.empty() ? "" : " x ") + name;
          q.label += (q.label.empty() ? "" : ", ") + s.label;
          q.sets.insert(q.sets.end(), s.sets.begin(), s.sets.end());
          finer.push_back(q);
        }
      grid = finer;
    }
    points.insert(points.end(), grid.begin(), grid.end());
  }
  return points;
}

std::vector<ParetoSetting> references_of(const ParetoCase& c, bool quick) {
  std::vector<ParetoSetting> fitting = c.references;
  std::erase_if(fitting, [quick](const ParetoSetting& s) { return s.quick != quick; });
  return fitting.empty() ? c.references : fitting;
}

std::vector<VerificationRun> runs_of(const ParetoCase& c, const std::vector<Override>& sets, bool quick) {
  VerificationRun base = c.verification.runs.front();
  base.sets.insert(base.sets.end(), c.sets.begin(), c.sets.end());
  if (quick) base.sets.insert(base.sets.end(), c.quick_sets.begin(), c.quick_sets.end());
  std::vector<VerificationRun> runs;
  for (const ParetoSetting& variant : c.variants) {
    if (quick && !variant.quick) continue;
    runs.push_back(base);
    runs.back().sets.insert(runs.back().sets.end(), variant.sets.begin(), variant.sets.end());
  }
  if (runs.empty()) runs.push_back(base);
  for (VerificationRun& run : runs) run.sets.insert(run.sets.end(), sets.begin(), sets.end());
  return runs;
}

ParetoCase read_pareto(const std::filesystem::path& folder) {
  ParetoCase c;
  c.folder = folder;
  format::read_fields(folder / "pareto.toml", [&](Fields& f) { describe(f, c); });
  return c;
}

std::vector<ParetoCase> read_pareto_cases(const std::filesystem::path& folder) {
  std::vector<ParetoCase> list;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::filesystem::exists(entry.path() / "pareto.toml")) list.push_back(read_pareto(entry.path()));
  std::sort(list.begin(), list.end(), [](const ParetoCase& a, const ParetoCase& b) { return a.id < b.id; });
  return list;
}

}  // namespace puffin::cases
