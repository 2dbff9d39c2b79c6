#pragma once
// Which triangles of a TriangleTree may lie within a distance of a point. Compiled once for each instruction set; used
// by TriangleTree only.

#include "lbm/geometry/tree_lanes.hpp"

namespace puffin::lbm::geometry {

/// The question and where it is asked.
struct TreeSearch {
  const TreeNode* nodes = nullptr;
  const LeafTriangles* leaves = nullptr;
  float point[3] = {0, 0, 0};  // relative to the tree's centre
  float tolerance = 0;         // distances in single precision are wrong by less
  /// Squared distance beyond which nothing matters, tolerance included.
  float limit = 0;
  /// Called with leaf * lanes + lane for every triangle that may lie within the limit; answers with the new limit.
  float (*found)(void* context, int slot, float limit) = nullptr;
  void* context = nullptr;
};

/// Nearest boxes and triangles first, so that a limit that shrinks with each answer ends the search soon. Whatever the
/// rounding of an instruction set, every triangle within the limit is found; those beyond it by less than the tolerance
/// may be.
using SearchTree = void (*)(const TreeSearch&);
struct TreeSearches {
  SearchTree nearest_first, all;  // `all`: in the order of the tree, for a limit that stays
};

/// The fastest that this processor has (PUFFIN_ISA may name a lesser one).
const TreeSearches& tree_searches();

namespace baseline {
TreeSearches tree_searches();
}
namespace avx2 {
TreeSearches tree_searches();
}

}  // namespace puffin::lbm::geometry
