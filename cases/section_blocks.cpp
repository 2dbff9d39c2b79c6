#include "cases/section_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cases/assessment.hpp"
#include "cases/derived.hpp"
#include "cases/inlet.hpp"

namespace puffin::cases {
namespace {

namespace geometry = lbm::geometry;

constexpr double most_blocks = 30000.0;

/// Edge that makes at most most_blocks of the fluid cells, were they to fill boxes.
int edge_of(const geometry::Voxels& v) {
  int edge = 1;
  const auto cells = static_cast<double>(v.cells());
  const auto in_block = [&](int b) {
    double n = 1.0;
    for (const int size : v.size) n *= std::min(b, size);
    return n;
  };
  const int longest = std::max({v.size[0], v.size[1], v.size[2]});
  while (cells / in_block(edge) > most_blocks && edge < longest) ++edge;
  return edge;
}

/// What lies behind the open faces of cells at openings.
class Ends {
 public:
  Ends(const Case& c, const Surface& s, const geometry::TriangleTree& tree, double dx) : s_(s), tree_(tree), dx_(dx) {
    speed_.assign(s.patches.names.size(), 0.0);
    outlet_.assign(s.patches.names.size(), 0);
    const AreaOf area_of = inlet_areas(c.air, s);
    for (const Boundary& b : c.air.boundaries) {
      const int patch = s.patches.find(b.patch);
      if (patch < 0) continue;
      Air alone = c.air;
      alone.boundaries = {b};
      if (b.type == BoundaryType::velocity_inlet)
        speed_[patch] = largest_mean_speed(alone, c.stop.time, area_of);
      else if (b.type == BoundaryType::pressure_outlet)
        outlet_[patch] = 1;
    }
    fastest_ = *std::max_element(speed_.begin(), speed_.end());
    if (!matter()) return;
    for (double& speed : speed_) speed /= fastest_;
    boxes_.resize(speed_.size());
    for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t)
      if (opens(s.patches.of_triangle[t]))
        for (int k = 0; k < 3; ++k) boxes_[s.patches.of_triangle[t]].extend(s.mesh.corner(static_cast<int>(t), k));
  }
  bool opens(int patch) const { return outlet_[patch] || speed_[patch] > 0.0; }
  bool matter() const { return fastest_ > 0.0 && std::find(outlet_.begin(), outlet_.end(), 1) != outlet_.end(); }
  /// Patch behind the face at x, or -1 if it is no inlet or outlet that looks along the axis.
  int behind(const Vec3& x, int axis) const {
    const auto near = [&](const Eigen::AlignedBox3d& b) { return !b.isEmpty() && b.exteriorDistance(x) < dx_; };
    if (std::none_of(boxes_.begin(), boxes_.end(), near)) return -1;
    const geometry::Closest hit = tree_.closest(x, 1.5 * dx_);
    if (hit.triangle < 0) return -1;
    const int patch = s_.patches.of_triangle[hit.triangle];
    const Vec3 normal = s_.mesh.area_vector(hit.triangle).normalized();
    return opens(patch) && std::abs(normal[axis]) > 0.3 ? patch : -1;
  }
  bool is_outlet(int patch) const { return outlet_[patch] != 0; }
  double speed(int patch) const { return speed_[patch]; }

 private:
  const Surface& s_;
  const geometry::TriangleTree& tree_;
  double dx_;
  std::vector<double> speed_;  // by patch
  std::vector<char> outlet_;
  std::vector<Eigen::AlignedBox3d> boxes_;  // around what opens
  double fastest_ = 0.0;                    // [m/s]
};

/// Numbers of the fluid cells, in the order of the rows.
class CellNumbers {
 public:
  explicit CellNumbers(const geometry::Voxels& v) : v_(v), before_(v.runs.size()) {
    for (std::size_t r = 0; r < v.runs.size(); ++r) {
      before_[r] = count_;
      count_ += v.runs[r].end - v.runs[r].begin;
    }
  }
  std::int32_t count() const { return count_; }
  /// -1 if the cell is not fluid.
  std::int32_t at(const std::array<int, 3>& cell) const {
    const auto row = v_.row(cell[1], cell[2]);
    const auto run =
        std::partition_point(row.begin(), row.end(), [&](const geometry::FluidRun& f) { return f.end <= cell[0]; });
    if (run == row.end() || run->begin > cell[0]) return -1;
    return before_[static_cast<std::size_t>(&*run - v_.runs.data())] + cell[0] - run->begin;
  }
  template <class Body>
  void each(const Body& body) const {
    for (int k = 0; k < v_.size[2]; ++k)
      for (int j = 0; j < v_.size[1]; ++j)
        for (const geometry::FluidRun& r : v_.row(j, k))
          for (int i = r.begin; i < r.end; ++i) body(std::array{i, j, k});
  }

 private:
  const geometry::Voxels& v_;
  std::vector<std::int32_t> before_;  // by run
  std::int32_t count_ = 0;
};

/// By cell: the least number of a cell that it is connected with through faces inside its block of `edge`^3 cells.
std::vector<std::int32_t> connected_in_blocks(const CellNumbers& cells, int edge) {
  std::vector<std::int32_t> parent(static_cast<std::size_t>(cells.count()));
  for (std::int32_t n = 0; n < cells.count(); ++n) parent[n] = n;
  const auto root = [&](std::int32_t n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  cells.each([&](const std::array<int, 3>& cell) {
    for (int d = 0; d < 3; ++d) {
      if (cell[d] % edge == 0) continue;  // the one before is of another block
      auto before = cell;
      --before[d];
      const std::int32_t other = cells.at(before);
      if (other < 0) continue;
      const std::int32_t a = root(cells.at(cell)), b = root(other);
      parent[std::max(a, b)] = std::min(a, b);
    }
  });
  for (std::int32_t n = 0; n < cells.count(); ++n) parent[n] = root(n);
  return parent;
}

/// Air that an inlet brings where no outlet is reached, into a stray cell at its rim, has no way to go: it is left out.
void leave_out_dead_ends(Blocks& b) {
  std::vector<char> reached(b.volume.size(), 0);
  for (std::size_t i = 0; i < reached.size(); ++i) reached[i] = b.to_outlet[i] > 0.0;
  for (bool more = true; more;) {
    more = false;
    for (const auto& along : b.faces)
      for (const Faces& f : along)
        if (reached[f.from] != reached[f.to]) reached[f.from] = reached[f.to] = more = true;
  }
  for (auto& entering : b.entering)
    for (std::size_t i = 0; i < reached.size(); ++i)
      if (!reached[i]) entering[i] = 0.0;
}

}  // namespace

Blocks blocks_of(const Case& c, const Surface& s, const geometry::TriangleTree& tree, const geometry::Voxels& v) {
  const Ends ends(c, s, tree, v.dx);
  if (!ends.matter()) return {};
  const std::array<bool, 3> periodic = periodic_directions(c, s);
  Blocks b;
  b.edge = edge_of(v);
  const CellNumbers cells(v);
  std::vector<std::int32_t> part = connected_in_blocks(cells, b.edge);  // by cell; then its block
  for (std::int32_t n = 0; n < cells.count(); ++n) {
    if (part[n] == n) {
      part[n] = static_cast<std::int32_t>(b.volume.size());
      b.volume.push_back(0.0);
    } else {
      part[n] = part[part[n]];  // of a cell before it
    }
    b.volume[part[n]] += 1.0;
  }
  for (int d = 0; d < 3; ++d)
    for (auto* field : {&b.open_faces[d], &b.entering[d]}) field->assign(b.volume.size(), 0.0);
  b.to_outlet.assign(b.volume.size(), 0.0);
  const auto at_opening = [&](const std::array<int, 3>& cell, int own, int axis, int side) {
    Vec3 face = v.centre(cell[0], cell[1], cell[2]);
    face[axis] += 0.5 * side * v.dx;
    const int patch = ends.behind(face, axis);
    if (patch < 0) return;
    b.open_faces[axis][own] += 1.0;
    if (ends.is_outlet(patch)) b.to_outlet[own] += 2.0 / b.edge;
    b.entering[axis][own] += ends.speed(patch);
  };
  std::array<std::map<std::pair<std::int32_t, std::int32_t>, double>, 3> faces;
  cells.each([&](const std::array<int, 3>& cell) {
    const std::int32_t own = part[cells.at(cell)];
    for (int d = 0; d < 3; ++d) {
      auto ahead = cell, behind = cell;
      if (++ahead[d] == v.size[d] && periodic[d]) ahead[d] = 0;
      if (--behind[d] < 0 && periodic[d]) behind[d] = v.size[d] - 1;
      if (cells.at(behind) < 0) at_opening(cell, own, d, -1);
      const std::int32_t next = cells.at(ahead);
      if (next < 0)
        at_opening(cell, own, d, +1);
      else if (part[next] != own)
        faces[d][{own, part[next]}] += 1.0;
    }
  });
  for (int d = 0; d < 3; ++d)
    for (const auto& [pair, count] : faces[d]) b.faces[d].push_back({pair.first, pair.second, count});
  leave_out_dead_ends(b);
  return b;
}

}  // namespace puffin::cases
