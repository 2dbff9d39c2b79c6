#pragma once
// What the lattice does at each patch of the surface, and what drives it.

#include <vector>

#include "cases/build.hpp"
#include "lbm/links.hpp"

namespace puffin::cases {

/// One boundary a patch, in the order of the patches; `drives` likewise.
void describe_patches(const Case& c, const Surface& surface, std::vector<lbm::Boundary>& boundaries,
                      std::vector<coupling::PatchDrive>& drives);

/// The walls beside a plug inlet carry the plug's speed at the opening and let go of it over six cells.
void release_plug(Simulation& s, lbm::LinkGeometry& links);

/// Modes of the inlets with turbulence, on the finished lattice.
void build_turbulence(Simulation& s);

}  // namespace puffin::cases
