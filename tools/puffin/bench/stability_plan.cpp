#include "tools/puffin/bench/stability_plan.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "cases/format/toml_file.hpp"

namespace puffin::tools {
namespace {

[[noreturn]] void refuse(const toml::node& at, const std::string& text) {
  const auto& source = at.source();
  throw std::runtime_error((source.path ? *source.path : std::string("stability.toml")) + ":" +
                           std::to_string(source.begin.line) + ": " + text);
}

std::string text_of(const toml::table& table, const char* key) {
  if (const auto value = table[key].value<std::string>()) return *value;
  refuse(table, std::string("needs '") + key + "', a text");
}

std::vector<std::string> list_of(const toml::table& table, const char* key) {
  std::vector<std::string> list;
  const auto* array = table[key].as_array();
  if (array == nullptr) {
    if (table.contains(key)) refuse(table, std::string("'") + key + "' is a list of texts");
    return list;
  }
  for (const auto& item : *array) {
    if (!item.is_string()) refuse(item, std::string("'") + key + "' is a list of texts");
    list.push_back(*item.value<std::string>());
  }
  return list;
}

template <class F>
void each_table(const toml::table& file, const char* key, const F& body) {
  const auto* array = file[key].as_array();
  if (array == nullptr || array->empty()) refuse(file, std::string("needs at least one [[") + key + "]]");
  for (const auto& item : *array) {
    if (!item.is_table()) refuse(item, std::string("[[") + key + "]] is a table");
    body(*item.as_table());
  }
}

}  // namespace

StabilityPlan read_stability_plan(const std::filesystem::path& file) {
  const toml::table toml = cases::format::parse_toml(cases::format::read_text(file), file.string());
  StabilityPlan plan;
  plan.nominal = toml["nominal"].value_or(0.0);
  if (!(plan.nominal > 0.0)) refuse(toml, "needs 'nominal', a lattice speed above 0");
  if (const auto* speeds = toml["speeds"].as_array())
    for (const auto& speed : *speeds) plan.speeds.push_back(speed.value_or(0.0));
  if (plan.speeds.empty() || *std::min_element(plan.speeds.begin(), plan.speeds.end()) <= 0.0)
    refuse(toml, "needs 'speeds', a list of lattice speeds above 0");
  each_table(toml, "variation", [&](const toml::table& t) {
    plan.variations.push_back({text_of(t, "name"), list_of(t, "set"), t["walls"].value_or(false), list_of(t, "quick")});
  });
  each_table(toml, "scene", [&](const toml::table& t) {
    plan.scenes.push_back({text_of(t, "name"), text_of(t, "what"), t["map"].value_or(false), t["walls"].value_or(true),
                           list_of(t, "quick")});
  });
  return plan;
}

std::vector<StabilityTrial> trials_of(const StabilityPlan& plan, bool quick) {
  std::vector<StabilityTrial> trials;
  for (const StabilityScene& scene : plan.scenes)
    for (const StabilityVariation& variation : plan.variations) {
      const bool is_default = &variation == &plan.variations.front();
      if (variation.walls && !scene.walls) continue;
      const auto& tried = variation.quick_scenes;
      if (quick && !is_default && std::find(tried.begin(), tried.end(), scene.name) == tried.end()) continue;
      if (!quick && !is_default && !scene.map) continue;
      std::vector<double> speeds{plan.nominal};
      if (!quick && scene.map) speeds = plan.speeds;
      for (const double speed : speeds) {
        StabilityTrial trial{&scene, &variation, speed, variation.sets};
        char text[64];
        std::snprintf(text, sizeof text, "numerics.lattice_speed=%g", speed);
        trial.sets.emplace_back(text);
        if (quick) trial.sets.insert(trial.sets.end(), scene.quick_sets.begin(), scene.quick_sets.end());
        trials.push_back(trial);
      }
    }
  return trials;
}

}  // namespace puffin::tools
