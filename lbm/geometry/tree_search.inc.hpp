// The body of one tree-search unit; included once by each tree_search_<isa>.cpp, which sets PUFFIN_ISA. Only plain
// arrays are touched and nothing is instantiated, so code for a newer processor cannot leak into the program.

#include <immintrin.h>

#include <cstddef>

#include "lbm/geometry/tree_search.hpp"

namespace puffin::lbm::geometry::PUFFIN_ISA {
namespace {

using Pack = float __attribute__((vector_size(4 * lanes)));

[[gnu::always_inline]] inline Pack load(const float* p) {
  Pack v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
[[gnu::always_inline]] inline Pack all_of(float x) { return Pack{x, x, x, x, x, x, x, x}; }
[[gnu::always_inline]] inline Pack smaller(const Pack& a, const Pack& b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Pack larger(const Pack& a, const Pack& b) { return a > b ? a : b; }

/// Bit c is set where a[c] <= b.
[[gnu::always_inline]] inline unsigned within(const Pack& a, float b) {
#ifdef __AVX__
  __m256 v;
  __builtin_memcpy(&v, &a, sizeof v);
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(v, _mm256_set1_ps(b), _CMP_LE_OQ)));
#else
  __m128 v[2];
  __builtin_memcpy(v, &a, sizeof v);
  const __m128 w = _mm_set1_ps(b);
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(v[0], w)) | _mm_movemask_ps(_mm_cmple_ps(v[1], w))
                                                                            << lanes / 2);
#endif
}

/// Squared distances to the boxes of a node.
[[gnu::always_inline]] inline Pack to_boxes(const TreeNode& node, const Pack (&point)[3]) {
  Pack sum{};
  for (int d = 0; d < 3; ++d) {
    const Pack out = larger(larger(load(node.low[d]) - point[d], point[d] - load(node.high[d])), Pack{});
    sum += out * out;
  }
  return sum;
}

/// Squared distances to the triangles of a leaf. Where the foot of the perpendicular lies in the triangle, or within
/// the tolerance of it, that to its plane, which is never the larger; else that to the nearest edge.
[[gnu::always_inline]] inline Pack to_triangles(const LeafTriangles& t, const Pack (&point)[3], float tolerance) {
  const Pack r0 = point[0] - load(t.corner[0]), r1 = point[1] - load(t.corner[1]), r2 = point[2] - load(t.corner[2]);
  const auto along = [&](const float(&axis)[3][lanes]) {
    return r0 * load(axis[0]) + r1 * load(axis[1]) + r2 * load(axis[2]);
  };
  const Pack u = along(t.x), v = along(t.y), h = along(t.z);
  const Pack b = load(t.b), c0 = load(t.c[0]), c1 = load(t.c[1]), one = all_of(1.0F), none{};

  const Pack du = u - smaller(larger(u, none), b);
  const Pack ab = du * du + v * v;

  const Pack e0 = c0 - b, w0 = u - b;
  const Pack s = smaller(larger((w0 * e0 + v * c1) * load(t.inverse_bc), none), one);
  const Pack f0 = w0 - s * e0, f1 = v - s * c1;
  const Pack bc = f0 * f0 + f1 * f1;

  const Pack q = smaller(larger((u * c0 + v * c1) * load(t.inverse_ca), none), one);
  const Pack g0 = u - q * c0, g1 = v - q * c1;
  const Pack ca = g0 * g0 + g1 * g1;

  // On the inner side of an edge, or less than the tolerance beyond it: |e0| + |c1| is at least the edge's length.
  const Pack slack = all_of(-tolerance);
  const auto size = [&](const Pack& p) { return larger(p, -p); };
  const Pack beyond_ab = v - slack;
  const Pack beyond_bc = (e0 * v - c1 * w0) - slack * (size(e0) + c1);
  const Pack beyond_ca = (c1 * u - c0 * v) - slack * (size(c0) + c1);
  const Pack inner = smaller(beyond_ab, smaller(beyond_bc, beyond_ca));  // >= 0: inside
  const Pack edges = smaller(ab, smaller(bc, ca));
  return h * h + (inner >= none ? none : edges);
}

/// Asks about the triangles of a leaf, the nearest first.
[[gnu::always_inline]] inline void ask_leaf(const TreeSearch& search, int leaf, int count, const Pack (&point)[3],
                                            float& limit) {
  const Pack distance = to_triangles(search.leaves[leaf], point, search.tolerance);
  unsigned left = within(distance, limit) & ((1U << count) - 1U);
  float d[lanes];
  __builtin_memcpy(d, &distance, sizeof d);
  while (left != 0) {
    int nearest = __builtin_ctz(left);
    for (unsigned rest = left & (left - 1U); rest != 0; rest &= rest - 1U)
      if (d[__builtin_ctz(rest)] < d[nearest]) nearest = __builtin_ctz(rest);
    if (d[nearest] > limit) return;
    left &= ~(1U << nearest);
    limit = search.found(search.context, leaf * lanes + nearest, limit);
  }
}

// Room for the deepest tree the builder makes: at most 40 splits by area and 31 by halving, one a level at the least,
// seven siblings left behind a level.
constexpr int stack_size = 512;

struct Entry {
  std::int32_t child, count;
  float bound;  // of the squared distance
};

void nearest_first(const TreeSearch& search) {
  const Pack point[3] = {all_of(search.point[0]), all_of(search.point[1]), all_of(search.point[2])};
  float limit = search.limit;
  Entry stack[stack_size];
  int top = 0;
  stack[top++] = {0, 1, 0.0F};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.bound > limit) continue;
    if (entry.child < 0) {
      ask_leaf(search, ~entry.child, entry.count, point, limit);
      continue;
    }
    const TreeNode& node = search.nodes[entry.child];
    const Pack bound = to_boxes(node, point);
    float near[lanes];
    __builtin_memcpy(near, &bound, sizeof near);
    const int first = top;
    for (unsigned left = within(bound, limit); left != 0; left &= left - 1U) {
      const int c = __builtin_ctz(left);
      int at = top++;
      for (; at > first && stack[at - 1].bound < near[c]; --at) stack[at] = stack[at - 1];
      stack[at] = {node.child[c], node.count[c], near[c]};
    }
  }
}

/// Asks for the memory of a node or leaf that is looked at later.
[[gnu::always_inline]] inline void fetch(const TreeSearch& search, std::int32_t child) {
  const char* at = child >= 0 ? reinterpret_cast<const char*>(search.nodes + child)
                              : reinterpret_cast<const char*>(search.leaves + ~child);
  const std::size_t bytes = child >= 0 ? sizeof(TreeNode) : sizeof(LeafTriangles);
  for (std::size_t b = 0; b < bytes; b += 64) __builtin_prefetch(at + b);
}

void all(const TreeSearch& search) {
  const Pack point[3] = {all_of(search.point[0]), all_of(search.point[1]), all_of(search.point[2])};
  struct {
    std::int32_t child, count;
  } stack[stack_size];
  int top = 0;
  stack[top++] = {0, 1};
  while (top > 0) {
    const auto [child, count] = stack[--top];
    if (child >= 0) {
      const TreeNode& node = search.nodes[child];
      for (unsigned left = within(to_boxes(node, point), search.limit); left != 0; left &= left - 1U) {
        const int c = __builtin_ctz(left);
        fetch(search, node.child[c]);
        stack[top++] = {node.child[c], node.count[c]};
      }
      continue;
    }
    const Pack distance = to_triangles(search.leaves[~child], point, search.tolerance);
    unsigned hit = within(distance, search.limit) & ((1U << count) - 1U);
    for (; hit != 0; hit &= hit - 1U) search.found(search.context, ~child * lanes + __builtin_ctz(hit), search.limit);
  }
}

}  // namespace

TreeSearches tree_searches() { return {nearest_first, all}; }

}  // namespace puffin::lbm::geometry::PUFFIN_ISA
