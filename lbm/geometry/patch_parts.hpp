#pragma once
// The parts of a patch: an opening may have several faces that do not touch, as vents on two sides of a device.

#include <vector>

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

/// Triangles that reach each other over edges which they share.
struct PatchPart {
  std::vector<int> triangles;    // rising
  Vec3 normal = Vec3::Zero();    // mean, out of the fluid; zero: its triangles look against each other
  Vec3 centroid = Vec3::Zero();  // of the area [m]
  double surface = 0.0;          // [m^2]
  double area = 0.0;             // [m^2] that air crosses: if the part is not plane, of its projection along the normal
};

/// The given triangles, rising, as one part, whether they touch or not.
PatchPart part_of(const TriangleMesh& mesh, std::vector<int> triangles);

/// The parts of a patch in the order of their lowest triangles; what has no area is none. The mesh must be welded.
std::vector<PatchPart> parts_of(const TriangleMesh& mesh, const std::vector<int>& patch_of_triangle, int patch);

/// Which of several parts is nearest to a point; of equally near ones the first.
class NearestPart {
 public:
  NearestPart(const TriangleMesh& mesh, const std::vector<PatchPart>& parts);
  int operator()(const Vec3& x) const { return part_[tree_.closest(x).triangle]; }

 private:
  std::vector<int> part_;  // by triangle of the tree
  TriangleTree tree_;
};

}  // namespace puffin::lbm::geometry
