#pragma once
// Openings that the case does not name as such.

#include <string>
#include <vector>

#include "cases/case.hpp"
#include "lbm/geometry/patches.hpp"

namespace puffin::cases {

/// Does a patch's name say that it is an opening? One of its words, without digits, is inlet, outlet, inflow, outflow,
/// opening, mouth, mouthpiece, vent, port or exhaust: "inlet", "Outlet-2", "air_inlet".
bool is_called_opening(const std::string& name);

/// Is a patch open although no [[air.boundary]] says what happens there? Where no lattice is computed: `inlet`,
/// `outlet` and every patch tagged by hand, but not what is called wall, pocket or obstacle, and not the place of the
/// fill. On a lattice no patch is.
bool is_open_unsaid(const Case& c, const std::string& patch);

/// Patches that carriers leave through for their tag alone: open unsaid, under a name that does not begin with inlet,
/// outlet, exit or mouthpiece in letters of any case. A floor that was tagged to be read from is one.
std::vector<std::string> doubtful_openings(const Case& c);

/// Throws lbm::geometry::GeometryError naming every patch that is called an opening while no [[air.boundary]] says what
/// happens there: it would be a wall in silence. Only where air = "lbm" needs to know.
void refuse_untagged_openings(const Case& c, const lbm::geometry::Patches& patches);

}  // namespace puffin::cases
