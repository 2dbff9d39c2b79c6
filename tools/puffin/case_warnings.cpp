#include "tools/puffin/case_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "cases/room.hpp"
#include "cases/search_path.hpp"
#include "cases/stability_envelope.hpp"
#include "tools/puffin/available_memory.hpp"

namespace puffin::tools {

void warn_of_stability(const cases::Case& c, cases::Assessment& assessment) {
  const std::filesystem::path map = cases::stability_directory() / "envelope.toml";
  if (!assessment.lattice || !std::filesystem::exists(map)) return;
  const double speed = assessment.lattice->mach / std::sqrt(3.0);
  auto text = cases::outside_envelope(c, assessment.lattice->tau, speed, cases::read_envelope(map));
  if (!text.empty()) assessment.warnings.push_back(std::move(text));
}

std::vector<std::string> assessment_warnings(const cases::Case& c) try {
  if (c.air.model != cases::AirModel::lbm) return {};
  const cases::Surface surface = cases::load_surface(c);
  cases::require_room(c, surface, available_memory());  // what does not fit is not voxelized; the run will say so
  cases::Assessment assessment = cases::assess(c, surface);
  warn_of_stability(c, assessment);
  // At its end a run says what its tau was throughout (lattice_warnings).
  std::erase_if(assessment.warnings, [](const std::string& text) { return text.starts_with("tau is above 1"); });
  return assessment.warnings;
} catch (const std::exception&) {
  return {};
}

void add_new(const std::vector<std::string>& more, std::vector<std::string>& warnings) {
  for (const std::string& text : more)
    if (std::find(warnings.begin(), warnings.end(), text) == warnings.end()) warnings.push_back(text);
}

}  // namespace puffin::tools
