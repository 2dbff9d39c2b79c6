#pragma once
// How well do the voxels stand for the surface?

#include <cstddef>
#include <string>
#include <vector>

#include "lbm/geometry/patches.hpp"
#include "lbm/geometry/voxel_errors.hpp"
#include "lbm/geometry/voxelize.hpp"

namespace puffin::lbm::geometry {

struct PatchReport {
  std::string name;
  double area = 0.0;  // [m^2]
  std::size_t triangles = 0;
  bool opening = false;
};

struct VoxelReport {
  std::size_t cells_fluid = 0;
  double volume_stl = 0.0;     // [m^3] enclosed by the triangles
  double volume_voxels = 0.0;  // [m^3] cells_fluid dx^3
  double area_stl = 0.0;       // [m^2]
  double narrowest_gap = 0.0;  // [m] across the fluid between walls that face each other; infinity if there are none
  Vec3 narrowest_gap_at = Vec3::Zero();  // [m] its middle
  double narrowest_gap_cells = 0.0;
  double thinnest_wall = 0.0;            // [m] across the solid between two wetted faces; infinity if there are none
  Vec3 thinnest_wall_at = Vec3::Zero();  // [m]
  double recommended_dx = 0.0;           // [m] puts `cells_across` cells across the narrowest gap
  Pockets pockets;                       // dropped
  HiddenFaces hidden;
  double area_openings = 0.0;  // [m^2]
  std::vector<PatchReport> patches;

  static constexpr double cells_across = 8.0;
};

/// Gaps are measured by rays along the inward normal from points spread over every wall triangle (at most about two
/// hundred thousand in all) to the first wall hit whose normal is within 37 degrees of opposite; openings are no walls.
/// A gap narrower than the spread of those points and bounded by larger triangles may be missed.
VoxelReport voxel_report(const TriangleTree& tree, const Voxels& voxels, const Patches& patches,
                         const std::vector<std::string>& openings, const Pockets& dropped = {});

}  // namespace puffin::lbm::geometry
