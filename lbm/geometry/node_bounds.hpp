#pragma once
// Distances from a point to the four boxes of a tree's node, side by side. Used by TriangleTree only.

#include <array>
#include <cstring>

namespace puffin::lbm::geometry {

using Lanes = float __attribute__((vector_size(16)));  // one number for each of the four children

inline Lanes lanes_of(const std::array<float, 4>& a) {
  Lanes v;
  std::memcpy(&v, a.data(), sizeof v);
  return v;
}

/// Squared distances to the boxes; infinity for a child that is not there. `point`: each coordinate four times.
template <class Node>
Lanes squared_distances(const Node& node, const std::array<Lanes, 3>& point) {
  Lanes sum{};
  for (int d = 0; d < 3; ++d) {
    const Lanes below = lanes_of(node.low[d]) - point[d], above = point[d] - lanes_of(node.high[d]);
    Lanes out = below > above ? below : above;
    out = out > Lanes{} ? out : Lanes{};
    sum += out * out;
  }
  return sum;
}

inline std::array<Lanes, 3> four_times(float x, float y, float z) {
  return {Lanes{x, x, x, x}, Lanes{y, y, y, y}, Lanes{z, z, z, z}};
}

}  // namespace puffin::lbm::geometry
