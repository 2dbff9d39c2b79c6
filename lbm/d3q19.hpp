#pragma once
// The D3Q19 velocity set: 0 rest, 1-6 axes, 7-18 face diagonals; opposite directions are neighbours (2n-1, 2n).

#include <array>

namespace puffin::lbm::d3q19 {

inline constexpr int q = 19;
inline constexpr std::array<std::array<int, 3>, q> velocity{{{0, 0, 0},
                                                             {1, 0, 0},
                                                             {-1, 0, 0},
                                                             {0, 1, 0},
                                                             {0, -1, 0},
                                                             {0, 0, 1},
                                                             {0, 0, -1},
                                                             {1, 1, 0},
                                                             {-1, -1, 0},
                                                             {1, -1, 0},
                                                             {-1, 1, 0},
                                                             {1, 0, 1},
                                                             {-1, 0, -1},
                                                             {1, 0, -1},
                                                             {-1, 0, 1},
                                                             {0, 1, 1},
                                                             {0, -1, -1},
                                                             {0, 1, -1},
                                                             {0, -1, 1}}};
inline constexpr std::array<double, q> weight{1.0 / 3,  1.0 / 18, 1.0 / 18, 1.0 / 18, 1.0 / 18, 1.0 / 18, 1.0 / 18,
                                              1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 36,
                                              1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 36, 1.0 / 36};
inline constexpr int opposite(int i) { return i == 0 ? 0 : (i % 2 ? i + 1 : i - 1); }
inline constexpr double cs2 = 1.0 / 3.0;  // speed of sound squared [dx^2/dt^2]

}  // namespace puffin::lbm::d3q19
