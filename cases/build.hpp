#pragma once
// From a checked Case to a simulation that is ready to step.

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/surface.hpp"
#include "coupling/state.hpp"
#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/geometry/voxelize.hpp"

namespace puffin::cases {

/// Everything a run needs. `models` and `state` are the simulation; the rest is for those who report on it.
struct Simulation {
  Case description;
  Surface surface;
  std::shared_ptr<const lbm::geometry::TriangleTree> tree;
  lbm::geometry::Voxels voxels;  // empty without a lattice
  lbm::geometry::Pockets pockets;
  double dx = 0.0;                                // [m]
  double reference_speed = 0.0;                   // [m/s]
  double lattice_speed = 0.0;                     // in lattice units: as described, or less (compressibility.hpp)
  std::vector<std::string> warnings;              // what the run does otherwise than described, or cannot do well
  double dose_mass = 0.0;                         // carriers with their fines [kg]
  std::string dose;                               // one line on how the carriers lie at the start
  std::filesystem::path beds;                     // where settled beds are kept; empty: nowhere
  bool bed_was_kept = false;                      // the dose lies as an earlier run has left it there
  std::function<Vec3(const Vec3&)> stored_field;  // velocity [m/s] of another run, air.field = { run = ... }
  coupling::Models models;
  coupling::State state;
};

/// Gives the velocity [m/s] at any point as another run has stored it: a frozen field { run, at }. The program brings
/// one along, as this folder knows no output formats. Throws std::invalid_argument if the run has no such field.
using StoredFieldReader = std::function<std::function<Vec3(const Vec3&)>(const RunField&)>;

/// available: memory [byte]; a case that needs for certain more is refused before it takes any.
/// beds: a folder for settled beds (bed_store.hpp); empty: every dose settles anew.
/// Throws CaseError (what the geometry or a table beside the case shows to be wrong), GeometryError, StlError,
/// GeneratorError, TooLarge (room.hpp), std::invalid_argument with a remedy.
std::unique_ptr<Simulation> build(const Case& c, const StoredFieldReader& stored_field = {},
                                  double available = std::numeric_limits<double>::infinity(),
                                  const std::filesystem::path& beds = {});

// The parts, in their order; each adds to the simulation.
void build_air(Simulation& s);
/// The collision of the lattice for that of the case file; the closed list of choices offers no other.
lbm::Law law_of(Collision collision);
/// Likewise for the walls.
lbm::WallScheme wall_of(WallScheme wall);
void build_carriers(Simulation& s);
void build_fines(Simulation& s);

}  // namespace puffin::cases
