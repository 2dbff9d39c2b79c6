#include "cases/check_boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "cases/derived.hpp"
#include "cases/inlet.hpp"
#include "cases/opening.hpp"
#include "cases/spelling.hpp"
#include "cases/units.hpp"
#include "lbm/geometry/surface_check.hpp"

namespace puffin::cases {

namespace {

std::string four_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

class Checks {
 public:
  Checks(const Case& c, const Surface& surface) : c_(c), surface_(surface) {
    for (const Vec3& v : surface.mesh.vertices) {
      low_ = low_.cwiseMin(v);
      high_ = high_.cwiseMax(v);
    }
  }

  std::vector<Problem> all() {
    for (std::size_t i = 0; i < c_.air.boundaries.size(); ++i) {
      const Boundary& b = c_.air.boundaries[i];
      const std::string key = "air.boundary[" + std::to_string(i) + "]";
      const bool known = need(key + ".patch", b.patch), partner = b.with.empty() || need(key + ".with", b.with);
      if (!known || !partner) continue;
      if (b.type == BoundaryType::periodic) periodic(key, b);
      if (b.type == BoundaryType::velocity_inlet) inlet(key, b);
      if (b.type == BoundaryType::slip) slip(key, b);
      if (b.type == BoundaryType::moving_wall) moving(key, b);
    }
    carriers();
    duration();
    if (c_.carriers && c_.carriers->fill)
      if (const auto* patch = std::get_if<std::string>(&c_.carriers->fill->at)) need("carriers.fill.at", *patch);
    for (const std::string& patch : c_.output.forces)
      if (patch != "wall") need("output.force", patch);
    if (c_.fines)
      for (std::size_t i = 0; i < c_.fines->boundaries.size(); ++i)
        held_value("fines.boundary[" + std::to_string(i) + "].patch", c_.fines->boundaries[i].patch);
    return std::move(problems_);
  }

 private:
  void say(const std::string& key, const std::string& text) {
    problems_.push_back(problem_at(c_, key, key + ": " + text));
  }

  void held_value(const std::string& key, const std::string& patch) {
    const auto& given = c_.air.boundaries;
    const bool wraps = std::any_of(given.begin(), given.end(), [&](const Boundary& b) {
      return b.type == BoundaryType::periodic && (b.patch == patch || b.with == patch);
    });
    if (need(key, patch) && wraps)
      say(key, "'" + patch + "' is periodic, so it has no face; a value can be held on walls and openings");
  }

  bool need(const std::string& key, const std::string& name) {
    const auto& patches = surface_.patches;
    if (name.empty()) return false;
    if (patches.find(name) >= 0) {
      if (surface_.area_of(name) > 0.0) return true;
      say(key, "the patch '" + name + "' has no surface left: every triangle of it bears another patch's name");
      return false;
    }
    const std::string near = nearest(name, patches.names);
    say(key, "there is no patch '" + name + "'; " +
                 (near.empty() ? "the patches are " + join(patches.names) : "did you mean '" + near + "'?"));
    return false;
  }

  struct Face {
    Vec3 normal = Vec3::Zero(), centroid = Vec3::Zero();
    double area = 0.0, flatness = 0.0;  // |sum of area vectors| / area
  };
  Face face_of(const std::string& name) const {
    Face face;
    const int patch = surface_.patches.find(name);
    for (int t = 0; t < static_cast<int>(surface_.mesh.triangles.size()); ++t) {
      if (surface_.patches.of_triangle[t] != patch) continue;
      const auto& mesh = surface_.mesh;
      face.area += mesh.area(t);
      face.normal += 0.5 * mesh.area_vector(t);
      face.centroid += mesh.area(t) / 3.0 * (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2));
    }
    face.flatness = face.normal.norm() / face.area;
    face.centroid /= face.area;
    if (face.flatness > 0.0) face.normal.normalize();
    return face;
  }

  void periodic(const std::string& key, const Boundary& b) {
    const Face one = face_of(b.patch), two = face_of(b.with);
    int axis = 0;
    one.normal.cwiseAbs().maxCoeff(&axis);
    const auto is_end = [&](const Face& f) {
      const double end = f.normal[axis] < 0.0 ? low_[axis] : high_[axis];
      return f.flatness > 1.0 - 1e-6 && std::abs(f.normal[axis]) > 1.0 - 1e-6 &&
             std::abs(f.centroid[axis] - end) < 1e-5 * (high_ - low_).norm();
    };
    for (const auto& [name, face] : {std::pair(b.patch, one), std::pair(b.with, two)})
      if (!is_end(face)) {
        say(key + ".with", "the patch '" + name + "' is not a flat end of the box along " + "xyz"[axis] +
                               "; periodic faces are the two ends of the geometry along an axis");
        return;
      }
    Vec3 shift = two.centroid - one.centroid;
    shift[axis] = 0.0;
    if (one.normal.dot(two.normal) > 0.0) {
      say(key + ".with", "'" + b.patch + "' and '" + b.with + "' lie on the same side; name the opposite one");
    } else if (std::abs(one.area - two.area) > 1e-5 * one.area || shift.norm() > 1e-5 * (high_ - low_).norm()) {
      say(key + ".with", "'" + b.patch + "' (" + format_quantity(one.area * 1e6, unit::number) + " mm^2) and '" +
                             b.with + "' (" + format_quantity(two.area * 1e6, unit::number) +
                             " mm^2) do not cover each other: what leaves through one must find the other");
    }
  }

  void inlet(const std::string& key, const Boundary& b) {
    const auto* v = std::get_if<Velocity>(&b.flow);
    const auto parts = inlet_parts(surface_, b);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const Vec3 inward = -parts[p].normal;
      if (inward.isZero()) say(key + ".patch", no_direction(part_name(b, parts, p)));
      if (v == nullptr || inward.isZero() || v->value.dot(inward) >= 1e-3 * v->value.norm()) continue;
      say(key + ".velocity", "the vector does not point into the fluid; the inward normal of " +
                                 (parts.size() == 1 ? "'" + b.patch + "'" : part_name(b, parts, p)) + " is [" +
                                 format_quantity(inward[0], unit::number) + ", " +
                                 format_quantity(inward[1], unit::number) + ", " +
                                 format_quantity(inward[2], unit::number) + "]" +
                                 (parts.size() == 1 ? "" : "; give each part a patch of its own, or a flow_rate"));
    }
  }

  /// Spheres of one size fill at most pi / sqrt(18) of any space (Kepler; Hales, Ann. Math. 162, 1065 (2005)).
  void carriers() {
    if (!c_.carriers || !c_.carriers->fill || surface_.volume <= 0.0) return;
    const double d = c_.carriers->diameter,
                 all = static_cast<double>(c_.carriers->count) * std::numbers::pi / 6.0 * d * d * d;
    if (!c_.carriers->sizes && all > std::numbers::pi / std::sqrt(18.0) * surface_.volume)
      say("carriers.count", "the carriers alone have " + format_quantity(all * 1e9, unit::number) +
                                " mm^3, the device " + format_quantity(surface_.volume * 1e9, unit::number) +
                                " mm^3; give fewer or smaller ones");
  }

  /// A run of which nobody will see the end, or that ends within a thousandth of its first step: a wrong unit. Or one
  /// whose time step, given in seconds, lets the air cross more of a cell than numerics.lattice_speed may.
  void duration() {
    constexpr double most_steps = 1e11, least_steps = 1e-3;  // 10^11: three years at 1,000 steps a second
    if (c_.air.model != AirModel::lbm || surface_.volume <= 0.0 || !problems_.empty()) return;
    const AreaOf area_of = inlet_areas(c_.air, surface_);
    const double speed = reference_speed(c_, area_of);
    if (!(speed > 0.0)) return;
    const LatticeNumbers n = lattice_numbers(c_, cell_size(c_.numerics, surface_.volume), speed, area_of);
    const std::string step = format_quantity(n.dt, unit::time), reference = format_quantity(speed, unit::velocity);
    if (!(n.steps <= most_steps))
      say("stop.time", "is " + four_digits(n.steps) + " steps of " + step +
                           " away, with dx = " + format_quantity(n.dx, unit::length) + " and air of " + reference +
                           "; at most 1e11 are possible: check the units of time, flow and dx");
    else if (n.steps < least_steps)
      say("stop.time", "comes within a thousandth of the first step, " + step + ", as the air reaches only " +
                           reference + " until then: check its unit, or give numerics.reference_speed");
    const double cells = speed * n.dt / n.dx;
    if (c_.numerics.time_step == TimeStepRule::given && cells > largest_lattice_speed)
      say("numerics.time_step", "lets air of " + reference + " cross " + four_digits(cells) + " cells a step; beyond " +
                                    four_digits(largest_lattice_speed) + " no scheme here is stable: take " +
                                    format_quantity(n.dt * 0.1 / cells, unit::time) + " (0.1 cells) or \"fixed\"");
  }

  /// Behind an immersed wall that moves air is dragged along; where another wall stands in its way it piles up and
  /// drives the air of the fluid: in a cavity of 20 cells to 2.9 times the speed of its lid.
  void moving(const std::string& key, const Boundary& b) {
    if (c_.numerics.wall != WallScheme::ibm || c_.air.model != AirModel::lbm) return;
    const int own = surface_.patches.find(b.patch);
    const auto stands = [&](int patch) {  // true of walls that do not move as this one does
      if (patch < 0 || patch == own) return false;
      const auto other = std::find_if(c_.air.boundaries.begin(), c_.air.boundaries.end(), [&](const Boundary& o) {
        return o.patch == surface_.patches.names[static_cast<std::size_t>(patch)] ||
               (o.type == BoundaryType::periodic && o.with == surface_.patches.names[static_cast<std::size_t>(patch)]);
      });
      return other == c_.air.boundaries.end() || other->type == BoundaryType::wall ||
             (other->type == BoundaryType::moving_wall && !(other->flow == b.flow));
    };
    const auto& mesh = surface_.mesh;
    const auto& of = surface_.patches.of_triangle;
    std::vector<char> corner(mesh.vertices.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (of[t] == own)
        for (const int v : mesh.triangles[t]) corner[static_cast<std::size_t>(v)] = 1;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!stands(of[t])) continue;
      const auto& tri = mesh.triangles[t];
      if (std::none_of(tri.begin(), tri.end(), [&](int v) { return corner[static_cast<std::size_t>(v)] != 0; }))
        continue;
      say(key + ".type", "'" + b.patch + "' moves and meets '" +
                             surface_.patches.names[static_cast<std::size_t>(of[t])] +
                             "', which does not move with it: immersed walls cannot do that; take numerics.wall = "
                             "\"bouzidi\" or \"psm\"");
      return;
    }
  }

  /// Reflection along the grid is exact only on planes of the grid: refuse the rest instead of adding friction.
  void slip(const std::string& key, const Boundary& b) {
    const int patch = surface_.patches.find(b.patch);
    for (int t = 0; t < static_cast<int>(surface_.mesh.triangles.size()); ++t) {
      if (surface_.patches.of_triangle[t] != patch) continue;
      const Vec3 n = surface_.mesh.area_vector(t).normalized();
      if (n.cwiseAbs().maxCoeff() > 1.0 - 1e-6) continue;
      say(key + ".type",
          "slip walls must lie along x, y or z; '" + b.patch + "' does not: turn the geometry, or make it a wall");
      return;
    }
  }

  const Case& c_;
  const Surface& surface_;
  Vec3 low_ = Vec3::Constant(1e300), high_ = Vec3::Constant(-1e300);
  std::vector<Problem> problems_;
};

}  // namespace

Problem problem_at(const Case& c, const std::string& key, const std::string& text) {
  for (std::string k = key;;) {
    if (const auto found = c.places.of.find(k); found != c.places.of.end())
      return {found->second.file, found->second.line, found->second.column, key, text};
    const std::size_t cut = k.find_last_of(".[");
    if (cut == std::string::npos) return {c.name, 0, 0, key, text};
    k.resize(cut);
  }
}

std::vector<Problem> boundary_problems(const Case& c, const Surface& surface) { return Checks(c, surface).all(); }

std::vector<std::string> boundary_warnings(const Case& c, const Surface& surface) {
  std::vector<std::string> warnings;
  for (const Boundary& b : c.air.boundaries) {
    if (b.type != BoundaryType::moving_wall) continue;
    const Vec3& velocity = std::get<Velocity>(b.flow).value;
    const int patch = surface.patches.find(b.patch);
    double fastest = 0.01 * velocity.norm();  // what facets of a wall that slides along itself may have
    int at = -1;
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
      if (surface.patches.of_triangle[t] != patch) continue;
      const double across = std::abs(velocity.dot(surface.mesh.area_vector(static_cast<int>(t)).normalized()));
      if (across > fastest) fastest = across, at = static_cast<int>(t);
    }
    if (at >= 0)
      warnings.push_back("the moving wall '" + b.patch + "' has " + format_quantity(fastest, unit::velocity) +
                         " along its normal at " + lbm::geometry::place_text(surface.mesh.corner(at, 0)) +
                         ": it gives air this speed but stays where it is, so the flow is that of one moment; for "
                         "air that comes in, make it a velocity-inlet");
  }
  return warnings;
}

}  // namespace puffin::cases
