#pragma once
// Readings of the air during a run: pressure drops, points, planes. SI units.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/build.hpp"

namespace puffin::tools {

struct PointReading {
  coupling::Vec3 velocity = coupling::Vec3::Zero();  // [m/s]
  double pressure = 0.0;                             // [Pa]
};

/// Velocity and pressure of one active cell, in the middle of a step: half of the uniform body force included.
PointReading read_cell(const cases::Simulation& s, std::ptrdiff_t slot);

/// Reads the air at points: a frozen field as it is given; else a parabola along each axis between cell centres; across
/// a periodic face from the other side. Where some of the eight cells around a point are not fluid (beside an oblique
/// wall up to sqrt(3) cells from it) the velocity follows the parabola through the wall's own velocity and the readings
/// at h and 2h from the wall along its normal, h the least of 1, 1.25, 1.5, 1.75 cells for which both have all of their
/// eight cells: second order up to the wall. The pressure follows the parabola through the readings at h, 2h and 3h (a
/// line where the third lacks cells). At an edge that stands out into the fluid the straight line from it to the point
/// is the normal. Where no h will do, within a cell of the wall: the line through the wall's velocity and the reading
/// one cell from it, if half of that one's cells are fluid. Elsewhere the cells outside the fluid are left out and the
/// rest weighted to 1; but a point on a wall has the wall's velocity.
class PointReader {
 public:
  PointReader() = default;
  explicit PointReader(const cases::Simulation& s);
  /// Empty: the point lies outside the fluid.
  std::optional<PointReading> read(const cases::Simulation& s, const coupling::Vec3& x) const;
  /// Throws cases::CaseError, at its place in the file, for each probe, line, plane, slice or box of the case that
  /// meets no fluid. Returns a sentence for each line that lies outside in part.
  std::vector<std::string> check_places(const cases::Simulation& s) const;

 private:
  struct Mean {
    PointReading reading;
    double weight = 0.0;  // of the fluid among the eight cells
  };
  Mean mean_of_cells(const cases::Simulation& s, const coupling::Vec3& x) const;  // trilinear
  /// Less the curvature between the cells, half of part (1 - part) of the second difference along each axis, around the
  /// point or up to a cell beside it: a parabola is read as it is. Trilinear where cells are missing.
  Mean curved_mean(const cases::Simulation& s, const coupling::Vec3& x) const;
  /// Where some of the cells around x, whose weighted reading is `mean`, are missing.
  std::optional<PointReading> beside_wall(const cases::Simulation& s, const coupling::Vec3& x, const Mean& mean) const;
  /// The nearest place of a wall to a point, and how the point lies from there.
  struct Foot {
    coupling::Vec3 point, along, velocity;  // [m]; towards the point, of length 1; of the wall [m/s]
    double distance = 0.0;                  // [m]
  };
  /// Empty: no pair of support points has all of its cells.
  std::optional<PointReading> on_parabola(const cases::Simulation& s, const Foot& foot) const;

  std::shared_ptr<const lbm::geometry::TriangleTree> walls_;  // the air sticks to these; empty: none
  std::vector<int> patch_;                                    // per triangle of walls_
};

/// Place of the n-th point of a line [m].
coupling::Vec3 place_on(const cases::Line& line, int n);

struct DropReading {
  double flow_rate = 0.0;             // into the device [m^3/s]
  double static_drop = 0.0;           // area mean at the inlets minus that at the outlets [Pa]
  double total_to_static_drop = 0.0;  // flux-weighted total pressure at the inlets minus static at the outlets [Pa]
};

/// Reads pressure drops between the openings' planes: at a pressure outlet the pressure that it holds, at a velocity
/// inlet a straight line through the second and third cell, as the first is the condition's own. Which cells these are
/// is found once. Where no boundary gives the flow, the openings at which air enters at the moment are the inlets, and
/// what enters is the flow rate.
class DropReader {
 public:
  explicit DropReader(const cases::Simulation& s);
  DropReading read(const cases::Simulation& s) const;
  bool has_both() const { return (!inlet_.empty() && !outlet_.empty()) || between_pressures_; }

 private:
  struct Cell {
    std::ptrdiff_t slot, next;  // the second cell from the opening, and the third; the one before where it is missing
    int patch;
    coupling::Vec3 outward;  // of the opening
  };
  std::vector<Cell> inlet_, outlet_;
  bool between_pressures_ = false;  // no inlet, two outlets or more
};

/// Forces of the air on patches [N].
class ForceReader {
 public:
  explicit ForceReader(const cases::Simulation& s);
  /// "wall" means all walls if no patch is called so.
  coupling::Vec3 read(const cases::Simulation& s, const std::string& patch) const;

 private:
  std::vector<coupling::Vec3> outwards_;  // area, as a vector, per boundary [m^2]; empty: no forces
  std::vector<double> excess_;  // volume on which a body force acts too much, per boundary [dx^3]; empty: no body force
};

struct PlaneReading {
  double flow_rate = 0.0;        // mass flow along the normal over the reference density [m^3/s]
  double static_pressure = 0.0;  // area mean [Pa]
  double total_pressure = 0.0;   // flux-weighted mean of p + rho u^2/2 [Pa]
};

/// Sums over the whole domain.
struct Totals {
  double kinetic_energy = 0.0;                               // of the air: mean of u^2/2 over the cells [m^2/s^2]
  coupling::Vec3 air_momentum = coupling::Vec3::Zero();      // [kg m/s]
  coupling::Vec3 carrier_momentum = coupling::Vec3::Zero();  // of the carriers inside [kg m/s]
};
/// The same bits for every number of threads.
Totals read_totals(const cases::Simulation& s);

/// Over the cells that the plane passes through. Pressures: between the two layers of cells around the plane (across a
/// periodic face the first and the last) where they have as many cells, else those of the nearer. Before the first and
/// behind the last layer, as in the plane of an opening: a straight line through the two nearest, where they have as
/// many cells. The lattice keeps mass, so in steady flow every plane across a channel reads one flow rate. Empty: the
/// plane meets no fluid.
std::optional<PlaneReading> read_plane(const cases::Simulation& s, int axis, double at);

}  // namespace puffin::tools
