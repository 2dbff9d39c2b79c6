#pragma once
// Readings of the air during a run: pressure drops, points, planes. SI units.

#include <optional>
#include <vector>

#include "cases/build.hpp"

namespace puffin::tools {

struct PointReading {
  coupling::Vec3 velocity = coupling::Vec3::Zero();  // [m/s]
  double pressure = 0.0;                             // [Pa]
};

/// Trilinear between the cell centres around a point; cells outside the fluid are left out and the rest weighted to 1.
/// Empty: no cell of the fluid beside the point.
std::optional<PointReading> read_point(const cases::Simulation& s, const coupling::Vec3& x);

struct DropReading {
  double flow_rate = 0.0;             // into the device [m^3/s]
  double static_drop = 0.0;           // area mean at the inlets minus that at the outlets [Pa]
  double total_to_static_drop = 0.0;  // flux-weighted total pressure at the inlets minus static at the outlets [Pa]
};

/// Reads pressure drops on the cells beside the openings; which cells these are is found once.
class DropReader {
 public:
  explicit DropReader(const cases::Simulation& s);
  DropReading read(const cases::Simulation& s) const;
  bool has_both() const { return !inlet_.empty() && !outlet_.empty(); }

 private:
  struct Cell {
    std::ptrdiff_t slot;
    int patch;
  };
  std::vector<Cell> inlet_, outlet_;
};

struct PlaneReading {
  double flow_rate = 0.0;        // along the normal [m^3/s]
  double static_pressure = 0.0;  // area mean [Pa]
  double total_pressure = 0.0;   // flux-weighted mean of p + rho u^2/2 [Pa]
};

/// Over the layer of cells that the plane passes through. Throws std::invalid_argument if there is none.
PlaneReading read_plane(const cases::Simulation& s, int axis, double at);

}  // namespace puffin::tools
