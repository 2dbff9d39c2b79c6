#pragma once
// How many air steps one sub-step may cover.

#include <array>
#include <cstdint>
#include <vector>

#include "lbm/rows.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/sweep.hpp"

namespace puffin::lbm {

struct StepLimit {
  double steps = 0.0;            // by the outflow and by the air left between the sweeps; infinite where nothing flows
  std::array<double, 3> pair{};  // [middle] that a mirrored pair of them may cover together
  double least_air = 0.0;        // smallest air mass of a cell at the start
};

/// Of a whole update's flow and diffusion, for who chooses its length.
struct StepsAllowed {
  double single = 0.0;  // air steps of one sub-step, as max_steps gives them
  double pair = 0.0;    // of a mirrored pair (sub_step.hpp)
};

LimitRun faces_of(const Run& run, const FaceFluxes& fluxes, const double* air_of_run, double cfl);

/// What each run asks for, given the air mass `air` of each slot; runs that are not marked in `computed` (empty: all
/// are) are left out. Conditions for n steps, order x y z, net outflows N, outflows A: n A_x <= cfl theta, n A_y <= cfl
/// (theta - n N_x), n A_z <= cfl (theta - n N_x - n N_y), n N_x <= theta/2, n (N_x + N_y) <= theta/2; and the same for
/// z y x. All linear in n.
/// Of a mirrored pair, n steps each, the two sweeps that meet in the middle are one of 2n steps: a b c b a. Likewise
/// n A_a <= cfl theta, n A_b <= cfl (theta - n N_a), 2n A_c <= cfl (theta - n (N_a + N_b)), and on the way back with
/// what has left until then; never less than half of theta between two sweeps.
void find_limits(const Rows& rows, const FaceFluxes& fluxes, const std::vector<double>& air, double cfl,
                 const std::vector<std::uint8_t>& computed, std::vector<LimitFound>& of_run);

/// The strictest of them over the runs marked in `computed` (empty: all).
StepLimit strictest(const std::vector<LimitFound>& of_run, double cfl, const std::vector<std::uint8_t>& computed);

}  // namespace puffin::lbm
