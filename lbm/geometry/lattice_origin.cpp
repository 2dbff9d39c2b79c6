#include "lbm/geometry/lattice_origin.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace puffin::lbm::geometry {

double lattice_shift(const TriangleTree& tree, double dx, int axis) {
  constexpr double same = 1e-3;  // of a cell
  struct Plane {
    double phase, area;  // place above the low end in cells, less whole ones
  };
  const TriangleMesh& mesh = tree.mesh();
  std::vector<Plane> planes;
  double at_low_end = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [low, high] =
        std::minmax({mesh.corner(static_cast<int>(t), 0)[axis], mesh.corner(static_cast<int>(t), 1)[axis],
                     mesh.corner(static_cast<int>(t), 2)[axis]});
    if (high - low > same * dx) continue;
    const double place = (0.5 * (low + high) - tree.min()[axis]) / dx, area = mesh.area(static_cast<int>(t));
    double phase = place - std::floor(place);
    if (phase > 1.0 - same) phase -= 1.0;  // rounding below a whole number
    if (phase < same) at_low_end += area;
    planes.push_back({phase, area});
  }
  std::sort(planes.begin(), planes.end(), [](const Plane& a, const Plane& b) { return a.phase < b.phase; });
  double best = 0.0, most = 1.01 * at_low_end, sum = 0.0;
  for (std::size_t first = 0, end = 0; first < planes.size(); sum -= planes[first++].area) {
    for (; end < planes.size() && planes[end].phase < planes[first].phase + same; ++end) sum += planes[end].area;
    if (planes[first].phase < same || sum <= most) continue;
    most = sum;
    best = 0.5 * (planes[first].phase + planes[end - 1].phase);
  }
  return best == 0.0 ? 0.0 : 1.0 - best;
}

}  // namespace puffin::lbm::geometry
