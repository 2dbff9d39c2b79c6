#pragma once
// The air on the lattice: state as plain data, one free function for each thing that happens in a step.
// Everything here is in lattice units: length dx, time dt, density 1.

#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <variant>
#include <vector>

#include "lbm/kernel.hpp"
#include "lbm/links.hpp"
#include "lbm/marker_options.hpp"
#include "lbm/moments.hpp"
#include "lbm/populations.hpp"
#include "lbm/rows.hpp"
#include "lbm/velocity_gradients.hpp"

namespace puffin::lbm {

/// Where the eddy viscosity comes from: the cell's own stress, or the velocity gradient (vreman.hpp).
enum class Eddy { smagorinsky, vreman };

struct Markers;       // markers.hpp
struct PartialCells;  // psm.hpp
struct WallModel;     // wall_model.hpp

struct AirOptions {
  Law law = Law::rr3;
  WallScheme wall = WallScheme::bouzidi;
  MarkerOptions markers;    // ibm
  bool wall_model = false;  // bouzidi, halfway
  bool double_precision = false;
  double smagorinsky = 0.10;  // C_s; 0: no eddy viscosity
  Eddy eddy = Eddy::smagorinsky;
  double hrr_sigma = 0.98;     // law hrr: share of the cell's own stress
  double sponge_length = 0.0;  // [m] before the outlets, over which C_s rises threefold (numerics: outlet stability)
  Isa isa = detect_isa();
};

/// What drives the boundaries during a step; one entry a boundary.
struct Drive {
  std::vector<double> speed;           // inlet: mean speed into the domain; wall: speed of a moving wall
  std::vector<double> density_excess;  // outlet: imposed rho - 1
  std::array<double, 3> uniform_force{0, 0, 0};
  std::vector<float> inlet_fluctuation;  // per inlet link: population gained on top (inlet_turbulence.hpp); or empty
};

struct Air {
  Rows rows;
  Links links;
  std::vector<Boundary> boundaries;
  std::vector<geometry::Vec3>
      normal;  // per boundary: mean outward normal (openings); zero if its faces look against each other
  AirOptions options;
  std::variant<Populations<float>, Populations<double>> populations;
  Moments moments;
  BodyForce force;
  std::vector<std::uint8_t> run_flags;    // per run: run_forced, run_moments
  std::vector<std::int32_t> run_of_slot;  // -1: not active
  std::vector<float> les;                 // per slot: 18 sqrt2 L^2, or what prescribed_les says
  VelocityGradients gradients;            // for hrr and vreman
  std::vector<std::uint8_t> fluid;  // by slot: the centre lies in the fluid; empty: that of every active cell does
  std::size_t fluid_cells = 0;
  // What the wall keeps of its cells, and scratch of its step; null for other walls. Copies of an Air share it.
  std::shared_ptr<PartialCells> partial;  // WallScheme::psm
  std::shared_ptr<Markers> markers;       // WallScheme::ibm
  std::shared_ptr<WallModel> wall_model;  // AirOptions::wall_model
  std::int64_t steps = 0;
  std::int64_t limited = 0;   // cells x steps in which the positivity limiter acted
  std::int64_t backflow = 0;  // outlet cells x steps with the back-flow cut

  /// Outward normal of the face that the link crosses.
  const geometry::Vec3& outward(const OpeningLink& link) const {
    const auto& parts = boundaries[link.patch].parts;
    return parts ? parts->normal[link.part] : normal[link.patch];
  }
  Parity parity() const;  // kind of the next collision
  bool is_fluid(std::ptrdiff_t slot) const { return fluid.empty() || fluid[slot] != 0; }
};

/// Lays out cells and links and starts from air at rest. Throws as Rows and build_links do.
Air make_air(const geometry::Voxels& voxels, const LinkGeometry& surface, const AirOptions& options);

/// One collision and streaming of every cell. Moments are written in runs flagged run_moments, forces read in runs
/// flagged run_forced.
KernelReport collide_and_stream(const CollisionConstants& constants, const Drive& drive, Air& air);

/// Walls, openings and periodic faces; completes the step. To be called once after each collide_and_stream.
void apply_links(const Drive& drive, Air& air);

/// Both at once, to the same bits, in one pass: the links of cells are applied while these are still in the cache
/// (link_schedule.hpp).
KernelReport advance_air(const CollisionConstants& constants, const Drive& drive, Air& air);

/// Density and velocity at an active slot between steps (force of the coming step not included, but that of markers as
/// it was laid last).
CellMoments<double> moments_at(const Air& air, std::ptrdiff_t slot);
/// Fills air.moments at every active cell.
void find_moments(Air& air);
/// Sum of rho - 1 over the active cells.
double mass_excess(const Air& air);

/// Sets the equilibrium of a density and velocity at every cell; `stress`: non-equilibrium stress, whose trace is
/// dropped.
struct InitialCell {
  double density_excess = 0.0;
  std::array<double, 3> velocity{0, 0, 0};
  std::array<double, 6> stress{0, 0, 0, 0, 0, 0};  // Pi_ab: xx, yy, zz, xy, xz, yz
};
void set_cells(const std::function<InitialCell(const geometry::Vec3& centre)>& state, Air& air);

/// Force of the air on a wall patch in the last step, by momentum exchange over its cut links [lattice units], with the
/// pressure counted from the reference density.
std::array<double, 3> force_on_patch(const Air& air, int boundary);

/// Mass through the links of an opening in the last step, positive into the domain.
double mass_through(const Air& air, int boundary);

/// Runs a function over all chunks of rows in parallel; the partition does not depend on the number of threads.
template <class F>
void for_each_chunk(const Rows& rows, const F& body) {
  oneapi::tbb::parallel_for(
      std::size_t{0}, rows.chunks().size(), [&](std::size_t c) { body(static_cast<int>(c), rows.chunks()[c]); },
      oneapi::tbb::static_partitioner());
}

}  // namespace puffin::lbm
