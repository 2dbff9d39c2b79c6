#pragma once
// Does a law jump?

#include "micromodels/law.hpp"

namespace puffin::micromodels {

/// Where a law is not continuous, and by how much. Height 0: continuous.
struct Jump {
  double speed = 0.0, height = 0.0;  // [m/s]; fraction [1] or rate [1/s], negative if more speed takes less there
};

/// That of a power law at its switch; below 1e-12 of the upper branch it counts as continuous, as the other laws are.
Jump jump(const Law& law);

}  // namespace puffin::micromodels
