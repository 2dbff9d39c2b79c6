#pragma once
// What the file skip.toml says: scenes, and what a run of them leaves out that could also be computed.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/read_case.hpp"

namespace puffin::cases {

struct AblationScene {
  std::string name, what;
  std::filesystem::path case_file;
  std::vector<Override> quick_sets;  // under every run of `--quick`
};

/// One thing left out: the settings that put it back in.
struct Ablation {
  std::string name, scene;
  std::vector<Override> off;
  bool exact = false;                // claimed: the answer keeps every bit
  std::vector<std::string> answers;  // numbers of summary.json that it is judged by too, "pressure.static_drop.mean"
};

struct AblationList {
  std::vector<AblationScene> scenes;
  std::vector<Ablation> skips;
};

/// Throws CaseError with every problem, std::system_error if it cannot be read.
AblationList read_ablations(const std::filesystem::path& file);

}  // namespace puffin::cases
