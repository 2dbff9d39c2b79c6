// puffin micromodel derive | fit | show.

#include "tools/puffin/micromodel.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cases/micromodel_file.hpp"
#include "cases/search_path.hpp"
#include "cases/write_micromodels.hpp"
#include "micromodels/continuity.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/law_plot.hpp"

namespace puffin::tools {
namespace {

struct ShowArguments {
  std::filesystem::path file, out;
  bool json = false;
};

int show(const ShowArguments& a) {
  const micromodels::FinesModels models = cases::read_micromodels(cases::found_micromodels(a.file));
  const double fastest = plot_range(models);
  if (!a.out.empty()) {
    output::LineChart chart{"impact speed [m/s]", "fraction of the initial fines", law_curves(models, fastest), {}};
    write_svg(a.out, chart);
  }
  const std::pair<const char*, const std::optional<micromodels::Law>*> laws[] = {
      {"wall_detach", &models.wall_detach},
      {"wall_attach", &models.wall_attach},
      {"particle_detach", &models.particle_detach},
      {"drag_detach", &models.drag_detach}};
  std::vector<double> speeds;
  for (const double part : {0.01, 0.02, 0.035, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0})
    speeds.push_back(part * fastest);
  const auto value = [&](const micromodels::Law& law, double v) {
    return &law == &*models.drag_detach ? micromodels::rate(law, v) : micromodels::fraction(law, v);
  };
  if (a.json) {
    nlohmann::json j{{"label", cases::name(models.label)},
                     {"source", models.source},
                     {"surface_energy", models.surface_energy},
                     {"speed", speeds}};
    for (const auto& [name, law] : laws) {
      if (!*law) continue;
      const auto& valid = micromodels::valid(**law);
      const micromodels::Jump jump = micromodels::jump(**law);
      nlohmann::json values = nlohmann::json::array();
      for (const double v : speeds) values.push_back(value(**law, v));
      j["laws"][name] = {
          {"law", micromodels::name(**law)},
          {"valid", {valid.low, std::isfinite(valid.high) ? nlohmann::json(valid.high) : nlohmann::json()}},
          {"continuous", jump.height == 0.0},
          {"jump", {{"speed", jump.speed}, {"height", jump.height}}},
          {"value", values}};
    }
    print(j.dump(2));
    return ok;
  }
  print(a.file.string() + ": " + cases::name(models.label) + (models.source.empty() ? "" : ", " + models.source));
  if (models.surface_energy > 0.0) print("surface energy " + four_digits(models.surface_energy) + " J/m^2");
  for (const std::string& note : law_notes(models)) print(note);
  print("  speed  wall_detach wall_attach particle_detach  drag_detach");
  print("    m/s            1           1               1          1/s");
  for (const double v : speeds) {
    char line[120];
    int at = std::snprintf(line, sizeof line, "%7.3f", v);
    const int width[] = {13, 12, 16, 13};
    for (int k = 0; k < 4; ++k) {
      const auto& law = *laws[k].second;
      at +=
          law ? std::snprintf(line + at, sizeof line - static_cast<std::size_t>(at), "%*.5g", width[k], value(*law, v))
              : std::snprintf(line + at, sizeof line - static_cast<std::size_t>(at), "%*s", width[k], "-");
    }
    print(line);
  }
  return ok;
}

}  // namespace

Action micromodel_show(CLI::App& app) {
  auto a = std::make_shared<ShowArguments>();
  app.add_option("file", a->file, "a micro-model file")->required()->type_name("FILE.toml");
  app.add_option("--out", a->out, "a plot of the impact laws")->type_name("FILE.svg");
  app.add_flag("--json", a->json, "one JSON object on stdout");
  return [a] { return show(*a); };
}

namespace commands {
Command micromodel() {
  return {"micromodel", "laws of the fines: derive them, fit them, show them", [](CLI::App& app) -> Action {
            app.require_subcommand(1);
            std::vector<std::pair<CLI::App*, Action>> verbs;
            const auto add = [&](const char* name, const char* summary, Action (*options)(CLI::App&)) {
              CLI::App* verb = app.add_subcommand(name, summary);
              verbs.emplace_back(verb, options(*verb));
            };
            add("derive", "a set of laws from resolved impacts of a coated carrier", micromodel_derive);
            add("fit", "constants of a law from a table, or from the outcome of whole runs", micromodel_fit);
            add("show", "table and plot of a micro-model file, its validity and continuity", micromodel_show);
            return [verbs] {
              for (const auto& [verb, action] : verbs)
                if (verb->parsed()) return action();
              throw UsageError("which of derive, fit, show? see puffin micromodel --help");
            };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
