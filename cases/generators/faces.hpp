#pragma once
// Faces that several shapes are made of: tubes of rectangular section along x, sudden changes of section, rings.

#include <array>
#include <string_view>

#include "cases/generators/surface.hpp"

namespace puffin::cases::generators {

using lbm::geometry::Vec3;

/// A rectangular section across x.
struct Section {
  double y0 = 0.0, y1 = 0.0, z0 = 0.0, z1 = 0.0;  // [m]
  Vec3 centre(double x) const { return {x, 0.5 * (y0 + y1), 0.5 * (z0 + z1)}; }
};

/// Solids of the four sides of a tube.
struct SideNames {
  std::string_view y_min, y_max, z_min, z_max;
};

/// Parallelogram corner, corner + u, corner + u + v, corner + v; outside is along u x v.
void add_parallelogram(std::string_view solid, const Vec3& corner, const Vec3& u, const Vec3& v, Surface& surface);

/// The four sides of a tube of section `section` from x0 to x1.
void add_sides(const SideNames& names, double x0, double x1, const Section& section, Surface& surface);

/// The flat end of a tube at x; outside is towards -x or +x.
void add_end(std::string_view solid, double x, const Section& section, bool outside_at_plus_x, Surface& surface);

/// The wall where the section changes suddenly from `before` to `after` at x.
void add_section_change(std::string_view solid, double x, const Section& before, const Section& after,
                        Surface& surface);

/// Corners of a regular polygon inscribed in the circle centre + radius (cos a e1 + sin a e2), a = 2 pi k / corners.
Loop ring(const Vec3& centre, const Vec3& e1, const Vec3& e2, double radius, int corners);

/// Plane quadrilaterals between two rings with equal numbers of corners, at most three chords long each. With e1 x e2
/// pointing from the first to the second, outside is away from the axis.
void add_band(std::string_view solid, const Loop& from, const Loop& to, Surface& surface);

/// The same loop, run the other way round.
Loop reversed(const Loop& loop);

/// Corners of an inscribed polygon: chords no longer than facet_size, at least `at_least`.
int ring_corners(double radius, double facet_size, int at_least = 64);

}  // namespace puffin::cases::generators
