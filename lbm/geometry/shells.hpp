#pragma once
// The connected parts of a surface.

#include <vector>

#include "lbm/geometry/adjacency.hpp"
#include "lbm/geometry/surface_check.hpp"

namespace puffin::lbm::geometry {

struct Shells {
  int count = 0;
  std::vector<int> of_triangle;  // per triangle; numbered by first triangle
};

/// Parts connected through shared edges. Degenerate triangles (equal corners) belong to shell 0.
Shells find_shells(const TriangleMesh& mesh, const Adjacency& adjacency);

/// Enclosed volume of each shell [m^3], see enclosed_volume.
std::vector<double> shell_volumes(const TriangleMesh& mesh, const Shells& shells);

/// For each shell the number of other shells around it: whose winding number exceeds 1/2 at that one of its first
/// corner and the centres of 32 of its triangles which lies farthest from them, so that shells that touch are told
/// apart.
std::vector<int> nesting(const TriangleMesh& mesh, const Shells& shells);

/// The defects "inside out", "disconnected part", "nested shell". `closed`: volumes mean something; parts of a surface
/// that is not are not asked whether they lie inside each other.
std::vector<Defect> check_shells(const TriangleMesh& mesh, const Adjacency& adjacency, bool closed);

}  // namespace puffin::lbm::geometry
