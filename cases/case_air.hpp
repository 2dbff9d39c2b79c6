#pragma once
// [air]: model, fluid, start and boundaries.

#include <string>
#include <variant>
#include <vector>

#include "cases/case_values.hpp"

namespace puffin::cases {

enum class AirModel { none, lbm, frozen };
struct UniformField {
  Vec3 velocity = Vec3::Zero();  // [m/s]
  bool operator==(const UniformField&) const = default;
};
struct ShearField {  // u(x) = velocity + gradient * (n . x) d, n and d of length one along normal and direction
  Vec3 velocity = Vec3::Zero();
  double gradient = 0.0;  // [1/s]
  Vec3 direction = Vec3::UnitX(), normal = Vec3::UnitZ();
  bool operator==(const ShearField&) const = default;
};
struct SolidBodyField {  // u(x) = omega * axis x (x - center)
  Vec3 axis = Vec3::UnitZ(), center = Vec3::Zero();
  double omega = 0.0;  // [rad/s]
  bool operator==(const SolidBodyField&) const = default;
};
struct FieldFile {  // CSV x, y, z, u, v, w [m, m/s]
  std::string file;
  bool operator==(const FieldFile&) const = default;
};
struct RunField {  // a stored field of another run
  std::string run;
  double at = 0.0;  // [s]
  bool operator==(const RunField&) const = default;
};
using FrozenField = std::variant<UniformField, ShearField, SolidBodyField, FieldFile, RunField>;

struct ForceFile {  // CSV time, fx, fy, fz [s, N/m^3]
  std::string file;
  bool operator==(const ForceFile&) const = default;
};
enum class InitialField { uniform, taylor_green, shear_layer, file };

enum class BoundaryType { velocity_inlet, pressure_outlet, wall, moving_wall, slip, periodic };
enum class Profile { plug, duct, parabolic, pipe, file };
struct FlowRate {  // [m^3/s] into the domain
  TimeTable table;
  bool operator==(const FlowRate&) const = default;
};
struct MeanSpeed {  // [m/s] section mean, into the domain
  double value = 0.0;
  bool operator==(const MeanSpeed&) const = default;
};
struct Velocity {  // [m/s] a vector
  Vec3 value = Vec3::Zero();
  bool operator==(const Velocity&) const = default;
};
/// monostate: the type of boundary has no flow of its own (outlet, wall, periodic, profile from a file).
using BoundaryFlow = std::variant<std::monostate, FlowRate, MeanSpeed, Velocity>;
struct Boundary {
  std::string patch;
  BoundaryType type = BoundaryType::wall;
  Profile profile = Profile::plug;  // velocity-inlet
  std::string profile_file;         // profile = { file }: CSV x, y, z, u, v, w
  BoundaryFlow flow;                // velocity-inlet; a moving wall has Velocity
  double turbulence = 0.0;          // velocity-inlet: rms fluctuation over the mean
  double pressure = 0.0;            // pressure-outlet [Pa], gauge
  std::string with;                 // periodic: the partner patch
  bool operator==(const Boundary&) const = default;
};
struct Air {
  AirModel model = AirModel::lbm;
  FrozenField frozen;                                             // model = frozen
  double density = 0.0;                                           // [kg/m^3]
  double viscosity = 0.0;                                         // [Pa s]
  std::variant<Vec3, ForceFile> body_force = Vec3(Vec3::Zero());  // [N/m^3]
  InitialField initial = InitialField::uniform;
  Vec3 initial_velocity = Vec3::Zero();  // [m/s]; Taylor-Green and shear layer: its norm is the amplitude
  std::string initial_file;              // initial = { file }
  std::vector<Boundary> boundaries;
  bool operator==(const Air&) const = default;
};

}  // namespace puffin::cases
