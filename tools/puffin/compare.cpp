// puffin compare: two runs, number by number.

#include "tools/output/compare.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "cases/case_error.hpp"
#include "cases/format/toml_file.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

struct CompareOptions {
  std::filesystem::path a, b, tolerances;
  bool json = false;
};

[[noreturn]] void refuse(const std::string& file, const toml::node& node, const std::string& key,
                         const std::string& text) {
  const auto& at = node.source().begin;
  cases::Problem problem;
  problem.file = file;
  problem.line = static_cast<int>(at.line);
  problem.column = static_cast<int>(at.column);
  problem.key = key;
  problem.text = text;
  throw cases::CaseError({problem});
}

output::Tolerance tolerance_of(const std::string& file, const std::string& key, const toml::node& node) {
  output::Tolerance tolerance;
  const toml::table* table = node.as_table();
  if (table == nullptr)
    refuse(file, node, key, "'" + key + "': give { absolute = 0.01, relative = 0 }, or one of the two");
  for (const auto& [name, value] : *table) {
    const std::string word(name.str());
    if (word != "absolute" && word != "relative")
      refuse(file, value, word, "a tolerance has the keys 'absolute' and 'relative'");
    const auto number = value.value<double>();
    if (!number || !(*number >= 0.0)) refuse(file, value, word, "a tolerance is a number >= 0");
    (word == "absolute" ? tolerance.absolute : tolerance.relative) = *number;
  }
  return tolerance;
}

/// [tolerance] "name" = { absolute, relative }, "default" for all others; ignore = ["name", ...].
output::Tolerances read_tolerances(const std::filesystem::path& path) {
  const std::string file = path.string();
  const toml::table root = cases::format::parse_toml(cases::format::read_text(path), file);
  output::Tolerances tolerances;
  for (const auto& [name, node] : root) {
    const std::string key(name.str());
    if (key == "ignore" && node.is_array()) {
      for (const auto& item : *node.as_array()) {
        if (!item.is_string()) refuse(file, item, key, "a list of names, like [\"carriers.first_motion\"]");
        tolerances.ignored.push_back(*item.value<std::string>());
      }
    } else if (key == "tolerance" && node.is_table()) {
      for (const auto& [quantity, value] : *node.as_table()) {
        const output::Tolerance tolerance = tolerance_of(file, std::string(quantity.str()), value);
        if (quantity.str() == "default")
          tolerances.standard = tolerance;
        else
          tolerances.named[std::string(quantity.str())] = tolerance;
      }
    } else {
      refuse(file, node, key,
             "'" + key +
                 "': a file of tolerances has a table [tolerance], with rows like \"fines.drug.FFE\" = { absolute = "
                 "0.01, relative = 0 } or default = { relative = 1e-6 }, and ignore = [\"name\"]");
    }
  }
  return tolerances;
}

int compare_command(const CompareOptions& options) {
  const output::Tolerances tolerances =
      options.tolerances.empty() ? output::Tolerances() : read_tolerances(options.tolerances);
  const output::Comparison comparison = output::compare_runs(options.a, options.b, tolerances);
  for (const std::string& name : comparison.unused)
    log_warning(options.tolerances.string() + ": '" + name + "' is no number of these runs; --json lists the names");
  print(options.json ? output::comparison_json(comparison) : output::comparison_text(comparison));
  for (const auto& d : comparison.differences)
    if (!d.within()) return out_of_tolerance;
  return ok;
}

}  // namespace

namespace commands {
Command compare() {
  return {"compare", "differences of two runs", [](CLI::App& app) -> Action {
            auto options = std::make_shared<CompareOptions>();
            app.add_option("A", options->a, "the folder of a run")->required()->type_name("RUNDIR");
            app.add_option("B", options->b, "the folder of another")->required()->type_name("RUNDIR");
            app.add_option(
                   "--tol", options->tolerances,
                   "tolerances: [tolerance] with \"fines.drug.FFE\" = { absolute = 0.01, relative = 0 } and the "
                   "like, \"default\" for all others (1e-9 relative if not given; of ledger errors at least 1e-12); "
                   "ignore = [\"name\"]")
                ->type_name("FILE.toml");
            app.add_flag("--json", options->json, "one JSON object on stdout");
            app.footer("Exit code 9 if a number is outside its tolerance. Times and machine are left out.");
            return [options] { return compare_command(*options); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
