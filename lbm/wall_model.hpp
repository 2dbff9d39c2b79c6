#pragma once
// A wall model for walls with cut links (bouzidi, halfway) whose first cell lies beyond the viscous sublayer.
//
// A bounced-back population gives the wall whatever momentum the coarse cell carries; here each cell beside a wall
// gives it what the law of the wall says, by a slip velocity in the reflection. With M = sum_i c_i (f_out,i + f_in,o -
// 2 w_i (rho - 1)) over its cut links, the momentum the wall got in the step less the pressure's, the returning
// populations gain w_i c_i.b so that the tangential part of M becomes
//   tau_w A u_t/|u_t|,      A = 18 sum_i w_i (c_i.n) c_i c_i in the plane of the wall,
// and the population at rest gives back the mass. A is the area of wall of a cell, for each direction of the stress: as
// the links of direction i cut (c_i.n) times in a unit of area and the lattice is isotropic to fourth order, the cells
// beside any plane wall add up to its area times the unit tensor (of the stress imposed 2 to 6 % are lost across walls
// like (3,2,0) and (2,1,0): directions in which a cell has hardly a link are left out). On a staircase some cells have
// no link that leans along the wall and can give it no tangential momentum; their neighbours then have a larger A. (One
// area for all directions, 6 sum_i w_i c_i.n, loses their share: a sixth where a wall lies at 45 degrees along the
// flow.) Source of the idea: momentum exchange by slip velocity, Asmuth et al., Phys. Fluids 33, 105111 (2021). Law of
// the wall, from the velocity u_t at a cell two to three cells off the wall, at distance y: Reichardt (Z. angew. Math.
// Mech. 31, 208 (1951)),
//   u+ = ln(1 + kappa y+)/kappa + 7.8 (1 - exp(-y+/11) - y+/11 exp(-y+/3)),   kappa = 0.41,
// within 3 % of the channel of Moser, Kim & Mansour (1999) at Re_tau 180 from y+ = 5 to 180, where Werner & Wengle's
// power law is 15 % too high at y+ = 13 and 6 % too low at 80. Below y+ = 5 nothing is changed (the no-slip reflection
// is then exact), above 15 all; linear between.

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
  std::array<float, 6> area{0, 0, 0, 0, 0, 0};     // of wall [dx^2], in its plane: xx yy zz xy xz yz
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
/// Werner & Wengle (8th Symp. Turbulent Shear Flows, 1991), in closed form: u+ = y+ for y+ <= 11.81, else 8.3
/// (y+)^(1/7).
WallStress werner_wengle(double speed, double distance, double viscosity);
/// Reichardt's law, by two steps of Newton's from Werner & Wengle's stress: to 1e-4 above y+ = 3.
WallStress reichardt(double speed, double distance, double viscosity);

/// The cells of all walls of `links`.
WallModel find_modelled_cells(const Rows& rows, const Links& links, const LinkGeometry& surface);

struct Air;
/// Before a collision: what each cell will owe the wall, from the velocities that arrived.
void find_wall_stress(double viscosity, double wall_speed, Air& air);
/// After the links.
void impose_wall_stress(Air& air);

}  // namespace puffin::lbm
