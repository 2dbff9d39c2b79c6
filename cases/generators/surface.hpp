#pragma once
// Collects the planar faces of a solid and closes them to one conforming triangle surface.

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::cases::generators {

using Loop = std::vector<lbm::geometry::Vec3>;

/// Faces may meet anywhere along their edges: corners of one face that lie on an edge of another are inserted there, so
/// a shape is described by its natural polygons and the triangles still conform.
class Surface {
 public:
  Surface() = default;
  /// `add` refuses more than `largest_surface` triangles of this size as soon as they are too many.
  explicit Surface(double facet_size) : facet_size_(facet_size) {}

  /// Fixes the order of the solids; one without faces does not appear in the result.
  void declare(std::vector<std::string> solids) { solids_ = std::move(solids); }

  /// Adds a planar face of the named solid: `outer` runs counter-clockwise seen from outside the fluid (its Newell
  /// normal points out of the fluid); the holes lie inside it, in any direction. Throws std::length_error beyond
  /// `largest_surface`.
  void add(std::string_view solid, Loop outer, std::vector<Loop> holes = {});

  /// The solids that have faces, in order.
  std::vector<std::string> solids() const;

  /// The closed surface, no edge longer than `facet_size` [m]. The faces keep their shape: subdivision adds corners on
  /// them and swaps diagonals inside them, so the enclosed volume does not depend on facet_size.
  /// Throws std::logic_error if the faces do not close, std::length_error if facet_size asks for more than
  /// `largest_surface` triangles.
  lbm::geometry::TriangleMesh close(double facet_size) const;

  /// Triangles that `facet_size` would lead to, roughly: equilateral ones of three quarters of that edge.
  double expected_triangles(double facet_size) const;

  static constexpr double largest_surface = 4e6;

 private:
  struct Face {
    int solid = 0;
    std::vector<Loop> loops;  // the outer one first
  };
  static double expected_triangles(const Face& face, double facet_size);

  std::vector<Face> faces_;
  std::vector<std::string> solids_;
  double facet_size_ = std::numeric_limits<double>::infinity(), expected_ = 0.0;
};

/// Volume enclosed by a closed surface: sum of a . (b x c) / 6 over its triangles. > 0 if area vectors point outwards.
double enclosed_volume(const lbm::geometry::TriangleMesh& mesh);

}  // namespace puffin::cases::generators
