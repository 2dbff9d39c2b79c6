#include "cases/section_speed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cases/assessment.hpp"
#include "cases/derived.hpp"

namespace puffin::cases {
namespace {

namespace geometry = lbm::geometry;

constexpr double most_blocks = 30000.0;
constexpr double least_narrowing = 1.1;  // less is the lattice's own coarseness, or hardly matters

struct Faces {
  std::int32_t from = 0, to = 0;  // blocks, one behind the other along an axis
  double count = 0.0;             // open faces between them
};

/// Blocks of b x b x b cells, what a wall parts inside one being two. Lengths in cells, so areas are numbers of faces;
/// speeds in parts of the fastest inlet's.
struct Blocks {
  int edge = 1;                                             // b
  std::vector<double> volume;                               // by block: fluid cells
  std::array<std::vector<Faces>, 3> faces;                  // along each axis
  std::array<std::vector<double>, 3> open_faces, entering;  // by axis and block: of openings; the inlets' flow
  std::vector<double> to_outlet;                            // conductance to phi = 0
};

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
    const AreaOf area_of = [&](const std::string& patch) { return s.area_of(patch); };
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

Blocks blocks_of(const geometry::Voxels& v, const std::array<bool, 3>& periodic, const Ends& ends) {
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
  return b;
}

/// phi by conjugate gradients with the diagonal as preconditioner, to 1e-5 of the residual; empty if they do not
/// arrive, as where an inlet has no way out.
std::vector<double> potential(const Blocks& b) {
  const std::size_t n = b.volume.size();
  std::vector<double> phi(n, 0.0), rest(n, 0.0), diagonal = b.to_outlet, search(n, 0.0), image(n);
  for (int d = 0; d < 3; ++d) {
    for (std::size_t i = 0; i < n; ++i) rest[i] += b.entering[d][i];
    for (const Faces& f : b.faces[d]) {
      diagonal[f.from] += f.count / b.edge;
      diagonal[f.to] += f.count / b.edge;
    }
  }
  for (double& x : diagonal)
    if (!(x > 0.0)) x = 1.0;
  double start = 0.0, before = 0.0;
  for (int iteration = 0; iteration < 5000; ++iteration) {
    double now = 0.0;
    for (std::size_t i = 0; i < n; ++i) now += rest[i] * rest[i] / diagonal[i];
    if (iteration == 0) start = now;
    if (!(now > 1e-10 * start)) return now >= 0.0 ? phi : std::vector<double>();
    for (std::size_t i = 0; i < n; ++i)
      search[i] = rest[i] / diagonal[i] + (iteration > 0 ? now / before * search[i] : 0.0);
    for (std::size_t i = 0; i < n; ++i) image[i] = b.to_outlet[i] * search[i];
    for (int d = 0; d < 3; ++d)
      for (const Faces& f : b.faces[d]) {
        const double flow = f.count / b.edge * (search[f.from] - search[f.to]);
        image[f.from] += flow;
        image[f.to] -= flow;
      }
    double curvature = 0.0;
    for (std::size_t i = 0; i < n; ++i) curvature += search[i] * image[i];
    const double length = now / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      phi[i] += length * search[i];
      rest[i] -= length * image[i];
    }
    before = now;
  }
  return {};
}

/// The largest mean speed over a section. A block counts for all sections that pass through it.
double largest_mean(const Blocks& b, const std::vector<double>& phi) {
  constexpr int sections = 200;
  const std::size_t n = b.volume.size();
  std::array<std::vector<double>, 3> flow = b.entering, behind, ahead;  // through both faces of a block; their areas
  for (int d = 0; d < 3; ++d) {
    behind[d].assign(n, 0.0);
    ahead[d].assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      if (b.open_faces[d][i] > 0.0) flow[d][i] += b.to_outlet[i] * phi[i];
    for (const Faces& f : b.faces[d]) {
      const double through = f.count / b.edge * (phi[f.from] - phi[f.to]);
      flow[d][f.from] += through;
      flow[d][f.to] += through;
      ahead[d][f.from] += f.count;
      behind[d][f.to] += f.count;
    }
  }
  const double top = *std::max_element(phi.begin(), phi.end());
  if (!(top > 0.0)) return 0.0;
  std::vector<double> first(sections, 0.0), second(sections, 0.0);  // sums of V |grad phi| and V |grad phi|^2
  for (std::size_t i = 0; i < n; ++i) {
    double square = 0.0, reach = 0.0;  // half the range of phi in the block
    for (int d = 0; d < 3; ++d) {
      const double widest = std::max({b.open_faces[d][i], behind[d][i], ahead[d][i]});
      const double u = widest > 0.0 ? 0.5 * flow[d][i] / widest : 0.0;
      square += u * u;
      reach += 0.5 * b.edge * std::abs(u);
    }
    const double speed = std::sqrt(square), low = (phi[i] - reach) / top * sections,
                 high = (phi[i] + reach) / top * sections;
    if (!(high > low)) continue;
    for (int s = std::max(0, static_cast<int>(low)); s < std::min<double>(sections, high); ++s) {
      const double share = (std::min(high, s + 1.0) - std::max(low, static_cast<double>(s))) / (high - low);
      if (!(share > 0.0)) continue;
      first[s] += share * b.volume[i] * speed;
      second[s] += share * b.volume[i] * square;
    }
  }
  double largest = 0.0;
  for (int s = 0; s < sections; ++s)
    if (first[s] > 0.0) largest = std::max(largest, second[s] / first[s]);
  return largest;
}

}  // namespace

double section_ratio(const Case& c, const Surface& s, const geometry::TriangleTree& tree, const geometry::Voxels& v) {
  const Ends ends(c, s, tree, v.dx);
  if (!ends.matter()) return 1.0;
  const Blocks blocks = blocks_of(v, periodic_directions(c, s), ends);
  const std::vector<double> phi = potential(blocks);
  if (phi.empty()) return 1.0;
  const double ratio = largest_mean(blocks, phi);
  return ratio > least_narrowing ? ratio : 1.0;
}

}  // namespace puffin::cases
