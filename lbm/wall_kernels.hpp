#pragma once
// The hot loops of the walls that act on whole cells: partially saturated cells and the moments that markers read.
// Compiled once for each instruction set, as the collision is (kernel.hpp).

#include <cstddef>
#include <cstdint>

#include "lbm/collision.hpp"
#include "lbm/kernel.hpp"
#include "lbm/run.hpp"

namespace puffin::lbm {

/// Consecutive cells of one run that a wall acts on.
struct CellSegment {
  std::ptrdiff_t first = 0;  // slot
  std::int32_t count = 0;
  std::int32_t run = 0;
  std::size_t at = 0;  // place of the first cell in the arrays of all such cells
};

/// Partially saturated cells (psm.hpp). Before a collision `find_solid` reads the populations that arrived and keeps
/// B f_i(solid) and B; after it `blend` mixes them into what the collision made.
template <class T>
struct PartialInput {
  T* f = nullptr;
  std::size_t stride = 0;
  const Run* runs = nullptr;
  const CellSegment* segments = nullptr;
  std::size_t first = 0, last = 0;  // [first, last) of segments
  Parity parity = Parity::even;     // of the collision
  CollisionConstants constants;
  double least_tau = 0.5;
  double eddy = 1.0;  // 0: `les` is not of the stress (Vreman), tau0 alone counts
  double uniform_force[3] = {0, 0, 0};
  double wall_speed = 0.0;
  const float* les = nullptr;                          // per slot
  const float* solid = nullptr;                        // per cut cell
  const float* wall[3] = {nullptr, nullptr, nullptr};  // per cut cell, or null
  T* kept = nullptr;                                   // [20][cells]
  std::size_t cells = 0;
  float* taken[3] = {nullptr, nullptr, nullptr};  // per cut cell
};
template <class T>
using PartialKernel = void (*)(const PartialInput<T>&);
template <class T>
struct PartialKernels {
  PartialKernel<T> find_solid, blend;
};
template <class T>
PartialKernels<T> select_partial_kernels(Isa isa);

/// Density and momentum of cells before a collision: four floats a cell, (u_x, u_y, u_z, rho), without forces.
template <class T>
struct ReadInput {
  const T* f = nullptr;
  std::size_t stride = 0;
  const Run* runs = nullptr;
  const CellSegment* segments = nullptr;
  std::size_t first = 0, last = 0;
  Parity parity = Parity::even;  // of the collision to come
  float* state = nullptr;        // [cells][4]
};
template <class T>
using ReadKernel = void (*)(const ReadInput<T>&);
template <class T>
ReadKernel<T> select_read_kernel(Isa isa);

}  // namespace puffin::lbm
