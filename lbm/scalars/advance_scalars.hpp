#pragma once
// Carry all scalars by the lattice's own mass fluxes.

#include "lbm/rows.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/max_steps.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::lbm {

// What the air must provide in FaceFluxes, beside what is said there:
//  * mass[d] and open[d] at slot s belong to the face between s and s + e_d. So the low face of the first cell of a
//    row is found at the ghost below it. Faces between two ghosts are not read, values at closed faces (open 0) must be
//    finite but count for nothing.
//  * Across a periodic boundary the one face is held twice: at the last cell of the row and at the ghost that mirrors
//    it below the first cell. Both must hold the same mass and open = 1.
//  * open = 2 exactly where one side is active and the other a ghost that has a patch in ScalarFields.
//  * density > 0 at every active cell. If density(next update) = density - steps * (net outflow of mass), a constant
//    concentration stays constant to rounding. Otherwise the difference is taken up silently when the carried air is
//    set back to the density; ScalarBudget::air_mismatch shows how large it was.

/// The most air steps one sub-step may cover: in no sweep, x y z or z y x, more than `cfl` of a cell's carried air may
/// leave, nor may the sweeps before have left the cell less than half of its air. Infinite where nothing flows. Throws
/// std::invalid_argument unless 0 < cfl < 1.
double max_steps(const Rows& rows, const FaceFluxes& fluxes, double cfl);

/// Advances the scalars over `steps` air steps (need not be whole) with the given fluxes.
///
/// Dimension-split finite volumes: sweeps x y z, the next time z y x, or mirrored pairs (sub_step.hpp). Each sweep
/// carries the air itself by the same fluxes, and the amounts by limited slopes (sweep.hpp). Second order in space and
/// time for smooth fields (Strang 1968), first order at walls and openings, no new extremum ever, conservative: total +
/// gone(budget) changes by rounding alone. Longer `steps` than the fluxes allow are sub-divided. Small diffusion is
/// part of the sweeps, explicit; where it would cost more than half again as many sub-steps it becomes implicit line by
/// line (diffuse_lines.hpp). Nothing is done while every scalar is empty. Same bits for any number of threads. Throws
/// std::invalid_argument if sizes, fluxes or options are inconsistent, std::runtime_error if the fluxes would empty a
/// cell. Returns what these fluxes and the diffusion of what moves allow, which is found on the way.
StepsAllowed advance_scalars(const Rows& rows, const FaceFluxes& fluxes, double steps, const ScalarOptions& options,
                             ScalarFields& fields, ScalarBudget& budget);

}  // namespace puffin::lbm
