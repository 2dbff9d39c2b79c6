#pragma once
// Where a patch lies and what bounds it: plane, rectangle, circle, and which of its sides are walls.

#include <array>
#include <functional>

#include "cases/surface.hpp"
#include "lbm/geometry/patch_parts.hpp"

namespace puffin::cases {

/// A flat patch in its own frame, found from its triangles alone: any position, any orientation. Or one part of a patch
/// whose parts do not touch.
struct Opening {
  std::string name;              // for messages: "the patch 'inlet'", "the part of 'inlet' around [x, y, z] mm"
  std::vector<int> triangles;    // of the surface, rising
  Vec3 normal = Vec3::Zero();    // mean, out of the fluid
  Vec3 centroid = Vec3::Zero();  // of the area [m]
  double area = 0.0;             // [m^2] of a patch that is not plane: of its projection along the normal
  double radius = 0.0;           // [m] largest distance of a corner from the centroid
  // The smallest rectangle around the patch. Of equal sides the second is the one nearer to z, then to y.
  Vec3 centre = Vec3::Zero();                 // [m]
  std::array<Vec3, 2> along;                  // unit vectors along the longer and the shorter side
  std::array<double, 2> half{};               // half lengths [m]
  std::array<std::array<bool, 2>, 2> wall{};  // [side pair][low, high end of `along`]: the air sticks there

  /// Place of a point in the rectangle [m].
  std::array<double, 2> coordinates(const Vec3& x) const {
    return {(x - centre).dot(along[0]), (x - centre).dot(along[1])};
  }
};

/// Describes a patch as a whole. A side of the rectangle is a wall if more than half of the patch's border beside it
/// belongs to walls (moving ones too); beside periodic faces, slip walls and other openings the air does not stick.
/// Throws GeometryError if the patch has no area or its triangles look against each other.
Opening opening_of(const Case& c, const Surface& surface, int patch);
/// The same of one part of a patch.
Opening opening_of(const Case& c, const Surface& surface, const lbm::geometry::PatchPart& part,
                   const std::string& name);

/// What is said of an opening whose triangles look against each other.
std::string no_direction(const std::string& name);

/// Integral over the opening of a function of the place [its unit times m^2]: quadrature of degree 5 on its triangles,
/// divided until no edge exceeds an eighth of the shorter half side (a function that is smooth on that scale is
/// integrated to 1e-8).
double integral_over(const Surface& surface, const Opening& opening, double finest,
                     const std::function<double(const Vec3&)>& f);

/// The boundary that the case names for a patch, or nullptr: a wall.
const Boundary* boundary_of(const Air& air, const std::string& patch);
/// Whether air rubs on the patch: a wall that does not move, by name or because the case says nothing else of it.
bool is_resting_wall(const Air& air, const std::string& patch);
/// Whether the patch is one of a periodic pair.
bool is_periodic(const Air& air, const std::string& patch);

}  // namespace puffin::cases
