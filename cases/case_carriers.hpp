#pragma once
// [carriers]: the dose, its forces, contacts and adhesion.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cases/case_values.hpp"

namespace puffin::cases {

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
  double max_overlap = 0.0;         // of the smaller diameter, at the fastest impact
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

}  // namespace puffin::cases
