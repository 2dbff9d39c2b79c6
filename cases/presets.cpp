#include "cases/presets.hpp"

#include <array>
#include <limits>
#include <stdexcept>
#include <string>

namespace puffin::cases {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr std::array all_presets{Preset{"quick", 1.5, 0.121}, Preset{"fast", 1.2, unlimited, 1.4},
                                 Preset{"default", 1.0, unlimited}, Preset{"accurate", 2.0 / 3.0, unlimited}};

}  // namespace

std::span<const Preset> presets() { return all_presets; }

const Preset& preset_of(std::string_view name) {
  for (const Preset& p : all_presets)
    if (p.name == name) return p;
  throw std::invalid_argument("unknown preset '" + std::string(name) + "'; give quick, fast, default or accurate");
}

}  // namespace puffin::cases
