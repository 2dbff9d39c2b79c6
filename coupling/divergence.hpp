#pragma once
// How a failure of the physics is told: with place, value and limit.

#include <cstdio>

#include "coupling/state.hpp"

namespace puffin::coupling {

/// Throws Diverged with a text as of printf, at most 511 characters.
template <class... Args>
[[noreturn]] void diverge(const char* format, Args... args) {
  char text[512];
  std::snprintf(text, sizeof text, format, args...);
  throw Diverged(text);
}

/// Names the first cell whose density or speed left the limits of the kernel. Throws Diverged.
[[noreturn]] void report_bad_cell(const lbm::Air& air, const Scale& scale, double time);

}  // namespace puffin::coupling
