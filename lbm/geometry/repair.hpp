#pragma once
// Mend what can be mended without guessing, and say what was done.

#include <cstddef>
#include <string>
#include <vector>

#include "lbm/geometry/t_junctions.hpp"
#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// Corners nearer than this fraction of the bounding box diagonal become one: clearly more than on_edge_fraction, so
/// that of two corners that were meant to be one none is taken for a corner on an edge that ends in the other.
constexpr double mend_fraction = 5.0 * on_edge_fraction;

struct RepairOptions {
  double weld_tolerance = 0.0;  // [m]; 0: mend_fraction of the bounding box diagonal
  double largest_hole = 0.0;    // [m] holes with a longer rim stay open; 0: a twentieth of the bounding box
                                // diagonal, and every hole of three edges: one missing facet
};

/// One thing that was done.
struct Repair {
  std::string what{};  // "welded vertices", "removed degenerate facets", "removed duplicate facets",
                       // "split facets", "turned facets", "filled holes"
  std::size_t count = 0;
  std::vector<Vec3> where{};  // [m] one place each, at most Defect::places
  std::string message{};
};

/// Welds, removes degenerate and duplicate facets, splits facets where corners of others lie on their edges, turns
/// facets until neighbours agree and the volume of each part that is not inside another is positive, and closes small
/// holes with facets in the solid "filled-hole". Returns what was done, in order; what it cannot mend is left for
/// check_surface to name.
std::vector<Repair> repair(TriangleMesh& mesh, const RepairOptions& options = {});

/// Of facets that stand several times with one sense in one solid all but the first go: nothing is guessed, the surface
/// is the same. Those that also stand turned round are left. count is 0 where there are none.
Repair remove_copies(TriangleMesh& mesh);

}  // namespace puffin::lbm::geometry
