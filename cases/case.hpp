#pragma once
// What a case file says, in SI units, checked: one struct per table of the file, one member per key. A Case that
// `read_case` returned has no unset required value and no contradiction; what needs the geometry (areas, volumes)
// is resolved later by the builder. Long, because it mirrors the whole file and is looked up, not read through.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace puffin::cases {

using Vec3 = Eigen::Vector3d;

/// A value of a free-form table (generator parameters, reference numbers): numbers are SI.
using Parameter = std::variant<double, std::vector<double>, std::string, bool>;

/// A quantity over time, linear between the rows and constant outside them. One row is a constant.
struct TimeTable {
  std::vector<double> time;   // [s], strictly increasing
  std::vector<double> value;  // same length
  double at(double t) const;
  bool operator==(const TimeTable&) const = default;
};

// ---------------------------------------------------------------- [geometry]
struct Generated {
  std::string kind;                             // "l-bend", ...; the parameters not given keep the generator's defaults
  std::map<std::string, Parameter> parameters;  // [m], angles [rad]
  bool operator==(const Generated&) const = default;
};
struct StlFile {
  std::string file;    // path as it can be opened (a relative one is relative to the case file)
  double unit = 1e-3;  // [m] length of one unit of the file
  bool operator==(const StlFile&) const = default;
};
struct Patch {
  std::string name;
  std::string select;  // "solid:NAME", "plane:x-min", "near:[x,y,z]" [m]: checked, as lbm/geometry/patches.hpp reads it
  bool operator==(const Patch&) const = default;
};
struct Geometry {
  std::variant<Generated, StlFile> source;
  std::vector<Patch> patches;  // tagged by hand; a generator names its own patches
  bool operator==(const Geometry&) const = default;
};

// ---------------------------------------------------------------- [air]
enum class AirModel { none, lbm, frozen };
struct UniformField {
  Vec3 velocity = Vec3::Zero();  // [m/s]
  bool operator==(const UniformField&) const = default;
};
struct ShearField {  // u(x) = velocity + gradient * (normal . x) * direction
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

// ---------------------------------------------------------------- [numerics]
enum class TimeStepRule { follow_ramp, fixed, given };
enum class Collision { bgk, trt, rr3, hrr, central_moments };
enum class WallScheme { bouzidi, ibm, psm, halfway };
enum class Les { none, smagorinsky, vreman };
enum class Precision { float32, float64 };
/// What a run leaves out because the answer does not need it. All on by default; `puffin bench skip` measures each.
struct Skip {
  bool sleeping_carriers = true;  // carriers at rest are not moved until something disturbs them
  bool resting_exchange = true;   // fewer exchanges with the air while every carrier rests
  bool idle_transport = true;     // no transport before the first fine is airborne
  bool empty_cells = true;        // no transport where there are no fines nearby
  bool transport_steps = true;    // transport in longer steps than the air's
  bool operator==(const Skip&) const = default;
};
struct Numerics {
  std::optional<double> dx;               // [m]; exactly one of dx and cells is given
  std::optional<std::int64_t> cells;      // wanted number of fluid cells: dx = cbrt(volume / cells)
  double lattice_speed = 0.0;             // the reference speed in lattice units
  std::optional<double> reference_speed;  // [m/s]; empty: "auto", the largest section-mean speed of the run
  TimeStepRule time_step = TimeStepRule::follow_ramp;
  double time_step_seconds = 0.0;  // [s], time_step = given
  Collision collision = Collision::rr3;
  double hrr_sigma = 0.0;  // share of the cell's own stress in the collision hrr
  WallScheme wall = WallScheme::bouzidi;
  Les les = Les::smagorinsky;
  double smagorinsky_constant = 0.0;
  bool wall_model = false;
  Precision precision = Precision::float32;
  int coupling_interval = 5;  // air steps between two exchanges with moving carriers
  double scalar_cfl = 0.8;    // largest part of a cell's air that leaves it in one step of the transport
  Skip skip;
  int threads = 0;  // 0: all
  std::uint64_t seed = 0;
  bool operator==(const Numerics&) const = default;
};

// ---------------------------------------------------------------- [carriers]
enum class FillShape { cylinder, cube, settled, file };
struct Fill {
  FillShape shape = FillShape::cylinder;
  std::variant<std::string, Vec3> at;                    // a patch (its floor) or a point [m]
  double gap = 0.0;                                      // gap between neighbours over the parcel diameter
  double jitter = 0.0;                                   // random offset over the parcel diameter
  std::optional<std::array<std::int64_t, 2>> extent_of;  // {count, parcel}: outer size of that cube, ours spread in it
  std::string file;                                      // shape = file: CSV of centres x, y, z
  std::optional<double> bulk_density;                    // shape = settled: lift the bed to it [kg/m^3]
  bool operator==(const Fill&) const = default;
};
struct ListedCarrier {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), spin = Vec3::Zero();  // [m], [m/s], [rad/s]
  double diameter = 0.0;                                                       // [m]
  double density = 0.0;                                                        // [kg/m^3]
  bool operator==(const ListedCarrier&) const = default;
};
/// Diameters that differ from carrier to carrier.
enum class SizeLaw { log_normal, rosin_rammler, table };
struct SizeDistribution {
  SizeLaw law = SizeLaw::log_normal;
  bool by_volume = true;                 // shares of volume (sieves, laser diffraction), not of number
  double median = 0.0, sigma = 0.0;      // log-normal: [m], deviation of ln d
  double scale = 0.0, exponent = 0.0;    // Rosin-Rammler: share above d = exp(-(d/scale)^exponent); [m]
  std::string file;                      // table: CSV diameter [m], share of all below it (0 to 1)
  double smallest = 0.0, largest = 0.0;  // cut off beyond [m]
  bool operator==(const SizeDistribution&) const = default;
};
enum class Drag { none, schiller_naumann, di_felice, beetstra };
enum class VolumeFraction { none, drag, averaged };
enum class Lift { none, saffman_mei, saffman_magnus };
enum class Outside { remove, bounce };
enum class ContactModel { linear, hertz };
enum class OnWall { bounce, stick };
enum class AdhesionModel { none, hamaker, dmt, jkr };
enum class ParcelScaling { ddpm, energy, mass };

/// Friction coefficient falling with the sliding speed v: `stick` at v = 0 to `slip` at v = slip_speed, on to `limit`
/// at v = limit_speed (the law of the thesis's solver).
struct VelocityFriction {
  double stick = 0.0, slip = 0.0;
  double slip_speed = 0.0;  // [m/s]
  double limit = 0.0;
  double limit_speed = 0.0;  // [m/s]
  bool operator==(const VelocityFriction&) const = default;
};
using Friction = std::variant<double, VelocityFriction>;

struct Contact {
  ContactModel model = ContactModel::linear;
  std::optional<double> stiffness;  // [N/m]; empty: "auto", from max_overlap
  double max_overlap = 0.0;         // over the radius, at the fastest impact
  double restitution = 0.0;
  Friction friction = 0.0;
  double rolling_friction = 0.0;
  double youngs_modulus = 0.0;  // [Pa], hertz
  double poisson = 0.0;         // hertz
  OnWall on_wall = OnWall::bounce;
  bool operator==(const Contact&) const = default;
};
struct Adhesion {
  AdhesionModel model = AdhesionModel::none;
  double surface_energy = 0.0;  // gamma of ONE surface [J/m^2]; the median where sigma > 0
  double sigma = 0.0;           // of ln(gamma) over the carriers; 0: all alike
  double hamaker = 0.0;         // [J]
  double cutoff_gap = 0.0;      // d0 [m]; gamma = H / (24 pi d0^2)
  ParcelScaling parcel_scaling = ParcelScaling::ddpm;
  bool operator==(const Adhesion&) const = default;
};
struct Carriers {
  std::int64_t count = 0;  // single carriers
  int parcel = 1;          // carriers a parcel
  double diameter = 0.0;   // [m]; with `sizes`: of the mean volume
  std::optional<SizeDistribution> sizes;
  double density = 0.0;          // [kg/m^3]
  double fines_each = 0.0;       // fines on one carrier at the start
  double fine_mass_ratio = 0.0;  // mass of a fine over the mass of a carrier
  std::optional<Fill> fill;      // exactly one of fill and list
  std::vector<ListedCarrier> list;
  Vec3 gravity = Vec3::Zero();  // [m/s^2]
  Drag drag = Drag::schiller_naumann;
  VolumeFraction volume_fraction = VolumeFraction::drag;
  Lift lift = Lift::none;
  bool pressure_gradient = false;  // force of the air's pressure gradient
  bool near_wall = false;          // drag grows beside walls
  bool rotation = true;
  bool two_way = true;
  double start = 0.0;  // [s] carriers are held until then
  Outside outside = Outside::remove;
  Contact contact, wall_contact;  // between carriers; against walls
  Adhesion adhesion, wall_adhesion;
  bool operator==(const Carriers&) const = default;
};

// ---------------------------------------------------------------- [fines]
enum class WallDeposition { none, inertial, drift_only };
enum class ScalarScheme { upwind, minmod, van_leer, mc };
enum class ScalarWall { reflect, absorb };
struct GaussianBlob {          // an initial cloud of `amount` fines in all
  Vec3 center = Vec3::Zero();  // [m]
  double sigma = 0.0;          // [m]
  double amount = 0.0;         // [1]
  bool operator==(const GaussianBlob&) const = default;
};
struct Scalar {
  std::string name;
  double diffusion = 0.0;  // [kg/(m s)]: rho D
  ScalarScheme scheme = ScalarScheme::mc;
  ScalarWall wall = ScalarWall::reflect;
  std::optional<GaussianBlob> initial;
  bool operator==(const Scalar&) const = default;
};
struct ScalarBoundary {  // a fixed value on a patch
  std::string patch, scalar;
  double value = 0.0;  // [1/m^3]
  bool operator==(const ScalarBoundary&) const = default;
};
struct Fines {
  std::string micromodels;  // file as it can be opened; empty: nothing moves the fines (scalar scenes)
  WallDeposition wall_deposition = WallDeposition::none;
  double diameter = 0.0;             // [m]
  double density = 0.0;              // [kg/m^3]
  Vec3 gravity = Vec3(0, 0, -9.81);  // [m/s^2] on fines with inertia
  double turbulent_schmidt = 0.0;    // of the unresolved eddies; 0: they mix no fines
  double reattachment = 0.0;         // part of the airborne fines meeting a carrier that stays on it; 0: off
  double pick_up = 0.0;              // part of the wall's fines in reach of a hit that the carrier takes; 0: off
  std::vector<Scalar> scalars;
  std::vector<ScalarBoundary> boundaries;
  bool operator==(const Fines&) const = default;
};

// ---------------------------------------------------------------- [stop] [output]
struct Stop {
  double time = 0.0;  // [s]
  bool when_empty = true;
  bool operator==(const Stop&) const = default;
};
struct RegionAll {
  bool operator==(const RegionAll&) const = default;
};
struct RegionSlice {
  int axis = 2;
  double at = 0.0;  // [m]
  bool operator==(const RegionSlice&) const = default;
};
struct RegionBox {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();  // [m]
  bool operator==(const RegionBox&) const = default;
};
using Region = std::variant<RegionAll, RegionSlice, RegionBox>;
struct FieldOutput {
  bool velocity = false, pressure = false, fines = false;
  Region region;
  double every = 0.0;  // [s]
  bool operator==(const FieldOutput&) const = default;
};
struct Probe {
  std::string name;
  Vec3 at = Vec3::Zero();
  bool operator==(const Probe&) const = default;
};
struct Line {
  std::string name;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  int points = 0;
  double average_from = 0.0;  // [s]; stop.time: the end alone
  bool operator==(const Line&) const = default;
};
struct Plane {
  std::string name;
  int axis = 0;     // the normal
  double at = 0.0;  // [m]
  bool operator==(const Plane&) const = default;
};
struct Checkpoints {
  double wall = 0.0;  // [s] of wall-clock between checkpoints
  int keep = 0;
  bool operator==(const Checkpoints&) const = default;
};
/// An output interval [s]; infinity: never.
inline constexpr double never = std::numeric_limits<double>::infinity();
struct Output {
  double statistics = 0.0;  // [s]
  std::vector<FieldOutput> fields;
  double carriers = never;  // [s]
  bool wall_map = true;     // at the end of the run
  bool events = true;
  Checkpoints checkpoint;
  std::vector<Probe> probes;
  std::vector<Line> lines;
  std::vector<Plane> planes;
  std::vector<std::string> forces;                       // patches
  std::optional<std::array<double, 2>> pressure_window;  // [s]; empty: the last 10 % of the run
  bool operator==(const Output&) const = default;
};

// ---------------------------------------------------------------- the case
/// Where a value came from. assumed: given, and the line's comment says "assumed: why".
enum class Origin { given, defaulted, derived, assumed };
struct ValueSource {
  Origin origin = Origin::given;
  std::string note;  // the reason of an assumption, the formula of a derived value
  bool operator==(const ValueSource&) const = default;
};

/// Where each key stands in the file, for errors that only the geometry brings to light; no part of what a case says.
struct KeyPlace {
  std::string file;
  int line = 0, column = 0;
};
struct KeyPlaces {
  std::map<std::string, KeyPlace> of;  // by dotted key
  bool operator==(const KeyPlaces&) const { return true; }
};

struct Case {
  std::string name;
  Geometry geometry;
  Air air;
  Numerics numerics;
  std::optional<Carriers> carriers;
  std::optional<Fines> fines;
  Stop stop;
  Output output;
  std::map<std::string, Parameter> reference;
  std::map<std::string, ValueSource> provenance;  // by dotted key, "air.boundary[0].flow_rate"
  KeyPlaces places;
  bool operator==(const Case&) const = default;
};

}  // namespace puffin::cases
