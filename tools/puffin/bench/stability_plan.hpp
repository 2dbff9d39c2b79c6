#pragma once
// What `puffin bench stability` runs: scenes, variations and speeds of cases/stability/stability.toml.

#include <filesystem>
#include <string>
#include <vector>

namespace puffin::tools {

struct StabilityVariation {
  std::string name;
  std::vector<std::string> sets;          // "key=value"
  bool walls = false;                     // says nothing where there are none
  std::vector<std::string> quick_scenes;  // where --quick tries it
};

struct StabilityScene {
  std::string name, what;
  bool map = false, walls = true;
  std::vector<std::string> quick_sets;
};

struct StabilityPlan {
  double nominal = 0.0;
  std::vector<double> speeds;
  std::vector<StabilityVariation> variations;  // the first is the default
  std::vector<StabilityScene> scenes;
};

/// One run of the plan.
struct StabilityTrial {
  const StabilityScene* scene = nullptr;
  const StabilityVariation* variation = nullptr;
  double speed = 0.0;
  std::vector<std::string> sets;
};

/// Throws std::runtime_error with file and line if the plan cannot be read or misses something.
StabilityPlan read_stability_plan(const std::filesystem::path& file);

/// The runs in order; they point into the plan.
std::vector<StabilityTrial> trials_of(const StabilityPlan& plan, bool quick);

}  // namespace puffin::tools
