#include "tools/puffin/bench/stability_envelope.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

#include "cases/read_case.hpp"

namespace puffin::tools {
namespace {

/// Collision, eddy viscosity and wall of a variation, nothing tried yet.
cases::EnvelopeRow settings_of(const StabilityVariation& v, const std::filesystem::path& case_file) {
  std::vector<cases::Override> overrides;
  for (const std::string& set : v.sets) overrides.push_back(cases::parse_override(set));
  const cases::Numerics n = cases::read_case(case_file, overrides).numerics;
  cases::EnvelopeRow row;
  row.collision = n.collision;
  row.les = n.les;
  row.wall = n.wall;
  row.smagorinsky_constant = n.les == cases::Les::none ? 0.0 : n.smagorinsky_constant;
  return row;
}

/// What happened at one speed, the worst of all scenes.
struct AtSpeed {
  bool ran = true, went_on = true;
  std::string failure;
};

}  // namespace

std::vector<cases::EnvelopeRow> envelope_of(const StabilityPlan& plan, const std::filesystem::path& scenes,
                                            const nlohmann::json& rows) {
  const auto model =
      std::find_if(plan.scenes.begin(), plan.scenes.end(), [](const StabilityScene& s) { return s.map && s.walls; });
  if (model == plan.scenes.end()) return {};
  const auto in_map = [&](const std::string& name) {
    return std::any_of(plan.scenes.begin(), plan.scenes.end(),
                       [&](const StabilityScene& s) { return s.map && s.name == name; });
  };
  std::vector<cases::EnvelopeRow> envelope;
  std::vector<std::map<double, AtSpeed>> tried;
  for (const StabilityVariation& variation : plan.variations) {
    const cases::EnvelopeRow settings = settings_of(variation, scenes / (model->name + ".toml"));
    const auto found = std::find(envelope.begin(), envelope.end(), settings);
    const std::size_t place = static_cast<std::size_t>(found - envelope.begin());
    if (found == envelope.end()) envelope.push_back(settings), tried.emplace_back();
    for (const nlohmann::json& row : rows) {
      if (row["variation"] != variation.name || !in_map(row["scene"].get<std::string>())) continue;
      AtSpeed& at = tried[place][row["u_lb"].get<double>()];
      const std::string outcome = row["outcome"];
      if (outcome == "ok") continue;
      const bool first = at.ran, first_divergence = at.went_on && outcome != "healed";
      at.ran = false;
      if (outcome != "healed") at.went_on = false;
      char speed[32];
      std::snprintf(speed, sizeof speed, " at %g", row["u_lb"].get<double>());
      if (first || first_divergence) at.failure = row["scene"].get<std::string>() + speed;
    }
  }
  for (std::size_t n = 0; n < envelope.size(); ++n) {
    cases::EnvelopeRow& row = envelope[n];
    bool runs = true, heals = true;
    for (const auto& [speed, at] : tried[n]) {  // from the slowest
      row.tried = speed;
      if (runs && heals && (!at.ran || !at.went_on)) row.failure = at.failure;
      runs = runs && at.ran;
      if (heals && !at.went_on) row.failure = at.failure;
      heals = heals && at.went_on;
      if (runs) row.runs = speed;
      if (heals) row.heals = speed;
    }
  }
  std::erase_if(envelope, [](const cases::EnvelopeRow& r) { return r.tried == 0.0; });
  return envelope;
}

}  // namespace puffin::tools
