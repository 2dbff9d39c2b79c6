#pragma once
// How fast surfaces are read, searched and turned into cells; distances beside those of VTK.

#include <functional>
#include <string>

namespace puffin::bench {

/// One measured operation. Where VTK does the same on the same points in the same run, `ratio` is ours over its.
struct GeometryRow {
  std::string what;  // "read", "check", "tree", "voxelize", "cut-cells", "signed-distance", ...
  std::string
      where;  // points of queries: "band" (within 4 cells of the surface; contacts: within reach), "corners" or "box"
  long long triangles = 0;
  long long count = 0;  // triangles, cells or queries
  int threads = 0;
  double seconds = 0.0;
  double per_second = 0.0;      // count / seconds
  double vtk_per_second = 0.0;  // vtkImplicitPolyDataDistance, one thread (it has no more); 0: not compared
  double ratio = 0.0;
  double difference = 0.0;    // largest |ours - VTK's| over the edge of a cell, on the points that both were asked
  long long other_side = 0;   // points where the signs differ farther than 1e-6 of a cell from the surface
  double foreign_load = 0.0;  // share of the cores that other processes used meanwhile
  double memory = 0.0;        // [byte] peak of the process after this row
};

/// A wavy torus of a million triangles (quick: a hundred thousand), ten million cells (one): written as binary STL,
/// read, checked, its tree built, voxelised, cut; then distances, winding numbers, rays over links and contact places
/// at random points; distances also for a hundred thousand (quick: not) and ten thousand triangles. Calls `done` after
/// each row. Throws std::runtime_error if the file cannot be written.
void geometry_benchmark(bool quick, const std::function<void(const GeometryRow&)>& done);

}  // namespace puffin::bench
