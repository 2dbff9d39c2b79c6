#pragma once
// Is a triangle surface fit to bound a volume? What is wrong, where, and what can be done.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// A surface that must be refused (exit code 4 of the program). The message holds the place and a remedy.
class GeometryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One kind of fault. Kinds: "hole" (edges with one triangle), "non-manifold edge" (more than two), "duplicate facet",
/// "degenerate facet" (no area), "inconsistent orientation" (edges that two triangles run through in the same
/// direction), "inside out" (negative volume), "self-intersection", "disconnected part", "nested shell",
/// "suspicious size", "coarse coordinates" (so far from the origin that single precision shows).
struct Defect {
  std::string kind{};
  std::size_t count = 0;
  std::vector<Vec3> where{};  // [m] one place each, at most Defect::places
  std::string message{};      // one sentence: the first place, and what to do
  bool fatal = false;         // the surface does not bound a volume as it is; the other kinds are worth a look

  static constexpr std::size_t places = 1000;
};

/// Every fault found, fatal ones first; empty for a clean surface. The mesh must be welded (read_stl does it).
/// Self-intersections are searched only if asked: that costs a tree and about as long as reading the file.
std::vector<Defect> check_surface(const TriangleMesh& mesh, bool self_intersections = true);

/// Throws GeometryError naming the first bad edge with its two ends [m] and a remedy, unless every edge has triangles
/// running through it equally often in both directions and the enclosed volume is positive.
void require_closed(const TriangleMesh& mesh);

/// "(x, y, z) m" with nine digits, for messages.
std::string place_text(const Vec3& p);

/// Enclosed volume [m^3], positive if the triangles point out of it: V = 1/6 sum a . (b x c). Meaningful if closed.
double enclosed_volume(const TriangleMesh& mesh);

/// Sum of the triangles' areas [m^2].
double surface_area(const TriangleMesh& mesh);

}  // namespace puffin::lbm::geometry
