#pragma once
// Where the carriers, or the parcels that stand for several carriers each, are at the start.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace puffin::cases {

enum class DoseShape { cylinder, cube, file };

/// What to place, and on what floor. A parcel of n carriers is a sphere of diameter * n^(1/3): it has their volume.
struct DoseSpec {
  DoseShape shape = DoseShape::cylinder;
  std::int64_t carriers = 0;  // carriers in all; a multiple of `parcel`
  std::int64_t parcel = 1;    // carriers a parcel
  double diameter = 0.0;      // [m] of one carrier
  std::vector<double> sizes;  // [m] of one carrier of each parcel, none above `diameter`; empty: all have `diameter`
  double density = 0.0;       // [kg/m^3] of a carrier; for the bulk density in the description
  double gap = 0.2;           // between neighbours, over the parcel's diameter
  double jitter = 0.0;  // largest random offset in each coordinate, over the parcel's diameter; never above gap / 2
  std::uint64_t seed = 1;
  std::optional<std::array<std::int64_t, 2>> extent_of;  // cube: {carriers, parcel} of the stack whose extent to take
  std::string file;                                      // file: CSV x, y, z[, diameter of the parcel] [m]
  Eigen::Vector3d floor = Eigen::Vector3d::Zero();       // [m] centre of the floor the stack stands on
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();    // columns: two directions along the floor, and up, off it
  double floor_diameter = 0.0;                           // [m] cylinder: its diameter
};

struct Dose {
  std::vector<Eigen::Vector3d> positions;  // [m] centres, layer by layer from the floor up
  std::vector<double> radius;              // [m] per position
  int layers = 0;                          // 0 for a file
  double height = 0.0;                     // [m] top of the highest sphere over the floor, or over the lowest sphere
  double bulk_density = 0.0;               // [kg/m^3] mass over the volume the stack takes up, gaps included; 0: a file
  std::string description;                 // one line for the report
};

/// Counts along x, y and z of the box nearest to a cube: an exact one, nx ny nz = count, if its sides differ by no more
/// than half, else the smallest that holds `count`. nx >= ny >= nz >= 1.
std::array<std::int64_t, 3> nearest_box(std::int64_t count);

/// Right-handed axes, as columns: along a floor the x-axis, or the y-axis where x leads off it; square to that; `up`,
/// off the floor. Those of space where `up` is the z-axis, to the last bit.
Eigen::Matrix3d axes_on_floor(const Eigen::Vector3d& up);

/// Places the dose. Stacks are built along the floor's axes: height is along `up`.
/// - cylinder (the thesis, section 3.2.4): layers on a square lattice of pitch (1 + gap) d, the lowest spheres gap d /
/// 2
///   above the floor, all inside a cylinder of `floor_diameter`. Layers are filled until the count is reached; the last
///   one from its middle outwards.
/// - cube: the nearest box with the same pitch. With extent_of = {n, p}: its outer centres coincide with the outer
///   centres of the stack that n carriers in parcels of p would form, so the pitch is e.g. wider than (1 + gap) d; only
///   in height the stack is shifted so that its lowest spheres clear the floor as those would.
/// - file: centres as listed.
/// Offsets of jitter, along each axis, come from std::mt19937_64 mapped to [-1, 1) with 53 bits: the same on every
/// machine. They never make neighbours overlap.
/// inside: whether a point is in the fluid; clearance: its distance to the nearest wall [m].
/// Throws std::invalid_argument if the values make no sense, if spheres would overlap, or if one is not wholly in the
/// fluid; std::runtime_error (naming file and line) if the file cannot be read.
Dose place_dose(const DoseSpec& spec, const std::function<bool(const Eigen::Vector3d&)>& inside,
                const std::function<double(const Eigen::Vector3d&)>& clearance);

/// Diameter of a sphere with the volume of `parcel` carriers [m].
double parcel_diameter(double carrier_diameter, std::int64_t parcel);

}  // namespace puffin::cases
