#pragma once
// The plan view of a duct with bends: legs along a centre line, each with its width, corners sharp or rounded.

#include <Eigen/Core>
#include <vector>

namespace puffin::cases::generators {

using Vec2 = Eigen::Vector2d;

struct Leg {
  double length = 0.0;  // [m] along the centre line, between the crossings of the centre lines of the legs
  double width = 0.0;   // [m]
  double turn = 0.0;    // [rad] to the next leg, > 0 to the left; unused for the last leg
};

/// Both sides as polylines from start to end. The first leg runs along +x from the origin.
struct Outline {
  std::vector<Vec2> left, right;
  std::vector<double> straight;  // per leg: the shorter of its two straight sides [m]; < 0: its bends do not fit
  Vec2 end = Vec2::Zero();       // end of the centre line

  /// Enclosed area (shoelace formula) [m^2].
  double area() const;
  /// The closed polygon, counter-clockwise: right side forward, left side back.
  std::vector<Vec2> polygon() const;
};

/// inner_radius [m]: rounds the inner side of every corner; the outer side gets the inner radius plus the narrower of
/// the two legs' widths, so a bend between equal legs is concentric. 0: mitres.
/// Arcs are chains of chords with their ends on the arc: at most 6 degrees and `facet_size` each.
/// Valid: turns of less than 180 degrees; see `straight` for what does not fit.
Outline outline(const std::vector<Leg>& legs, double inner_radius, double facet_size);

/// Throws std::length_error beyond a million corners: no facet size that fits a surface asks for them.
void refuse_too_many_corners(double corners);

/// Chords into which an arc is divided.
int chords(double angle, double radius, double facet_size);

}  // namespace puffin::cases::generators
