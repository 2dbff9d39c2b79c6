#pragma once
// The velocity gradient of every cell, for the laws that ask for it: the strain rate of `hrr`, the eddy viscosity of
// Vreman. Found before each collision from the populations that have arrived, so it is no state: nothing to save,
// nothing to rescale when the time step changes. Costs ten floats a cell and two more passes, only when such a law is
// chosen.
//
// Inside the fluid: central differences. Where a neighbour is missing along an axis: the three-point formula with the
// wall's own velocity at the distance h of the cut link,
//   du/dx = [h-^2 (u+ - u0) + h+^2 (u0 - u-)] / (h+ h- (h+ + h-)),
// second order; (u+ - u-)/(h+ + h-) where a wall is nearer than half a cell (the former would divide the noise of u0 by
// h). A slip wall mirrors the velocity; at an opening the difference is one-sided.

#include <array>
#include <cstdint>
#include <vector>

#include "lbm/links.hpp"
#include "lbm/populations.hpp"
#include "lbm/rows.hpp"

namespace puffin::lbm {

/// One axis of a cell along which a neighbour is missing.
struct EdgeAxis {
  enum class Side : std::uint8_t { cell, wall, mirror, none };
  std::array<std::ptrdiff_t, 2> slot{-1, -1};  // of the neighbours below and above, where they are cells
  std::array<Side, 2> side{Side::cell, Side::cell};
  std::int8_t axis = 0;
  std::array<float, 3> weight{0, 0, 0};        // of the velocities below, here and above
  std::array<std::int32_t, 2> moving{-1, -1};  // index into `surface_velocity`
};

struct EdgeCell {
  std::ptrdiff_t slot = 0;
  std::int32_t run = 0;
  std::size_t first_axis = 0;  // up to that of the next cell
};

struct VelocityGradients {
  bool strain_wanted = false, viscosity_wanted = false;
  std::array<std::vector<float>, 4> moments;  // rho-1, ux, uy, uz of the active cells before the collision
  std::array<std::vector<float>, 6> strain;   // without trace: xx, yy, zz, xy, xz, yz
  std::vector<float> length2;                 // Vreman's c Delta^2 per slot
  std::vector<EdgeCell> cells;                // in the order of the runs
  std::vector<std::size_t> chunk_cells;       // per chunk: first of `cells`; size chunks + 1
  std::vector<EdgeAxis> axes;
  struct SurfaceVelocity {
    int boundary = 0;
    std::array<float, 3> u{0, 0, 0};  // for a unit wall speed
  };
  std::vector<SurfaceVelocity> surface_velocity;

  bool wanted() const { return strain_wanted || viscosity_wanted; }
};

/// Lays out what the laws want. length2: Vreman's c Delta^2 per slot; empty: not wanted.
VelocityGradients make_velocity_gradients(const Rows& rows, const Links& links, const std::vector<Boundary>& boundaries,
                                          bool strain, std::vector<float> length2);

/// Fills strain, and `les` as prescribed_les says, at every active cell. wall_speed: per boundary.
template <class T>
void find_velocity_gradients(const Rows& rows, const Populations<T>& populations, const std::vector<double>& wall_speed,
                             double tau0, Isa isa, VelocityGradients& gradients, std::vector<float>& les);

}  // namespace puffin::lbm
