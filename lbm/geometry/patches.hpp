#pragma once
// Names for parts of a surface: openings, walls, obstacles.

#include <string>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

struct PatchSelection {
  std::string name;
  std::string select;  // "solid:NAME", "plane:x-min" ... "plane:z-max", "near:[x,y,z]" [m]
};

struct Patches {
  std::vector<std::string> names;
  std::vector<int> of_triangle;  // per triangle: index into names

  /// Index of a name, or -1.
  int find(const std::string& name) const;
};

/// "solid:NAME": the triangles of that solid of the file. "plane:x-min": all triangles that lie in that extreme plane
/// of the bounding box (corners within 1e-5 of its diagonal). "near:[x,y,z]": the connected coplanar triangles (normals
/// within half a degree of the first, or all corners in its plane) around the triangle nearest to the point, which must
/// lie within 1 % of the diagonal of it. Untagged triangles keep the name of their solid if the file has several, else
/// they are "wall". Selections come first in `names`, in order. Throws GeometryError listing every bad selection:
/// unknown solid (with the known ones and the likeliest), bad syntax, nothing selected, two selections that overlap, a
/// name used twice, a solid that bears a selection's name but is not wholly selected.
Patches assign_patches(const TriangleMesh& mesh, const std::vector<PatchSelection>& selections);

}  // namespace puffin::lbm::geometry
