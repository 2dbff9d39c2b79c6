#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "cases/bed_store.hpp"
#include "cases/build.hpp"
#include "cases/derived.hpp"
#include "cases/fill.hpp"
#include "cases/micromodel_file.hpp"
#include "cases/settle.hpp"
#include "cases/untagged_openings.hpp"

namespace puffin::cases {

namespace {

dem::Friction friction_of(const Friction& f) {
  if (const auto* constant = std::get_if<double>(&f)) return dem::ConstantFriction{*constant};
  const auto& v = std::get<VelocityFriction>(f);
  return dem::SpeedFriction{v.stick, v.slip, v.limit, v.slip_speed, v.limit_speed};
}

/// The keys that all adhesion models share.
template <class Law>
Law adhesion_of(const Adhesion& a, std::uint64_t seed) {
  Law law;
  law.surface_energy = a.surface_energy;
  law.parcel_scaling = a.parcel_scaling == ParcelScaling::ddpm     ? dem::ParcelScaling::ddpm
                       : a.parcel_scaling == ParcelScaling::energy ? dem::ParcelScaling::energy
                                                                   : dem::ParcelScaling::mass;
  law.spread = {a.sigma, seed};
  return law;
}

/// `carrier`: the carrier's own constants; `contact`: those of what it touches (the same between carriers), with the
/// restitution and friction of the pair.
dem::Surfaces surfaces_of(const Contact& carrier, const Contact& contact, const Adhesion& adhesion,
                          std::uint64_t seed) {
  dem::Surfaces surfaces;
  if (contact.model == ContactModel::hertz || adhesion.model == AdhesionModel::jkr) {
    dem::HertzContact hertz;
    hertz.restitution = contact.restitution;
    hertz.friction = friction_of(contact.friction);
    hertz.rolling_friction = contact.rolling_friction;
    hertz.partner = {contact.youngs_modulus, contact.poisson};
    hertz.body =
        carrier.youngs_modulus > 0.0 ? dem::Elasticity{carrier.youngs_modulus, carrier.poisson} : hertz.partner;
    surfaces.contact = hertz;
  } else {
    dem::LinearContact linear;
    linear.restitution = contact.restitution;
    linear.friction = friction_of(contact.friction);
    linear.rolling_friction = contact.rolling_friction;
    linear.stiffness = contact.stiffness;
    linear.max_overlap = contact.max_overlap;
    surfaces.contact = linear;
  }
  if (!(adhesion.surface_energy > 0.0)) return surfaces;  // the end of a sweep: none
  if (adhesion.model == AdhesionModel::hamaker) {
    auto hamaker = adhesion_of<dem::Hamaker>(adhesion, seed);
    hamaker.hamaker = adhesion.hamaker;
    hamaker.cutoff_gap = adhesion.cutoff_gap;
    surfaces.adhesion = hamaker;
  } else if (adhesion.model == AdhesionModel::dmt) {
    auto dmt = adhesion_of<dem::Dmt>(adhesion, seed);
    dmt.cutoff_gap = adhesion.cutoff_gap;
    surfaces.adhesion = dmt;
  } else if (adhesion.model == AdhesionModel::jkr) {
    surfaces.adhesion = adhesion_of<dem::Jkr>(adhesion, seed);
  }
  return surfaces;
}

/// What a dose that was stacked or read, not settled, does first.
std::string start_of(const Dose& dose, const Carriers& c) {
  if (c.fill->shape == FillShape::file) return "; as the file places it";
  const double fall = dose.height * c.fill->gap / (1.0 + c.fill->gap), g = c.gravity.norm();
  char text[240];
  if (!(fall > 0.0) || !(g > 0.0))
    std::snprintf(text, sizeof text, "; it stays as stacked until something moves it");
  else
    std::snprintf(
        text, sizeof text,
        "; not in contact at the start: its gaps of %.2g diameters close under gravity, the top falls by up to "
        "%.2g mm in some %.2g ms, and what touches before the first motion is not counted",
        c.fill->gap, 1e3 * fall, 1e3 * std::sqrt(2.0 * fall / g));
  return text;
}

/// A contact gives by up to a part of the larger carrier: what is smaller may be pressed through a wall by it.
void warn_of_sizes(const std::vector<dem::Carrier>& carriers, const Contact& contact,
                   std::vector<std::string>& warnings) {
  if (carriers.empty() || contact.model != ContactModel::linear) return;
  const auto [small, large] = std::minmax_element(carriers.begin(), carriers.end(),
                                                  [](const auto& a, const auto& b) { return a.radius < b.radius; });
  const double gives = 2.0 * contact.max_overlap * large->radius;
  if (gives < small->radius) return;
  char text[256];
  std::snprintf(text, sizeof text,
                "carriers.contact.max_overlap = %g lets the largest carriers (%.3g um) give by %.3g um and press the "
                "smallest (%.3g um) through a wall: give at most %.2g",
                contact.max_overlap, 2e6 * large->radius, 1e6 * gives, 2e6 * small->radius,
                0.5 * small->radius / large->radius);
  warnings.push_back(text);
}

/// Lets the dose fall, with every opening closed, and says what came of it.
void settle_dose(Simulation& s, std::vector<dem::Carrier>& carriers) {
  const Carriers& c = *s.description.carriers;
  const coupling::MeshWalls closed(s.tree);
  const auto fall = [&] { return settle(s.models.carriers, closed, carriers); };
  const SettledBed bed = s.beds.empty() ? fall()
                                        : stored_bed(s.beds, bed_key(s.models.carriers, s.surface.mesh, carriers),
                                                     carriers.size(), fall, s.bed_was_kept);
  for (std::size_t p = 0; p < carriers.size(); ++p) carriers[p].position = bed.positions[p];
  const Vec3 up = -c.gravity.normalized();
  if (c.fill->bulk_density) loosen(*c.fill->bulk_density, up, carriers);
  char text[160];
  std::snprintf(text, sizeof text, "; settled in %.3g ms%s, bulk density %.0f kg/m^3%s", 1e3 * bed.time,
                bed.at_rest ? "" : " (not all at rest)", bulk_density(carriers, up),
                c.fill->bulk_density ? " after loosening" : "");
  s.dose += text;
}

}  // namespace

void build_carriers(Simulation& s) {
  const Carriers& c = *s.description.carriers;
  coupling::Models& m = s.models;
  const std::uint64_t seed = s.description.numerics.seed;
  m.carriers.carrier = surfaces_of(c.contact, c.contact, c.adhesion, seed);
  m.carriers.wall = surfaces_of(c.contact, c.wall_contact, c.wall_adhesion, seed);
  m.carriers.gravity = c.gravity;
  m.carriers.rotation = c.rotation;
  m.carriers.on_wall = c.wall_contact.on_wall == OnWall::stick ? dem::OnWall::stick : dem::OnWall::bounce;
  m.drag = c.drag == Drag::none        ? coupling::DragLaw(coupling::NoDrag{})
           : c.drag == Drag::di_felice ? coupling::DragLaw(coupling::DiFelice{})
           : c.drag == Drag::beetstra  ? coupling::DragLaw(coupling::Beetstra{})
                                       : coupling::DragLaw(coupling::SchillerNaumann{});
  m.volume_fraction = c.volume_fraction == VolumeFraction::none   ? coupling::VolumeFraction::none
                      : c.volume_fraction == VolumeFraction::drag ? coupling::VolumeFraction::in_drag
                                                                  : coupling::VolumeFraction::averaged;
  m.lift = c.lift == Lift::none          ? coupling::Lift::none
           : c.lift == Lift::saffman_mei ? coupling::Lift::saffman_mei
                                         : coupling::Lift::saffman_magnus;
  m.pressure_gradient = c.pressure_gradient;
  m.near_wall = c.near_wall;
  m.two_way = c.two_way;
  if (s.description.air.model == AirModel::frozen && c.volume_fraction != VolumeFraction::none &&
      (c.drag == Drag::di_felice || c.drag == Drag::beetstra || c.volume_fraction == VolumeFraction::averaged))
    s.warnings.push_back(
        "carriers.volume_fraction: in frozen air every carrier is dragged as one alone, whatever lies beside it");
  if (!c.two_way && m.volume_fraction == coupling::VolumeFraction::averaged &&
      s.description.air.model == AirModel::lbm) {
    m.volume_fraction = coupling::VolumeFraction::in_drag;
    s.warnings.push_back(
        "carriers.volume_fraction = \"averaged\" needs carriers.two_way = true: without it the air does not know the "
        "carriers, whose volume counts in the drag law alone, as with \"drag\"");
  }
  const Numerics& n = s.description.numerics;
  // A frozen field costs nothing to read: the loads are renewed every step.
  const bool read_anew = s.description.air.model == AirModel::frozen && !s.description.fines &&
                         s.description.places.of.count("numerics.coupling_interval") == 0;
  m.steps_per_exchange = read_anew ? 1 : n.coupling_interval;
  m.steps_per_exchange_asleep =
      n.skip.resting_exchange ? std::max(m.steps_per_exchange_asleep, n.coupling_interval) : n.coupling_interval;
  m.carriers.integration.sleep = n.skip.sleeping_carriers;
  m.carriers.integration.free_flight = n.skip.free_flight;
  m.carriers_start = c.start;
  m.settling = c.fill.has_value();

  std::vector<int> openings;
  m.opening_of_triangle.assign(s.surface.mesh.triangles.size(), -1);
  for (std::size_t t = 0; t < s.surface.mesh.triangles.size(); ++t) {
    const int patch = s.surface.patches.of_triangle[t];
    const coupling::PatchDrive& drive = m.patches[patch];
    const bool opens = drive.is_inlet || drive.is_outlet || is_open_unsaid(s.description, drive.patch);
    if (c.outside != Outside::remove || !opens) continue;
    openings.push_back(static_cast<int>(t));
    m.opening_of_triangle[t] = patch;
  }
  m.walls = std::make_shared<const coupling::MeshWalls>(s.tree, openings);

  std::vector<dem::Carrier> carriers;
  if (c.fill) {
    const Dose dose = dose_of(s.description, s.surface, *s.tree);
    s.dose = dose.description;
    for (std::size_t p = 0; p < dose.positions.size(); ++p) {
      dem::Carrier carrier;
      carrier.id = static_cast<std::int64_t>(p);
      carrier.position = dose.positions[p];
      carrier.radius = dose.radius[p];
      carrier.carriers = c.parcel;
      carrier.single_radius = dose.radius[p] / std::cbrt(static_cast<double>(c.parcel));
      const double bare = carrier_mass(2.0 * carrier.single_radius, c.density);
      carrier.mass = c.parcel * bare * (1.0 + c.fines_each * c.fine_mass_ratio);
      carriers.push_back(carrier);
    }
    if (c.fill->shape == FillShape::settled)
      settle_dose(s, carriers);
    else
      s.dose += start_of(dose, c);
  } else {
    s.dose = std::to_string(c.list.size()) + " carriers listed one by one";
    for (const ListedCarrier& listed : c.list) {
      dem::Carrier carrier;
      carrier.id = static_cast<std::int64_t>(carriers.size());
      carrier.position = listed.position;
      carrier.velocity = listed.velocity;
      carrier.spin = c.rotation ? listed.spin : Vec3(Vec3::Zero());
      carrier.radius = 0.5 * parcel_diameter(listed.diameter, c.parcel);
      carrier.single_radius = 0.5 * listed.diameter;
      carrier.carriers = c.parcel;
      carrier.mass =
          c.parcel * carrier_mass(listed.diameter, listed.density) * (1.0 + c.fines_each * c.fine_mass_ratio);
      carriers.push_back(carrier);
    }
  }
  warn_of_sizes(carriers, c.contact, s.warnings);
  dem::add(carriers, s.state.carriers);
  for (const auto& carrier : carriers) s.dose_mass += carrier.mass;
  if (c.start > 0.0)
    for (auto& rest : s.state.carriers.carriers.rest) rest = dem::Rest::held;
  const std::size_t triangles = s.surface.mesh.triangles.size();
  s.state.collisions = coupling::Collisions(s.state.carriers.carriers, triangles);
  s.state.first_motion = coupling::FirstMotion(s.state.carriers.carriers);
  s.state.fines = coupling::Fines(s.state.carriers.carriers, s.description.fines ? c.fines_each : 0.0, triangles);
}

}  // namespace puffin::cases
