#include "tools/bench/vtk_distance.hpp"

#include <vtkCellArray.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace puffin::bench {

struct VtkDistance::Parts {
  vtkNew<vtkImplicitPolyDataDistance> distance;
};

VtkDistance::VtkDistance(const lbm::geometry::TriangleMesh& mesh) : parts_(std::make_unique<Parts>()) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& v : mesh.vertices) points->InsertNextPoint(v.x(), v.y(), v.z());
  vtkNew<vtkCellArray> cells;
  for (const auto& t : mesh.triangles) {
    cells->InsertNextCell(3);
    for (const int v : t) cells->InsertCellPoint(v);
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(cells);
  parts_->distance->SetInput(surface);
}

VtkDistance::~VtkDistance() = default;

double VtkDistance::operator()(const lbm::geometry::Vec3& p) const {
  return -parts_->distance->EvaluateFunction(p.x(), p.y(), p.z());
}

}  // namespace puffin::bench
