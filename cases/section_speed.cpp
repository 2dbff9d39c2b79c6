#include "cases/section_speed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cases/assessment.hpp"
#include "cases/derived.hpp"

namespace puffin::cases {
namespace {

namespace geometry = lbm::geometry;

constexpr double most_blocks = 30000.0;
constexpr double least_narrowing = 1.1;  // less is the lattice's own coarseness, or hardly matters

/// Blocks of b x b x b cells with the numbers of open faces between them. Lengths in cells, so areas are numbers of
/// faces; speeds in parts of the fastest inlet's.
struct Blocks {
  int edge = 1;                              // b
  std::array<int, 3> size{};                 // blocks along each axis
  std::vector<std::int32_t> number;          // by place: of the block, or -1
  std::vector<double> volume;                // by block: fluid cells
  std::array<std::vector<int>, 3> next;      // block behind along each axis, or -1
  std::array<std::vector<double>, 3> faces;  // open faces to it
  // Per axis and block: open faces of openings, and the flow that enters through inlets.
  std::array<std::vector<double>, 3> open_faces, entering;
  std::vector<double> to_outlet;  // conductance to phi = 0
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
    std::vector<char> opens(s.patches.names.size(), 0);
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
      opens[patch] = outlet_[patch] || speed_[patch] > 0.0;
    }
    fastest_ = *std::max_element(speed_.begin(), speed_.end());
    any_outlet_ = std::find(outlet_.begin(), outlet_.end(), 1) != outlet_.end();
    if (!matter()) return;
    for (double& speed : speed_) speed /= fastest_;
    boxes_.resize(opens.size());
    for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t)
      if (opens[s.patches.of_triangle[t]])
        for (int k = 0; k < 3; ++k) boxes_[s.patches.of_triangle[t]].extend(s.mesh.corner(static_cast<int>(t), k));
  }
  bool matter() const { return fastest_ > 0.0 && any_outlet_; }
  /// Patch behind the face at x, or -1 if it is no inlet or outlet that looks along the axis.
  int behind(const Vec3& x, int axis) const {
    const bool near = std::any_of(boxes_.begin(), boxes_.end(), [&](const Eigen::AlignedBox3d& b) {
      return !b.isEmpty() && b.exteriorDistance(x) < dx_;
    });
    if (!near) return -1;
    const geometry::Closest hit = tree_.closest(x, 1.5 * dx_);
    if (hit.triangle < 0) return -1;
    const int patch = s_.patches.of_triangle[hit.triangle];
    const Vec3 normal = s_.mesh.area_vector(hit.triangle).normalized();
    return (outlet_[patch] || speed_[patch] > 0.0) && std::abs(normal[axis]) > 0.3 ? patch : -1;
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
  bool any_outlet_ = false;
};

Blocks blocks_of(const geometry::Voxels& v, const std::array<bool, 3>& periodic, const Ends& ends) {
  Blocks b;
  b.edge = edge_of(v);
  for (int d = 0; d < 3; ++d) b.size[d] = (v.size[d] + b.edge - 1) / b.edge;
  b.number.assign(static_cast<std::size_t>(b.size[0]) * b.size[1] * b.size[2], -1);
  const auto block_at = [&](const std::array<int, 3>& cell) -> std::int32_t& {
    return b
        .number[cell[0] / b.edge + static_cast<std::size_t>(b.size[0]) *
                                       (cell[1] / b.edge + static_cast<std::size_t>(b.size[1]) * (cell[2] / b.edge))];
  };
  const auto each_cell = [&](auto&& body) {
    for (int k = 0; k < v.size[2]; ++k)
      for (int j = 0; j < v.size[1]; ++j)
        for (const geometry::FluidRun& r : v.row(j, k))
          for (int i = r.begin; i < r.end; ++i) body(std::array{i, j, k});
  };
  each_cell([&](const std::array<int, 3>& cell) {
    std::int32_t& n = block_at(cell);
    if (n < 0) {
      n = static_cast<std::int32_t>(b.volume.size());
      b.volume.push_back(0.0);
    }
    b.volume[n] += 1.0;
  });
  for (int d = 0; d < 3; ++d) {
    b.next[d].assign(b.volume.size(), -1);
    for (auto* field : {&b.faces[d], &b.open_faces[d], &b.entering[d]}) field->assign(b.volume.size(), 0.0);
  }
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
  each_cell([&](const std::array<int, 3>& cell) {
    const int own = block_at(cell);
    for (int d = 0; d < 3; ++d) {
      auto ahead = cell, behind = cell;
      if (++ahead[d] == v.size[d] && periodic[d]) ahead[d] = 0;
      if (--behind[d] < 0 && periodic[d]) behind[d] = v.size[d] - 1;
      if (!v.is_fluid(behind[0], behind[1], behind[2])) at_opening(cell, own, d, -1);
      if (!v.is_fluid(ahead[0], ahead[1], ahead[2])) {
        at_opening(cell, own, d, +1);
      } else if (const int other = block_at(ahead); other != own) {
        b.next[d][own] = other;
        b.faces[d][own] += 1.0;
      }
    }
  });
  return b;
}

/// phi by conjugate gradients with the diagonal as preconditioner, to 1e-5 of the residual; empty if they do not
/// arrive, as where an inlet has no way out.
std::vector<double> potential(const Blocks& b) {
  const std::size_t n = b.volume.size();
  std::vector<double> phi(n, 0.0), rest(n, 0.0), diagonal = b.to_outlet, search(n, 0.0), image(n);
  for (int d = 0; d < 3; ++d)
    for (std::size_t i = 0; i < n; ++i) {
      rest[i] += b.entering[d][i];
      if (b.next[d][i] < 0) continue;
      diagonal[i] += b.faces[d][i] / b.edge;
      diagonal[b.next[d][i]] += b.faces[d][i] / b.edge;
    }
  for (double& x : diagonal) x = x > 0.0 ? x : 1.0;
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
      for (std::size_t i = 0; i < n; ++i) {
        const int other = b.next[d][i];
        if (other < 0) continue;
        const double flow = b.faces[d][i] / b.edge * (search[i] - search[other]);
        image[i] += flow;
        image[other] -= flow;
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
  std::array<std::vector<double>, 3> flow, widest;  // through both faces; the larger of the two
  for (int d = 0; d < 3; ++d) {
    flow[d].assign(n, 0.0);
    widest[d].assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      widest[d][i] = std::max(widest[d][i], b.open_faces[d][i]);
      flow[d][i] += b.entering[d][i] + (b.open_faces[d][i] > 0.0 ? b.to_outlet[i] * phi[i] : 0.0);
      const int other = b.next[d][i];
      if (other < 0) continue;
      const double through = b.faces[d][i] / b.edge * (phi[i] - phi[other]);
      flow[d][i] += through;
      flow[d][other] += through;
      widest[d][i] = std::max(widest[d][i], b.faces[d][i]);
      widest[d][other] = std::max(widest[d][other], b.faces[d][i]);
    }
  }
  const double top = *std::max_element(phi.begin(), phi.end());
  if (!(top > 0.0)) return 0.0;
  std::vector<double> first(sections, 0.0), second(sections, 0.0);  // sums of V |grad phi| and V |grad phi|^2
  for (std::size_t i = 0; i < n; ++i) {
    double square = 0.0, reach = 0.0;  // half the range of phi in the block
    for (int d = 0; d < 3; ++d) {
      const double u = widest[d][i] > 0.0 ? 0.5 * flow[d][i] / widest[d][i] : 0.0;
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
