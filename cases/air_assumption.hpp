#pragma once
// What a run takes for granted about the air, in a sentence for its list of assumptions.

#include <string>

#include "cases/case.hpp"

namespace puffin::cases {

/// How turbulence is treated in the cells, at the inlets and at the walls. Empty if no lattice computes the air.
std::string air_assumption(const Case& c);

}  // namespace puffin::cases
