#pragma once
// How the air is distributed over an inlet.

#include <functional>

#include "cases/inlet.hpp"

namespace puffin::cases {

/// A velocity distribution over a patch.
struct InletProfile {
  /// Velocity at a point over the section-mean speed; its mean normal component over the patch is 1, into the domain.
  std::function<Vec3(const Vec3&)> shape;
  /// Section-mean speed of the given values [m/s]; set for a profile from a file alone.
  double mean = 0.0;
};

/// The profile of a velocity inlet on one opening. Every shape is scaled by its integral over the patch's own
/// triangles.
///   plug       1
///   duct       exact laminar flow in the rectangle of the patch (White, Viscous Fluid Flow, eq. 3-48):
///              1 - (y/a)^2 - (32/pi^3) sum_{n odd} (-1)^((n-1)/2)/n^3 cosh(n pi z/2a)/cosh(n pi b/2a) cos(n pi y/2a),
///              a <= b the half sides; a side without a wall (periodic, slip) is none, so one with walls on one side
///              alone is half a channel with its greatest speed opposite, and without any uniform
///   parabolic  1 - (y/a)^2 between the walls of the patch, uniform in the other direction; with walls on all sides
///              across the shorter side (of a square: nearer to z, then to y)
///   pipe       1 - (r/R)^2, R the largest distance of the patch's border from its centroid
///   { file }   the velocities of the file between its points (point_field.hpp), laid onto the patch along its normal
/// A velocity vector in the case turns the shapes but the file's into its direction.
/// Throws GeometryError if the patch has not the form that the profile needs (rectangle: 98 % of its smallest
/// rectangle; pipe: 90 % of its circle), std::invalid_argument for a file without net inflow.
InletProfile profile_of(const Boundary& b, const Surface& surface, const Opening& opening);
/// That of all openings of an inlet; at a point that of the nearest.
InletProfile profile_of(const Boundary& b, const Surface& surface, const Inlet& inlet);

/// Gives inlets that have a profile from a file and no flow the mean speed of the file.
void complete_file_profiles(const Surface& surface, Case& c);

/// Laminar flow between walls at y = +-a and z = +-b, over its value in the middle of plates 2a apart; a <= b.
double duct_series(double y, double z, double a, double b);

}  // namespace puffin::cases
