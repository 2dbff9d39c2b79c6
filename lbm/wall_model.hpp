#pragma once
// A wall model for walls with cut links (bouzidi, halfway) whose first cell lies beyond the viscous sublayer.
//
// A bounced-back population gives the wall whatever momentum the coarse cell carries; here each cell beside a wall
// gives it what the law of the wall says, by a slip velocity in the reflection. With M = sum_i c_i (f_out,i + f_in,o -
// 2 w_i (rho - 1)) over its cut links, the momentum the wall got in the step less the pressure's, the returning
// populations gain w_i c_i.b so that the tangential part of M becomes
//   tau_w A u_t/|u_t|,      A = 6 sum_i w_i c_i.n  (area of wall of the cell: exact in the mean for a plane wall),
// and the population at rest gives back the mass. Source of the idea: momentum exchange by slip velocity, Asmuth et
// al., Phys. Fluids 33, 105111 (2021). Law of the wall, from the velocity u_t at a cell two to three cells off the
// wall, at distance y: Werner & Wengle (8th Symp. Turbulent Shear Flows, 1991), pointwise,
//   u+ = y+ for y+ <= 11.81,   u+ = 8.3 (y+)^(1/7) above:   tau_w = rho (u_t/8.3)^(7/4) (nu/y)^(1/4).
// Below y+ = 5 nothing is changed (the no-slip reflection is then exact), above 15 all; linear between.

#include <array>
#include <cstdint>
#include <vector>

#include "lbm/links.hpp"
#include "lbm/rows.hpp"
#include "lbm/wall_sides.hpp"

namespace puffin::lbm {

/// A cell with links that a wall cuts.
struct ModelledCell {
  std::ptrdiff_t slot = 0, probe = 0;
  std::int32_t run = 0, probe_run = 0;
  std::uint32_t directions = 0;                    // of the cut links
  float distance = 0.0F;                           // of the probe from the wall [cells]
  float area = 0.0F;                               // of wall [dx^2]
  std::array<float, 3> normal{0, 0, 0};            // out of the fluid
  std::array<float, 3> wall{0, 0, 0};              // velocity of the surface for a unit wall speed
  std::array<float, 6> inverse{0, 0, 0, 0, 0, 0};  // of sum_i w_i c_i c_i in the plane of the wall: xx yy zz xy xz yz
};

struct WallModel {
  std::vector<ModelledCell> cells;
  std::vector<float> target;  // [cells][4]: tau_w A u_t/|u_t| for the step, and how much of it counts (0 to 1)
};

/// Stress of the law of the wall over rho, and y+ of the probe; in lattice or any consistent units.
struct WallStress {
  double over_rho = 0.0, y_plus = 0.0;
};
WallStress werner_wengle(double speed, double distance, double viscosity);

/// The cells of all walls of `links`.
WallModel find_modelled_cells(const Rows& rows, const Links& links, const LinkGeometry& surface);

struct Air;
/// Before a collision: what each cell will owe the wall, from the velocities that arrived.
void find_wall_stress(double viscosity, double wall_speed, Air& air);
/// After the links.
void impose_wall_stress(Air& air);

}  // namespace puffin::lbm
