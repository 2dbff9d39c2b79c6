#include "cases/section_speed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "cases/section_blocks.hpp"

namespace puffin::cases {
namespace {

constexpr double least_narrowing = 1.1;  // less is the lattice's own coarseness, or hardly matters

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

double section_ratio(const Case& c, const Surface& s, const lbm::geometry::TriangleTree& tree,
                     const lbm::geometry::Voxels& v) {
  const Blocks blocks = blocks_of(c, s, tree, v);
  if (blocks.volume.empty()) return 1.0;
  const std::vector<double> phi = potential(blocks);
  if (phi.empty()) return 1.0;
  const double ratio = largest_mean(blocks, phi);
  return ratio > least_narrowing ? ratio : 1.0;
}

}  // namespace puffin::cases
