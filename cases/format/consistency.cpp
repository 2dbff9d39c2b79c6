#include "cases/format/consistency.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "cases/generators/generators.hpp"
#include "cases/spelling.hpp"
#include "cases/surface.hpp"
#include "cases/units.hpp"

namespace puffin::cases::format {
namespace {

std::string indexed(const std::string& key, std::size_t i) { return key + "[" + std::to_string(i) + "]"; }

class Checks {
 public:
  Checks(const Case& c, Findings& findings) : c_(c), findings_(findings) {}

  void all() {
    geometry();
    boundaries();
    air();
    carriers();
    fines();
    outputs();
  }

 private:
  void say(const std::string& key, const std::string& text) {
    if (!findings_.broken(key)) findings_.problem(key, key + ": " + text);
  }

  template <class List>
  void unique_names(const std::string& key, const List& list) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!list[i].name.empty() && !seen.insert(list[i].name).second)
        say(indexed(key, i) + ".name", "the name '" + list[i].name + "' is used twice");
  }

  /// The patches that may be named. The solids of an STL file are known only when it is read: there nothing is checked
  /// here (the geometry check does).
  void geometry() {
    unique_names("geometry.patch", c_.geometry.patches);
    for (const Patch& p : c_.geometry.patches) patches_.push_back(p.name);
    const auto* generated = std::get_if<Generated>(&c_.geometry.source);
    patches_known_ = generated && !findings_.broken("geometry");
    if (!patches_known_) return;
    const std::vector<std::string> solids = solids_of(generated->kind, generated->parameters);
    patches_.insert(patches_.end(), solids.begin(), solids.end());
  }

  void known_patch(const std::string& key, const std::string& name) {
    if (!patches_known_ || name.empty() || std::find(patches_.begin(), patches_.end(), name) != patches_.end()) return;
    if (std::find(box_faces.begin(), box_faces.end(), name) != box_faces.end()) return;
    const std::string near = nearest(name, patches_);
    say(key, "there is no patch '" + name + "'; " +
                 (near.empty() ? "the patches are " + join(patches_) : "did you mean '" + near + "'?"));
  }

  void boundaries() {
    std::set<std::string> seen;
    bool inlet = false, outlet = false;
    for (std::size_t i = 0; i < c_.air.boundaries.size(); ++i) {
      const Boundary& b = c_.air.boundaries[i];
      const std::string key = indexed("air.boundary", i);
      known_patch(key + ".patch", b.patch);
      if (!b.patch.empty() && !seen.insert(b.patch).second)
        say(key + ".patch", "patch '" + b.patch + "' has two boundaries; keep one");
      inlet = inlet || b.type == BoundaryType::velocity_inlet;
      outlet = outlet || b.type == BoundaryType::pressure_outlet;
      if (b.type == BoundaryType::periodic) periodic(key, b);
      if (const auto* v = std::get_if<Velocity>(&b.flow); v && b.type == BoundaryType::velocity_inlet)
        if (v->value.norm() == 0.0) say(key + ".velocity", "an inlet without speed is a wall: give type = \"wall\"");
      if (const auto* rate = std::get_if<FlowRate>(&b.flow))
        if (std::any_of(rate->table.value.begin(), rate->table.value.end(), [](double q) { return q < 0.0; }))
          say(key + ".flow_rate", "an inlet's flow rate must not be negative");
      if (const auto* speed = std::get_if<MeanSpeed>(&b.flow))
        if (speed->value < 0.0) say(key + ".velocity", "the mean speed into the domain must not be negative");
    }
    if (c_.air.model == AirModel::lbm && inlet && !outlet)
      say("air.boundary", "there is a velocity-inlet but no pressure-outlet: the air has nowhere to go");
  }

  /// A pair may be named from one side or from both; its patches belong to this pair alone.
  void periodic(const std::string& key, const Boundary& b) {
    known_patch(key + ".with", b.with);
    if (b.with == b.patch) say(key + ".with", "a patch cannot be periodic with itself; name the opposite one");
    for (const Boundary& other : c_.air.boundaries) {
      if (&other == &b) continue;
      if (other.patch == b.with && other.type != BoundaryType::periodic)
        say(key + ".with", "the patch '" + b.with + "' has another boundary already; a periodic patch has no other");
      else if (other.type == BoundaryType::periodic && other.patch == b.with && other.with != b.patch)
        say(key + ".with", "the patch '" + b.with + "' is periodic with '" + other.with + "'; a pair has two patches");
      else if (other.type == BoundaryType::periodic && other.with == b.with && other.patch != b.patch)
        say(key + ".with", "the patch '" + b.with + "' is the partner of '" + other.patch + "' already");
    }
  }

  void air() {
    const Air& a = c_.air;
    const Numerics& n = c_.numerics;
    if (n.lattice_speed > largest_lattice_speed)
      say("numerics.lattice_speed", "beyond " + format_quantity(largest_lattice_speed, unit::number) +
                                        " no scheme here is stable; 0.05 to 0.15 is usual");
    if (a.viscosity == 0.0 && c_.carriers && c_.carriers->drag != Drag::none)
      say("air.viscosity", "is 0, but the drag of carriers needs one; give a viscosity or carriers.drag = \"none\"");
    if (n.hrr_sigma > 1.0) say("numerics.hrr_sigma", "is a share, at most 1; 0.98 is usual and 1 is rr3");
    if (n.smagorinsky_constant > 1.0) say("numerics.smagorinsky_constant", "must be below 1; 0.1 to 0.17 is usual");
    const bool amplitude = a.initial_velocity.norm() > 0.0 || n.reference_speed;
    if ((a.initial == InitialField::taylor_green || a.initial == InitialField::shear_layer) && !amplitude)
      say("air.initial", "needs an amplitude: give air.initial_velocity or numerics.reference_speed");
    const bool moving = amplitude || std::any_of(a.boundaries.begin(), a.boundaries.end(), [](const Boundary& b) {
                          return b.flow.index() != 0 || b.profile == Profile::file;
                        });
    const auto* force = std::get_if<Vec3>(&a.body_force);
    const bool driven = force == nullptr || force->norm() > 0.0 || a.initial == InitialField::file ||
                        std::any_of(a.boundaries.begin(), a.boundaries.end(), [&](const Boundary& b) {
                          return b.type == BoundaryType::pressure_outlet && b.pressure != 0.0;
                        });
    if (a.model == AirModel::lbm && !moving && !driven)
      say("numerics.reference_speed", "nothing in the case says how fast the air will be (no inlet): give a speed");
    if (a.model != AirModel::lbm && !c_.carriers && !c_.fines)
      say("air.model", "without moving air, carriers or fines there is nothing to simulate");
    if (a.model == AirModel::frozen && c_.fines && !n.dx && !n.cells)
      say("numerics.dx", "fines travel from cell to cell: give the cell size 'dx', in frozen air too");
    if (a.model == AirModel::none && c_.fines && !c_.carriers)
      say("air.model", "fines travel in air: give model \"lbm\" or \"frozen\"");
  }

  void adhesion(const std::string& key, const Adhesion& a) {
    if (a.surface_energy <= 0.0 || a.hamaker <= 0.0) return;
    const double expected = a.hamaker / (24.0 * std::numbers::pi * a.cutoff_gap * a.cutoff_gap);
    if (std::abs(expected / a.surface_energy - 1.0) > 0.05)
      say(key + ".hamaker", "H = " + format_quantity(a.hamaker, unit::energy) +
                                " and d0 = " + format_quantity(a.cutoff_gap, unit::length) +
                                " give gamma = H/(24 pi d0^2) = " + format_quantity(expected, unit::surface_energy) +
                                ", not " + format_quantity(a.surface_energy, unit::surface_energy) +
                                " (5 % allowed); drop one");
  }

  void elasticity(const std::string& key, const Contact& contact, const Adhesion& adhesion) {
    if (contact.model == ContactModel::hertz || adhesion.model == AdhesionModel::jkr) {
      if (contact.restitution < 0.01)
        say(key + ".contact.restitution", "a Hertz contact can return 0.01 at least; give a value from 0.01 to 1");
    } else if (contact.restitution <= 0.0) {
      say(key + ".contact.restitution", "must be above 0; for a nearly dead impact give 0.01");
    }
    if (adhesion.model == AdhesionModel::jkr && !(contact.youngs_modulus > 0.0))
      say(key + ".contact.youngs_modulus",
          "JKR adhesion follows the true elastic curve: give youngs_modulus and poisson in [" + key + ".contact]");
  }

  void carriers() {
    if (!c_.carriers) return;
    const Carriers& c = *c_.carriers;
    if (c.parcel > 0 && c.count % c.parcel != 0)
      say("carriers.count",
          std::to_string(c.count) + " is no multiple of carriers.parcel = " + std::to_string(c.parcel));
    if (c.fill)
      if (const auto* patch = std::get_if<std::string>(&c.fill->at)) known_patch("carriers.fill.at", *patch);
    adhesion("carriers.adhesion", c.adhesion);
    // What the walls take over from the carriers is reported there.
    if (c.wall_adhesion.hamaker != c.adhesion.hamaker || c.wall_adhesion.surface_energy != c.adhesion.surface_energy)
      adhesion("carriers.walls.adhesion", c.wall_adhesion);
    elasticity("carriers", c.contact, c.adhesion);
    if (!findings_.broken("carriers.contact.restitution"))
      elasticity("carriers.walls", c.wall_contact, c.wall_adhesion);
    const std::string too_deep = "must be at most 0.2 of the diameter";
    if (c.contact.max_overlap > 0.2) say("carriers.contact.max_overlap", too_deep);
    if (c.wall_contact.max_overlap > 0.2 && c.wall_contact.max_overlap != c.contact.max_overlap)
      say("carriers.walls.contact.max_overlap", too_deep);
    if (c_.fines && !c_.fines->micromodels.empty() && c.fines_each == 0.0)
      say("carriers.fines_each", "[fines] names micro-models, but the carriers carry no fines: give fines_each");
    if (c_.fines && c_.fines->micromodels.empty() && c.fines_each > 0.0)
      say("fines.micromodels", "the carriers carry fines, but nothing says how they come off: give 'micromodels'");
  }

  void fines() {
    if (!c_.fines) return;
    unique_names("fines.scalar", c_.fines->scalars);
    std::vector<std::string> names;
    std::map<std::string, std::string> stored;  // by the name in stats.h5, where '/' would be a group
    for (std::size_t i = 0; i < c_.fines->scalars.size(); ++i) {
      const std::string& name = c_.fines->scalars[i].name;
      names.push_back(name);
      std::string there = name;
      std::replace(there.begin(), there.end(), '/', '_');
      const auto [first, fresh] = stored.emplace(there, name);
      if (!fresh && first->second != name)
        say(indexed("fines.scalar", i) + ".name",
            "'" + first->second + "' and '" + name + "' are both '" + there + "' in stats.h5; rename one of them");
    }
    for (std::size_t i = 0; i < c_.fines->boundaries.size(); ++i) {
      const ScalarBoundary& b = c_.fines->boundaries[i];
      known_patch(indexed("fines.boundary", i) + ".patch", b.patch);
      if (std::find(names.begin(), names.end(), b.scalar) == names.end())
        say(indexed("fines.boundary", i) + ".scalar",
            "there is no scalar '" + b.scalar + "'; there are " + join(names));
      for (std::size_t j = 0; j < i; ++j)
        if (c_.fines->boundaries[j].patch == b.patch && c_.fines->boundaries[j].scalar == b.scalar)
          say(indexed("fines.boundary", i) + ".patch",
              "'" + b.patch + "' holds a value for '" + b.scalar + "' already; give one for each");
    }
  }

  void outputs() {
    const Output& o = c_.output;
    unique_names("output.probe", o.probes);
    unique_names("output.line", o.lines);
    unique_names("output.plane", o.planes);
    for (const std::string& patch : o.forces)
      if (patch != "wall") known_patch("output.force", patch);
    for (std::size_t i = 0; i < o.fields.size(); ++i)
      if (o.fields[i].fines && !c_.fines)
        say(indexed("output.fields", i) + ".what", "there are no fines: the case has no [fines]");
    if (o.pressure_window && (*o.pressure_window)[0] >= c_.stop.time)
      say("output.pressure_window", "begins after stop.time = " + format_quantity(c_.stop.time, unit::time));
    constexpr double most_files = 1e6;
    for (std::size_t i = 0; i < o.fields.size(); ++i)
      if (c_.stop.time / o.fields[i].every > most_files)
        say(indexed("output.fields", i) + ".every",
            "more than a million files until stop.time; give a longer interval");
    if (c_.stop.time / o.carriers > most_files)
      say("output.carriers", "more than a million files until stop.time; give a longer interval");
    if (c_.stop.time / o.statistics > 1e7)
      say("output.statistics", "more than ten million rows until stop.time; give a longer interval");
  }

  const Case& c_;
  Findings& findings_;
  std::vector<std::string> patches_;
  bool patches_known_ = false;
};

}  // namespace

void check_consistency(const Case& c, Findings& findings) { Checks(c, findings).all(); }

}  // namespace puffin::cases::format
