#pragma once
// The hot loop: collide and stream in place (AA pattern), one chunk of runs at a time.
// Source of the pattern: Bailey, Myre, Walsh, Lilja & Saar, ICPP 2009, 550.
//
// Two kinds of step alternate. `even` reads direction i of a cell from its own slot i and writes the result to its own
// slot opposite(i). `odd` reads direction i from slot opposite(i) of the upstream neighbour and writes to slot i of the
// downstream neighbour. Between steps the population that arrives at a cell is therefore found at
//   next step even: f[i][s]           next step odd: f[opposite(i)][slot(x - c_i)].
// Each cell touches its own 19 places only, so chunks may run in any order: equal bits for every number of threads.

#include <cstddef>
#include <cstdint>

#include "lbm/collision_regularised.hpp"
#include "lbm/collision_relaxing.hpp"
#include "lbm/run.hpp"

namespace puffin::lbm {

/// Consecutive cells of one run whose wall links point in the same set of directions and interpolate the same way.
struct WallRun {
  std::ptrdiff_t first = 0;      // slot
  std::int32_t count = 0;        // cells
  std::uint32_t directions = 0;  // bit i: the link in direction i is cut by a wall
  std::uint32_t far = 0;         // bit i: beyond half the link, so the cell's own population helps to interpolate
  std::int32_t run = 0;          // index of the run in Rows
  bool moving = false;           // some of its links end on a moving surface
  std::size_t coefficient = 0;   // first of (number of directions) x count coefficients, direction by direction
};

/// Wall cells anywhere, alike in the directions of their links and in how these interpolate. Their places: the slots of
/// the cells; then, direction by direction, the slots beyond the wall and those behind the cells. The last cell is
/// repeated until the cells fill whole packs: it is given the same values again.
struct WallGroup {
  std::int32_t count = 0;        // cells, a multiple of group_unit
  std::uint32_t directions = 0;  // as in WallRun
  std::uint32_t far = 0;
  bool moving = false;
  std::size_t place = 0;        // first of (1 + 2 x number of directions) x count places
  std::size_t coefficient = 0;  // first of (number of directions) x count coefficients, direction by direction
};
inline constexpr int group_unit = 16;  // lanes of the widest pack

enum class Law { rr3, bgk, trt, central_moments, hrr };
/// Whether the law's equilibrium has odd moments of third order.
inline bool has_third_order(Law law) { return law != Law::bgk && law != Law::trt; }
enum class Parity : std::uint8_t { even, odd };
enum class Isa { baseline, avx2, avx512 };

/// Bits of KernelInput::run_flags.
inline constexpr std::uint8_t run_forced = 1, run_moments = 2;

/// What the loop saw; merged over chunks in a fixed order.
struct KernelReport {
  double max_speed2 = 0.0;  // largest u^2 [lattice units]
  double min_density_excess = 0.0;
  double max_density_excess = 0.0;
  std::int64_t limited = 0;  // cells in which the positivity limiter acted
  bool bad = false;          // some value was not finite, or |u| or rho outside the limits
};

template <class T>
struct KernelInput {
  T* f = nullptr;  // populations, 19 arrays of `stride` values
  std::size_t stride = 0;
  const Run* runs = nullptr;
  const std::uint8_t* run_flags = nullptr;      // per run
  const std::uint16_t* active_lanes = nullptr;  // of Rows
  int first_run = 0, last_run = 0;
  Parity parity = Parity::even;
  CollisionConstants constants;
  const float* les = nullptr;   // per slot: 18 sqrt2 L^2, or what prescribed_les says; zeros: no eddy viscosity
  const float* strain[6] = {};  // per slot: strain rate without trace, read by the law hrr
  double uniform_force[3] = {0, 0, 0};
  bool forced_everywhere = false;                            // a uniform force acts
  const float* force[3] = {nullptr, nullptr, nullptr};       // per slot, read in runs flagged run_forced
  float* moments[4] = {nullptr, nullptr, nullptr, nullptr};  // rho-1, ux, uy, uz; written in runs flagged run_moments
};

/// |u| above this, or |rho-1| above 0.5, counts as bad: the flow has left the range in which the lattice means
/// anything.
inline constexpr double speed_limit = 0.4;

template <class T>
using Kernel = KernelReport (*)(const KernelInput<T>&);

/// Cut links of the walls in runs and groups of equal directions: see links.hpp, link_schedule.hpp.
template <class T>
struct WallInput {
  T* f = nullptr;
  std::size_t stride = 0;
  const Run* runs = nullptr;
  const WallRun* walls = nullptr;
  std::size_t first = 0, last = 0;  // [first, last) of walls
  const float* partner = nullptr;   // weight of the second population in the interpolation
  const float* moving = nullptr;    // or null
  const float* returned = nullptr;  // of `moving`, likewise
  const WallGroup* groups = nullptr;
  std::size_t first_group = 0, last_group = 0;
  const std::int32_t* places = nullptr;  // and coefficients, of groups
  const float* group_partner = nullptr;
  const float* group_moving = nullptr;
  const float* group_returned = nullptr;
  Parity parity = Parity::even;  // of the collision that has just been done
  double wall_speed = 0.0;       // multiplies `moving` [lattice units]
};
template <class T>
using WallKernel = void (*)(const WallInput<T>&);

/// Mass fluxes through the faces of the cells of some runs: see mass_fluxes.hpp.
template <class T>
struct FluxInput {
  const T* f = nullptr;
  std::size_t stride = 0;
  const Run* runs = nullptr;
  int first_run = 0, last_run = 0;
  Parity next = Parity::even;
  const std::uint16_t* routes[3] = {nullptr, nullptr, nullptr};  // per face: shares of the eight diagonals, 2 bits each
  const std::uint8_t* open[3] = {nullptr, nullptr, nullptr};
  double* mass[3] = {nullptr, nullptr, nullptr};
  double* density = nullptr;
};
template <class T>
using FluxKernel = void (*)(const FluxInput<T>&);

/// Velocities of the cells of some runs, as they have arrived before a step: see velocity_gradients.hpp.
template <class T>
struct VelocityInput {
  const T* f = nullptr;
  std::size_t stride = 0;
  const Run* runs = nullptr;
  int first_run = 0, last_run = 0;
  Parity next = Parity::even;
  float* moments[4] = {nullptr, nullptr, nullptr, nullptr};  // rho-1, ux, uy, uz
};
template <class T>
using VelocityKernel = void (*)(const VelocityInput<T>&);

/// Central differences of these velocities, and what the laws make of them. Near walls the result is replaced.
struct GradientInput {
  const Run* runs = nullptr;
  int first_run = 0, last_run = 0;
  const float* moments[4] = {nullptr, nullptr, nullptr, nullptr};
  float* strain[6] = {};           // without trace; null: not wanted
  const float* length2 = nullptr;  // Vreman's c Delta^2; null: not wanted
  float* les = nullptr;
  double tau0 = 1.0;
};
using GradientKernel = void (*)(const GradientInput&);

/// The best instruction set this processor offers (and the build contains).
Isa detect_isa();
const char* name(Isa isa);
/// rescale: for the one step in which the time step changes (rr3, whatever the law of the other steps).
template <class T>
Kernel<T> select_kernel(Law law, bool rescale, Isa isa);
template <class T>
WallKernel<T> select_wall_kernel(Isa isa);
template <class T>
FluxKernel<T> select_flux_kernel(Isa isa);
template <class T>
VelocityKernel<T> select_velocity_kernel(Isa isa);
GradientKernel select_gradient_kernel(Isa isa);

}  // namespace puffin::lbm
