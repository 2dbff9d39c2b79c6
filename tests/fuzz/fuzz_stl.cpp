// Any bytes as an STL file: read, checked, mended, asked for nearest points. What is no surface is refused by StlError
// or GeometryError; what is accepted has finite corners and indices in range, and is the same when written and read.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "lbm/geometry/repair.hpp"
#include "lbm/geometry/solid_fraction.hpp"
#include "lbm/geometry/stl.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/geometry/voxelize.hpp"

namespace {

using namespace puffin::lbm::geometry;

void demand(bool holds) {
  if (!holds) std::abort();
}

void demand_sound(const TriangleMesh& mesh) {
  demand(mesh.solid.size() == mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) demand(v.allFinite());
  for (const auto& t : mesh.triangles)
    for (const int v : t) demand(v >= 0 && v < static_cast<int>(mesh.vertices.size()));
  for (const int s : mesh.solid) demand(s >= 0 && s < static_cast<int>(mesh.solids.size()));
}

void use(TriangleMesh mesh) {
  check_surface(mesh);
  repair(mesh);
  demand_sound(mesh);
  if (mesh.triangles.empty()) return;
  const TriangleTree tree(mesh);
  const Vec3 middle = 0.5 * (tree.min() + tree.max());
  demand(tree.closest(middle).triangle >= 0);
  demand(std::isfinite(tree.winding_number(middle)));
  const double longest = (tree.max() - tree.min()).maxCoeff();
  try {
    VoxelizeOptions options;
    options.most_cells = 100'000;
    const Voxels voxels = voxelize(tree, longest / 7.3, options);
    for (const CutCell& c : cut_cells(tree, voxels)) demand(c.fluid >= 0.0 && c.fluid <= 1.0);
  } catch (const GeometryError&) {
  } catch (const std::invalid_argument&) {  // no length at all
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const TriangleMesh mesh = parse_stl("fuzz.stl", bytes, 1e-3);
    demand_sound(mesh);
    demand(mesh.triangles.size() <= size / 8);
    use(mesh);
  } catch (const StlError&) {
  }
  return 0;
}
