#pragma once
// Moments of a run as the frames that the VTK writers take.

#include "cases/build.hpp"
#include "tools/output/frames.hpp"

namespace puffin::tools {

/// What a [output] fields entry asks for, on its region of the lattice.
output::FieldFrame field_frame(const cases::Simulation& s, const cases::FieldOutput& wanted);
output::CarrierFrame carrier_frame(const cases::Simulation& s);
/// The triangles with the fines of the first scalar, the hits and the impact energy so far.
output::WallFrame wall_frame(const cases::Simulation& s);

}  // namespace puffin::tools
