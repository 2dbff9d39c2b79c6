#include "tools/puffin/bench/stability_shapes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "cases/generators/generators.hpp"
#include "lbm/geometry/stl.hpp"

namespace puffin::tools {
namespace {

namespace geometry = lbm::geometry;
using geometry::Vec3;

/// Layers of Minion & Brown, J. Comput. Phys. 138, 734 (1997), thickness 1/80, with a disturbance that varies along z:
///   u = U tanh(80 (y - 1/4)) or U tanh(80 (3/4 - y)),  v = 0.05 U sin(2 pi (x + 1/4)) (1 + 1/2 sin(2 pi z)),
/// divergence-free. At the centres of the 32^3 cells of the scene, 8 mm wide, U = 63 m/s.
void write_shear_layer(const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "x,y,z,u,v,w\n";
  constexpr int n = 32;
  constexpr double edge = 8e-3, speed = 63.0, turn = 2.0 * std::numbers::pi;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double x = (i + 0.5) / n, y = (j + 0.5) / n, z = (k + 0.5) / n;
        const double u = speed * (y < 0.5 ? std::tanh(80.0 * (y - 0.25)) : std::tanh(80.0 * (0.75 - y)));
        const double v = 0.05 * speed * std::sin(turn * (x + 0.25)) * (1.0 + 0.5 * std::sin(turn * z));
        out << edge * x << ',' << edge * y << ',' << edge * z << ',' << u << ',' << v << ",0\n";
      }
  out.flush();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

void write_rotated_duct(const std::filesystem::path& file) {
  geometry::TriangleMesh mesh = cases::generate("duct", {{"length", 10e-3}, {"width", 4e-3}, {"height", 2e-3}});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(-std::numbers::pi / 4.0, Vec3::UnitY()).toRotationMatrix();
  for (Vec3& x : mesh.vertices) x = turn * x;
  geometry::write_stl(file.string(), mesh);
}

/// Every seventh triangle is divided at a point 1e-4 of its height from an edge, which leaves a sliver.
void write_slivers(const std::filesystem::path& file) {
  const geometry::TriangleMesh whole = cases::generate("l-bend", {});
  geometry::TriangleMesh mesh = whole;
  for (std::size_t t = 0; t < whole.triangles.size(); t += 7) {
    const auto [a, b, c] = whole.triangles[t];
    const Vec3 middle = 0.5 * (whole.vertices[a] + whole.vertices[b]);
    const int p = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(middle + 1e-4 * (whole.vertices[c] - middle));
    mesh.triangles[t] = {a, b, p};
    mesh.triangles.push_back({b, c, p});
    mesh.triangles.push_back({c, a, p});
    mesh.solid.insert(mesh.solid.end(), 2, whole.solid[t]);
  }
  geometry::write_stl(file.string(), mesh);
}

/// Every fiftieth triangle is there twice.
void write_duplicates(const std::filesystem::path& file) {
  geometry::TriangleMesh mesh = cases::generate("l-bend", {});
  const std::size_t count = mesh.triangles.size();
  for (std::size_t t = 0; t < count; t += 50) {
    mesh.triangles.push_back(mesh.triangles[t]);
    mesh.solid.push_back(mesh.solid[t]);
  }
  geometry::write_stl(file.string(), mesh);
}

}  // namespace

void write_stability_shapes(const std::filesystem::path& folder) {
  write_shear_layer(folder / "shear-layer-3d.csv");
  write_rotated_duct(folder / "rotated-duct.stl");
  write_slivers(folder / "slivers.stl");
  write_duplicates(folder / "duplicate-facets.stl");
}

}  // namespace puffin::tools
