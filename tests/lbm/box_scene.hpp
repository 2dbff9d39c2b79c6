#pragma once
// A box of cells with a chosen boundary on each of its six faces: the scene of most tests of the air.

#include <array>
#include <memory>

#include "lbm/air.hpp"

namespace puffin::lbm::test {

/// Faces in the order x-min, x-max, y-min, y-max, z-min, z-max. The box is [0,L] in each direction, cells of size dx;
/// `offset` shifts the grid against the box in fractions of a cell (0: cell faces lie on the walls).
struct BoxScene {
  geometry::TriangleMesh mesh;
  geometry::Voxels voxels;
  LinkGeometry surface;
};

inline BoxScene make_box(const geometry::Vec3& length, double dx, std::array<Boundary, 6> faces,
                         const geometry::Vec3& offset = geometry::Vec3::Zero()) {
  using geometry::Vec3;
  BoxScene scene;
  for (int n = 0; n < 8; ++n)
    scene.mesh.vertices.push_back(Vec3(n & 1 ? length[0] : 0.0, n & 2 ? length[1] : 0.0, n & 4 ? length[2] : 0.0));
  const int corners[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const char* names[6] = {"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"};
  for (int f = 0; f < 6; ++f) {
    const int* c = corners[f];
    for (const auto& t : {std::array<int, 3>{c[0], c[1], c[2]}, std::array<int, 3>{c[0], c[2], c[3]}}) {
      scene.mesh.triangles.push_back(t);
      scene.mesh.solid.push_back(f);
      scene.surface.patch_of_triangle.push_back(f);
    }
    scene.mesh.solids.push_back(names[f]);
    faces[f].patch = names[f];
    scene.surface.boundaries.push_back(faces[f]);
  }
  auto& v = scene.voxels;
  v.dx = dx;
  for (int d = 0; d < 3; ++d) {
    const bool periodic = faces[2 * d].kind == BoundaryKind::periodic;
    v.size[d] = static_cast<int>(std::lround(length[d] / dx)) + (periodic ? 0 : 2);
    v.origin[d] = dx * ((periodic ? 0.5 : -0.5) + offset[d]);
  }
  v.fill([&](int i, int j, int k) {
    const Vec3 x = v.centre(i, j, k);
    return (x.array() > 0.0).all() && (x.array() < length.array()).all();
  });
  return scene;
}

/// The scene owns the mesh that its surface refers to.
inline Air make_air(BoxScene& scene, const AirOptions& options) {
  scene.surface.mesh = &scene.mesh;
  return lbm::make_air(scene.voxels, scene.surface, options);
}

inline Boundary wall() { return {"", BoundaryKind::wall, {}}; }
inline Boundary periodic() { return {"", BoundaryKind::periodic, {}}; }

inline Drive at_rest(const Air& air) {
  Drive drive;
  drive.speed.assign(air.boundaries.size(), 0.0);
  drive.density_excess.assign(air.boundaries.size(), 0.0);
  return drive;
}

inline KernelReport step(Air& air, double tau0, const Drive& drive) {
  const KernelReport report = collide_and_stream({tau0, 1.0, tau0}, drive, air);
  apply_links(drive, air);
  return report;
}

}  // namespace puffin::lbm::test
