#include "lbm/geometry/solid_fraction.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lbm/geometry/clipped_polygon.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/union_fraction.hpp"

namespace puffin::lbm::geometry {

namespace {

constexpr double negligible = 1e-9;  // of a cell

// What the part of one triangle in one cell adds.
struct Piece {
  std::int64_t row = 0;  // j + size[1] k
  std::int32_t i = 0;    // -1: before the box
  bool opening = false;
  double fluid = 0.0;   // to the integral of w over the cell, in cells
  double step = 0.0;    // to w of the cells behind it along the row, in cell faces
  double beyond = 0.0;  // swept outwards from an opening, in cells
};

class PieceCutter {
 public:
  PieceCutter(const TriangleMesh& mesh, const Voxels& box, const std::vector<char>& openings)
      : mesh_(mesh), box_(box), openings_(openings), low_(box.origin - Vec3::Constant(0.5 * box.dx)) {}

  void cut(int t, std::vector<Piece>& out) const {
    const ClippedPolygon whole(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2));
    const bool opening = !openings_.empty() && openings_[t];
    const auto ks = cells(whole, 2);
    for (int k = std::max(ks[0], 0); k <= std::min(ks[1], box_.size[2] - 1); ++k) {
      const ClippedPolygon layer = ks[0] == ks[1] ? whole : whole.slab(2, plane(2, k), plane(2, k + 1));
      if (layer.empty()) continue;
      const auto js = cells(layer, 1);
      for (int j = std::max(js[0], 0); j <= std::min(js[1], box_.size[1] - 1); ++j) {
        const ClippedPolygon column = js[0] == js[1] ? layer : layer.slab(1, plane(1, j), plane(1, j + 1));
        if (!column.empty()) cut_column(column, t, opening, j, k, out);
      }
    }
  }

 private:
  double plane(int axis, int i) const { return low_[axis] + box_.dx * i; }

  // First and last cell along an axis that a polygon reaches.
  std::array<int, 2> cells(const ClippedPolygon& p, int axis) const {
    const auto [low, high] = p.range(axis);
    const auto cell = [&](double x) {
      return static_cast<int>(std::clamp(std::floor((x - low_[axis]) / box_.dx), -1.0, box_.size[axis] + 0.0));
    };
    return {cell(low), cell(high)};
  }

  void cut_column(const ClippedPolygon& column, int t, bool opening, int j, int k, std::vector<Piece>& out) const {
    const double dx = box_.dx;
    const auto is = cells(column, 0);
    for (int i = is[0]; i <= std::min(is[1], box_.size[0] - 1); ++i) {
      const ClippedPolygon part =
          is[0] == is[1] ? column
                         : (i < 0 ? column.cut(0, plane(0, 0), false) : column.slab(0, plane(0, i), plane(0, i + 1)));
      if (part.empty()) continue;
      const auto [area, moment] = part.shadow(0);
      Piece piece{.row = j + static_cast<std::int64_t>(box_.size[1]) * k, .i = i, .opening = opening};
      piece.step = -area / (dx * dx);  // an outward normal towards -x is an entry
      piece.fluid = -(plane(0, i + 1) * area - moment) / (dx * dx * dx);
      if (opening && i >= 0) piece.beyond = swept(part, t, {i, j, k});
      out.push_back(piece);
    }
  }

  double swept(const ClippedPolygon& part, int t, const std::array<int, 3>& at) const {
    const Vec3 normal = mesh_.area_vector(t);
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const auto [area, moment] = part.shadow(axis);
    const double face = plane(axis, at[axis] + (normal[axis] > 0.0 ? 1 : 0));
    return (face * area - moment) / (box_.dx * box_.dx * box_.dx);  // both factors turn sign with the normal
  }

  const TriangleMesh& mesh_;
  const Voxels& box_;
  const std::vector<char>& openings_;
  Vec3 low_;
};

// Pieces of all triangles, sorted by row and cell; within a cell in the order of the triangles.
std::vector<Piece> cut_all(const TriangleMesh& mesh, const Voxels& box, const std::vector<char>& openings) {
  const PieceCutter cutter(mesh, box, openings);
  constexpr int chunk = 8192;
  const int n = static_cast<int>(mesh.triangles.size());
  std::vector<std::vector<Piece>> found((n + chunk - 1) / chunk);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t part) {
    const int begin = static_cast<int>(part) * chunk, end = std::min(n, begin + chunk);
    for (int t = begin; t < end; ++t) cutter.cut(t, found[part]);
  });
  std::vector<std::size_t> next(static_cast<std::size_t>(box.size[1]) * box.size[2] + 1, 0);
  for (const auto& part : found)
    for (const Piece& p : part) ++next[p.row + 1];
  for (std::size_t r = 1; r < next.size(); ++r) next[r] += next[r - 1];
  std::vector<Piece> pieces(next.back());
  const std::vector<std::size_t> first = next;
  for (auto& part : found) {
    for (const Piece& p : part) pieces[next[p.row]++] = p;
    part = {};
  }
  tbb::parallel_for(std::size_t{0}, first.size() - 1, [&](std::size_t row) {
    std::stable_sort(pieces.begin() + static_cast<std::ptrdiff_t>(first[row]),
                     pieces.begin() + static_cast<std::ptrdiff_t>(first[row + 1]),
                     [](const Piece& a, const Piece& b) { return a.i < b.i; });
  });
  return pieces;
}

bool near_fluid(const Voxels& voxels, int i, int j, int k) {
  for (int c = -1; c <= 1; ++c)
    for (int b = -1; b <= 1; ++b)
      if (voxels.any_fluid(i - 1, i + 2, j + b, k + c)) return true;
  return false;
}

struct Candidate {
  CutCell cut;
  bool opening = false;
};

}  // namespace

std::vector<CutCell> cut_cells(const TriangleTree& tree, const Voxels& voxels, const std::vector<char>& openings) {
  const TriangleMesh& mesh = tree.mesh();
  require_closed(mesh);
  if (!openings.empty() && openings.size() != mesh.triangles.size())
    throw std::invalid_argument("cut_cells: openings needs one entry a triangle");
  const std::vector<Piece> pieces = cut_all(mesh, voxels, openings);

  std::vector<Candidate> candidates;
  bool overlaps = false;  // some cell has a mean winding number other than 0 ... 1
  for (std::size_t begin = 0; begin < pieces.size();) {
    const std::int64_t row = pieces[begin].row;
    double before = 0.0;
    std::size_t p = begin;
    while (p < pieces.size() && pieces[p].row == row) {
      const std::int32_t i = pieces[p].i;
      Candidate c{{i + row * voxels.size[0], before, 0.0}};
      for (; p < pieces.size() && pieces[p].row == row && pieces[p].i == i; ++p) {
        c.cut.fluid += pieces[p].fluid;
        c.cut.beyond += pieces[p].beyond;
        c.opening = c.opening || pieces[p].opening;
        before += pieces[p].step;
      }
      overlaps = overlaps || std::abs(c.cut.fluid - 0.5) > 0.5 + 1e-6 || std::abs(before - 0.5) > 0.5 + 1e-6;
      if (i >= 0) candidates.push_back(c);
    }
    begin = p;
  }
  std::vector<char> keep(candidates.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 256), [&](const auto& r) {
    for (std::size_t n = r.begin(); n < r.end(); ++n) {
      auto& [cut, opening] = candidates[n];
      const auto [i, j, k] = voxels.place(cut.cell);
      if (!near_fluid(voxels, i, j, k)) continue;
      if (overlaps) cut.fluid = union_fraction(tree, voxels.centre(i, j, k), voxels.dx, cut.fluid);
      cut.fluid = std::clamp(cut.fluid, 0.0, 1.0);
      cut.beyond = std::clamp(cut.beyond, 0.0, 1.0 - cut.fluid);
      const double centre = voxels.is_fluid(i, j, k) ? 1.0 : 0.0;
      keep[n] = std::abs(cut.fluid - centre) > negligible || (opening && cut.fluid > negligible);
    }
  });
  std::vector<CutCell> result;
  for (std::size_t n = 0; n < candidates.size(); ++n)
    if (keep[n]) result.push_back(candidates[n].cut);
  return result;
}

}  // namespace puffin::lbm::geometry
