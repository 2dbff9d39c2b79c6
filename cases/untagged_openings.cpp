#include "cases/untagged_openings.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "lbm/geometry/surface_check.hpp"

namespace puffin::cases {

bool is_called_opening(const std::string& name) {
  static const std::array<std::string, 10> words{"inlet", "outlet",     "inflow", "outflow", "opening",
                                                 "mouth", "mouthpiece", "vent",   "port",    "exhaust"};
  std::string word;
  for (std::size_t i = 0; i <= name.size(); ++i) {
    const auto c = i < name.size() ? static_cast<unsigned char>(name[i]) : static_cast<unsigned char>(' ');
    if (std::isalpha(c)) {
      word += static_cast<char>(std::tolower(c));
      continue;
    }
    if (std::find(words.begin(), words.end(), word) != words.end()) return true;
    word.clear();
  }
  return false;
}

bool is_open_unsaid(const Case& c, const std::string& patch) {
  if (c.air.model == AirModel::lbm || patch == "wall" || patch == "pocket" || patch == "obstacle") return false;
  if (std::any_of(c.air.boundaries.begin(), c.air.boundaries.end(),
                  [&](const Boundary& b) { return b.patch == patch || b.with == patch; }))
    return false;
  if (c.carriers && c.carriers->fill)
    if (const auto* at = std::get_if<std::string>(&c.carriers->fill->at); at != nullptr && *at == patch) return false;
  return patch == "inlet" || patch == "outlet" ||
         std::any_of(c.geometry.patches.begin(), c.geometry.patches.end(),
                     [&](const Patch& p) { return p.name == patch; });
}

std::vector<std::string> doubtful_openings(const Case& c) {
  std::vector<std::string> names;
  if (!c.carriers || c.carriers->outside != Outside::remove) return names;
  for (const Patch& p : c.geometry.patches) {
    std::string name = p.name;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    const bool is_called_so = name.starts_with("inlet") || name.starts_with("outlet") || name.starts_with("exit") ||
                              name.starts_with("mouthpiece");
    if (!is_called_so && is_open_unsaid(c, p.name)) names.push_back(p.name);
  }
  return names;
}

void refuse_untagged_openings(const Case& c, const lbm::geometry::Patches& patches) {
  if (c.air.model != AirModel::lbm) return;
  std::string text;
  for (const std::string& name : patches.names) {
    const bool has_boundary = std::any_of(c.air.boundaries.begin(), c.air.boundaries.end(),
                                          [&](const Boundary& b) { return b.patch == name || b.with == name; });
    if (has_boundary || !is_called_opening(name)) continue;
    text += (text.empty() ? "untagged opening: the patch '" : "\nuntagged opening: the patch '") + name +
            "' has no [[air.boundary]] and would be a wall; give it one: patch = \"" + name +
            "\", type = \"pressure-outlet\" or \"velocity-inlet\", or \"wall\" if it is meant to be closed";
  }
  if (!text.empty()) throw lbm::geometry::GeometryError(text);
}

}  // namespace puffin::cases
