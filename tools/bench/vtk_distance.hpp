#pragma once
// Signed distances by VTK, to compare with.

#include <memory>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::bench {

/// vtkImplicitPolyDataDistance over a mesh; positive inside, as ours. For one thread.
class VtkDistance {
 public:
  explicit VtkDistance(const lbm::geometry::TriangleMesh& mesh);
  ~VtkDistance();
  double operator()(const lbm::geometry::Vec3& p) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace puffin::bench
