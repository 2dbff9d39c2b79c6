#include "lbm/geometry/voxelize.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>

#include "lbm/geometry/closing_caps.hpp"
#include "lbm/geometry/lattice_origin.hpp"
#include "lbm/geometry/row_crossings.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/triangle_distance.hpp"

namespace puffin::lbm::geometry {

namespace {

std::string millimetres(double metres) { return std::to_string(metres * 1e3) + " mm"; }

Voxels make_box(const TriangleTree& tree, double dx, const VoxelizeOptions& options) {
  if (!(dx > 0.0) || !std::isfinite(dx)) throw std::invalid_argument("error: dx must be a positive length");
  if (!options.openings.empty() && options.openings.size() != tree.mesh().triangles.size()) {
    throw std::invalid_argument("error: openings needs one entry a triangle");
  }
  if (!options.flush.empty() && options.flush.size() != tree.mesh().triangles.size()) {
    throw std::invalid_argument("error: flush needs one entry a triangle");
  }
  Voxels box;
  box.dx = dx;
  double cells = 1.0;
  for (int d = 0; d < 3; ++d) {
    const double length = tree.max()[d] - tree.min()[d];
    const double shift = options.periodic[d] ? 0.0 : lattice_shift(tree, dx, d, options.flush);
    box.origin[d] = tree.min()[d] + (0.5 - shift) * dx;
    const double exact = length / dx + shift, nearest = std::max(1.0, std::round(exact));
    // A length that is a whole number of cells but for single precision coordinates needs no further cell.
    const bool whole = std::abs(exact - nearest) <= 1e-5 * nearest;
    if (options.periodic[d] && !whole) {
      throw std::invalid_argument(std::string("error: the box is ") + millimetres(length) + " long in the periodic " +
                                  "direction " + "xyz"[d] + ", which is " + std::to_string(exact) +
                                  " cells; a whole number is needed, the nearest dx is " +
                                  millimetres(length / nearest));
    }
    const double n = std::max(1.0, whole ? nearest : std::ceil(exact));
    cells *= n;
    if (cells > static_cast<double>(options.most_cells) || n > 1e6) {
      throw std::invalid_argument("error: a dx of " + millimetres(dx) + " needs more than " +
                                  std::to_string(options.most_cells) +
                                  " cells in the bounding box; take a larger dx, or check the unit of the file");
    }
    box.size[d] = static_cast<int>(n);
  }
  return box;
}

// Runs of rows, made for blocks of rows in parallel and joined in order.
template <class RowRuns>
void set_rows(const RowRuns& row_runs, Voxels& box) {
  constexpr std::size_t block = 256;
  const std::size_t rows = box.rows();
  std::vector<std::vector<FluidRun>> found((rows + block - 1) / block);
  box.first.assign(rows + 1, 0);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t b) {
    for (std::size_t row = b * block; row < std::min(rows, (b + 1) * block); ++row) {
      row_runs(row, found[b]);
      box.first[row + 1] = found[b].size();
    }
  });
  std::size_t sum = 0;
  for (std::size_t b = 0; b < found.size(); ++b) {
    for (std::size_t row = b * block; row < std::min(rows, (b + 1) * block); ++row) box.first[row + 1] += sum;
    sum += found[b].size();
  }
  box.runs.clear();
  box.runs.reserve(sum);
  for (auto& part : found) {
    box.runs.insert(box.runs.end(), part.begin(), part.end());
    part = {};
  }
}

void fill(const TriangleTree& tree, Voxels& box) {
  const double shift = on_surface(tree.min(), tree.max(), box.dx);
  const ClosingCaps caps(tree.mesh(), tree.adjacency());
  RowCrossings rows = row_crossings(caps.closed(), box, shift);
  const int nx = box.size[0];
  set_rows(
      [&](std::size_t row, std::vector<FluidRun>& runs) {
        const auto begin = rows.crossings.begin() + static_cast<std::ptrdiff_t>(rows.first[row]),
                   end = rows.crossings.begin() + static_cast<std::ptrdiff_t>(rows.first[row + 1]);
        if (begin == end && caps.empty()) return;
        std::sort(begin, end, [](const Crossing& a, const Crossing& b) { return a.i < b.i; });
        const int j = static_cast<int>(row) % box.size[1], k = static_cast<int>(row) / box.size[1];
        const std::size_t row_begin = runs.size();
        const auto add = [&](int from, int to) {
          if (runs.size() > row_begin && runs.back().end == from)
            runs.back().end = to;
          else
            runs.push_back({from, to});
        };
        // Between two crossings the winding number of the closed surface stays.
        int winding = 0, from = 0;
        for (auto c = begin; from < nx; ++c) {
          const int to = c == end ? nx : std::min(c->i, nx);
          if (caps.empty()) {
            if (winding != 0 && to > from) add(from, to);
          } else {
            for (int i = from; i < to; ++i)
              if (caps.inside(winding, box.centre(i, j, k) + Vec3::Constant(shift))) add(i, i + 1);
          }
          if (c == end) break;
          winding += c->step;
          from = to;
        }
      },
      box);
}

// Calls visit(run, other) for every run and each run of the row dj, dk beside it that shares a face with it.
template <class Visit>
void for_neighbours(const Voxels& voxels, int j, int k, int beside_j, int beside_k, const Visit& visit) {
  const auto own = voxels.row(j, k), other = voxels.row(beside_j, beside_k);
  auto b = other.begin();
  for (auto a = own.begin(); a != own.end(); ++a) {
    while (b != other.end() && b->end <= a->begin) ++b;
    for (auto c = b; c != other.end() && c->begin < a->end; ++c)
      visit(static_cast<std::size_t>(&*a - voxels.runs.data()), static_cast<std::size_t>(&*c - voxels.runs.data()));
  }
}

// Which runs of cells hang together, through faces and across periodic faces: union-find over runs.
class Connected {
 public:
  Connected(const Voxels& voxels, const std::array<bool, 3>& periodic) : parent_(voxels.runs.size()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    const auto [nx, ny, nz] = voxels.size;
    const auto join = [&](std::size_t a, std::size_t b) { unite(a, b); };
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j) {
        if (j + 1 < ny || periodic[1]) for_neighbours(voxels, j, k, (j + 1) % ny, k, join);
        if (k + 1 < nz || periodic[2]) for_neighbours(voxels, j, k, j, (k + 1) % nz, join);
        const auto row = voxels.row(j, k);
        if (periodic[0] && !row.empty() && row.front().begin == 0 && row.back().end == nx)
          unite(static_cast<std::size_t>(&row.front() - voxels.runs.data()),
                static_cast<std::size_t>(&row.back() - voxels.runs.data()));
      }
  }
  /// The lowest run that hangs together with this one.
  std::size_t root(std::size_t run) {
    while (parent_[run] != run) run = parent_[run] = parent_[parent_[run]];
    return run;
  }

 private:
  void unite(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::size_t> parent_;
};

// Marks runs of fluid cells that touch an opening: within one dx of a point of it, with nothing between. (Not: whose
// nearest triangle is one of an opening. In a slice one cell wide the periodic sides are as near as the opening, or
// nearer.)
std::vector<char> runs_at_openings(const TriangleTree& tree, const std::vector<char>& openings, const Voxels& voxels) {
  const TriangleMesh& mesh = tree.mesh();
  std::vector<char> found(voxels.runs.size(), 0);
  for (std::size_t t = 0; t < openings.size(); ++t) {
    if (!openings[t]) continue;
    const auto& tri = mesh.triangles[t];
    const Vec3 &a = mesh.vertices[tri[0]], &b = mesh.vertices[tri[1]], &c = mesh.vertices[tri[2]];
    std::array<int, 3> low, high;
    for (int d = 0; d < 3; ++d) {
      const double l = (std::min({a[d], b[d], c[d]}) - voxels.origin[d]) / voxels.dx - 1.0;
      const double h = (std::max({a[d], b[d], c[d]}) - voxels.origin[d]) / voxels.dx + 1.0;
      low[d] = std::max(0, static_cast<int>(std::ceil(l)));
      high[d] = std::min(voxels.size[d] - 1, static_cast<int>(std::floor(h)));
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (const FluidRun& run : voxels.row(j, k)) {
          char& mark = found[static_cast<std::size_t>(&run - voxels.runs.data())];
          for (int i = std::max(low[0], run.begin); !mark && i < std::min(high[0] + 1, run.end); ++i) {
            const Vec3 centre = voxels.centre(i, j, k), way = nearest_on_triangle(centre, a, b, c).point - centre;
            mark = way.norm() <= voxels.dx && !tree.first_hit(centre, way, 1.0 - 1e-6);
          }
        }
  }
  return found;
}

}  // namespace

Pockets drop_pockets(const TriangleTree& tree, const VoxelizeOptions& options, Voxels& voxels) {
  const std::vector<char> at_opening = runs_at_openings(tree, options.openings, voxels);
  if (std::find(at_opening.begin(), at_opening.end(), 1) == at_opening.end()) {
    throw GeometryError(
        "error: no fluid cell lies at any opening; take a smaller dx, or check which patches are openings");
  }
  Connected connected(voxels, options.periodic);
  std::vector<char> reached(voxels.runs.size(), 0);  // by root
  for (std::size_t r = 0; r < at_opening.size(); ++r)
    if (at_opening[r]) reached[connected.root(r)] = 1;
  struct Pocket {
    std::size_t cells = 0;
    Vec3 where = Vec3::Zero();
  };
  std::map<std::size_t, Pocket> by_root;  // the root is a pocket's lowest run
  Voxels kept = voxels;
  kept.runs.clear();
  for (std::size_t row = 0; row < voxels.rows(); ++row) {
    for (const FluidRun& run : voxels.row(row)) {
      const std::size_t root = connected.root(static_cast<std::size_t>(&run - voxels.runs.data()));
      if (reached[root]) {
        kept.runs.push_back(run);
        continue;
      }
      Pocket& pocket = by_root[root];
      if (pocket.cells == 0)
        pocket.where =
            voxels.centre(run.begin, static_cast<int>(row) % voxels.size[1], static_cast<int>(row) / voxels.size[1]);
      pocket.cells += static_cast<std::size_t>(run.end - run.begin);
    }
    kept.first[row + 1] = kept.runs.size();
  }
  voxels = std::move(kept);
  std::vector<Pocket> pockets;
  pockets.reserve(by_root.size());
  for (const auto& [root, pocket] : by_root) pockets.push_back(pocket);
  std::stable_sort(pockets.begin(), pockets.end(), [](const Pocket& a, const Pocket& b) { return a.cells > b.cells; });
  Pockets dropped;
  dropped.count = pockets.size();
  for (const Pocket& p : pockets) {
    dropped.cells += p.cells;
    if (dropped.where.size() < 1000) dropped.where.push_back(p.where);
  }
  return dropped;
}

Voxels voxelize(const TriangleTree& tree, double dx, const VoxelizeOptions& options, Pockets* dropped) {
  Voxels voxels = make_box(tree, dx, options);
  fill(tree, voxels);
  if (voxels.runs.empty()) {
    throw GeometryError("error: no cell centre lies inside the surface at a dx of " + millimetres(dx) +
                        "; the surface is " + millimetres((tree.max() - tree.min()).maxCoeff()) +
                        " long: check its unit, take a smaller dx, or check that it is closed");
  }
  Pockets pockets;
  if (!options.openings.empty()) pockets = drop_pockets(tree, options, voxels);
  if (dropped) *dropped = std::move(pockets);
  return voxels;
}

}  // namespace puffin::lbm::geometry
