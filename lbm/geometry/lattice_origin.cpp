#include "lbm/geometry/lattice_origin.hpp"

#include <algorithm>
#include <cmath>

namespace puffin::lbm::geometry {

double lattice_shift(const TriangleTree& tree, double dx, int axis, const std::vector<char>& flush) {
  constexpr int bins = 10000, reach = 200, same = 10;  // per cell; where a plane no longer counts; those that are one
  const TriangleMesh& mesh = tree.mesh();
  // Area of the planes by their place above the low end less whole cells, and that times the distance to the bin.
  std::vector<double> area(bins, 0.0), moment(bins, 0.0);
  double whole = 0.0;
  bool some_flush = false;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const int t = static_cast<int>(n);
    whole += mesh.area(t);
    const auto [low, high] = std::minmax({mesh.corner(t, 0)[axis], mesh.corner(t, 1)[axis], mesh.corner(t, 2)[axis]});
    if (high - low > 1e-3 * dx) continue;
    const bool decides = !flush.empty() && flush[n];
    if (some_flush && !decides) continue;
    if (decides && !some_flush) {
      some_flush = true;
      std::fill(area.begin(), area.end(), 0.0);
      std::fill(moment.begin(), moment.end(), 0.0);
    }
    const double place = (0.5 * (low + high) - tree.min()[axis]) / dx * bins, bin = std::round(place);
    const int b = static_cast<int>(std::fmod(bin, bins));
    area[b] += mesh.area(t);
    moment[b] += mesh.area(t) * (place - bin);
  }
  const auto score = [&](int centre) {
    double sum = 0.0;
    for (int k = -reach; k <= reach; ++k)
      sum += (1.0 - std::abs(k) / static_cast<double>(reach)) * area[(centre + k + bins) % bins];
    return sum;
  };
  int best = 0;
  double most = std::max(score(0), some_flush ? 0.0 : 0.02 * whole);
  for (int b = 0; b < bins; ++b) {
    if (area[b] == 0.0) continue;
    const double sum = score(b);
    if (sum <= 1.01 * most) continue;
    best = b;
    most = sum;
  }
  if (best <= same || best >= bins - same) return 0.0;
  double sum = 0.0, at = 0.0;
  for (int k = -same; k <= same; ++k) {
    sum += area[best + k];
    at += area[best + k] * (best + k) + moment[best + k];
  }
  return 1.0 - at / sum / bins;
}

}  // namespace puffin::lbm::geometry
