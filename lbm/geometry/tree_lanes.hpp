#pragma once
// How a TriangleTree lies in memory: eight boxes of a node, and eight triangles of a leaf, side by side. Plain arrays,
// for code that is compiled once for each instruction set.

#include <cstdint>

namespace puffin::lbm::geometry {

constexpr int lanes = 8;

/// Up to eight children. Boxes are relative to the tree's centre, in single precision, widened so that rounding never
/// loses a triangle; an absent child has an empty box. child >= 0: node; child < 0: leaf ~child, of count triangles;
/// absent: count 0.
struct TreeNode {
  float low[3][lanes], high[3][lanes];
  std::int32_t child[lanes], count[lanes];
};

/// The triangles of a leaf, each in a frame of its own: corner a at the origin, b at (b, 0), c at (c0, c1 >= 0) in the
/// plane of x and y; z is the normal. Rounded to single precision: good for bounds, not for answers.
struct LeafTriangles {
  float corner[3][lanes];  // a, relative to the tree's centre
  float x[3][lanes], y[3][lanes], z[3][lanes];
  float b[lanes], c[2][lanes];
  float inverse_bc[lanes], inverse_ca[lanes];  // 1 / squared length of the edge, 0 for an edge without length
};

}  // namespace puffin::lbm::geometry
