#include "tools/puffin/arguments.hpp"

#include <CLI/CLI.hpp>

#include "cases/presets.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {

double positive_quantity(const std::string& text, const cases::Unit& unit, const std::string& what) try {
  const double value = cases::parse_quantity(text, unit);
  if (!(value > 0.0)) throw UsageError(what + " " + text + ": must be positive");
  return value;
} catch (const cases::UnitError& e) {
  throw UsageError(what + ": " + e.what());
}

void CaseArguments::add_to(CLI::App& app) {
  std::vector<std::string> names;
  for (const cases::Preset& p : cases::presets()) names.emplace_back(p.name);
  app.add_option("case", file, "the case file")->required()->type_name("CASE.toml");
  app.add_option("--preset", preset, "how fine and how long: quick, fast, default, accurate")
      ->check(CLI::IsMember(names))
      ->type_name("NAME");
  app.add_option("--set", sets, "change a value: a dotted key and a TOML value; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  app.add_flag("--json", json, "one JSON object on stdout");
}

std::vector<cases::Override> CaseArguments::overrides() const try {
  std::vector<cases::Override> list;
  for (const std::string& set : sets) list.push_back(cases::parse_override(set));
  return list;
} catch (const std::invalid_argument& e) {
  throw UsageError(e.what());
}

cases::Case CaseArguments::read() const { return cases::read_case(file, overrides(), preset); }

}  // namespace puffin::tools
