#pragma once
// Colours and colour maps.

#include <algorithm>
#include <array>

namespace puffin::output {

/// Red, green, blue as displayed (sRGB), each 0..1.
struct Colour {
  float r = 0, g = 0, b = 0;
};

inline Colour mix(const Colour& a, const Colour& b, float t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

inline constexpr Colour white{1, 1, 1};
inline constexpr Colour ink{0.13f, 0.15f, 0.18f};
inline constexpr Colour soft_ink{0.38f, 0.41f, 0.45f};
inline constexpr Colour glass{0.52f, 0.60f, 0.68f};

/// The viridis map at t in 0..1 (clamped; 0 for what is no number): perceptually uniform, also in grey and for
/// colour-blind eyes.
/// Source: S. van der Walt & N. Smith, 2015; sixteen of its colours, linear between them.
inline Colour viridis(float t) {
  static constexpr std::array<int, 16> table{0x440154, 0x481A6C, 0x472F7D, 0x414487, 0x39568C, 0x31688E,
                                             0x2A788E, 0x23888E, 0x1F988B, 0x22A884, 0x35B779, 0x54C568,
                                             0x7AD151, 0xA5DB36, 0xD2E21B, 0xFDE725};
  const auto colour = [](int rgb) {
    return Colour{(rgb >> 16) / 255.0f, ((rgb >> 8) & 255) / 255.0f, (rgb & 255) / 255.0f};
  };
  const float at = (t > 0.0f ? std::min(t, 1.0f) : 0.0f) * 15.0f;
  const int low = std::min(static_cast<int>(at), 14);
  return mix(colour(table[low]), colour(table[low + 1]), at - static_cast<float>(low));
}

/// Colours to tell things apart by, also for colour-blind eyes. Source: M. Okabe & K. Ito, 2008.
inline Colour distinct(int i) {
  static constexpr std::array<Colour, 7> table{{{0.00f, 0.45f, 0.70f},
                                                {0.84f, 0.37f, 0.00f},
                                                {0.00f, 0.62f, 0.45f},
                                                {0.80f, 0.47f, 0.65f},
                                                {0.90f, 0.62f, 0.00f},
                                                {0.34f, 0.71f, 0.91f},
                                                {0.60f, 0.55f, 0.10f}}};
  return table[static_cast<std::size_t>(i) % table.size()];
}

}  // namespace puffin::output
