#pragma once
// Openings that the case forgot.

#include <string>

#include "cases/case.hpp"
#include "lbm/geometry/patches.hpp"

namespace puffin::cases {

/// Does a patch's name say that it is an opening? One of its words, without digits, is inlet, outlet, inflow, outflow,
/// opening, mouth, mouthpiece, vent, port or exhaust: "inlet", "Outlet-2", "air_inlet".
bool is_called_opening(const std::string& name);

/// Throws lbm::geometry::GeometryError naming every patch that is called an opening while no [[air.boundary]] says what
/// happens there: it would be a wall in silence. Only where air = "lbm" needs to know.
void refuse_untagged_openings(const Case& c, const lbm::geometry::Patches& patches);

}  // namespace puffin::cases
