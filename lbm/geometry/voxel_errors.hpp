#pragma once
// How far the staircase of cells departs from the surface, and how that shrinks with the cells.

#include <cstddef>
#include <optional>
#include <vector>

#include "lbm/geometry/voxelize.hpp"

namespace puffin::lbm::geometry {

/// Distances [m] from the surface to the faces between fluid and other cells, at the centres of the faces.
struct SurfaceError {
  double mean = 0.0, largest = 0.0;
  std::size_t faces = 0;
};
SurfaceError surface_error(const TriangleTree& tree, const Voxels& voxels);

/// The surface between the centres of two fluid cells that share a face.
struct HiddenFaces {
  std::size_t thin = 0;            // pairs of cells with a wall between them that is thinner than a cell
  std::size_t buried = 0;          // pairs of cells with a face between them that has fluid on both sides
  std::vector<Vec3> thin_where{};  // [m] points of the surface, at most 1000
  std::vector<Vec3> buried_where{};
};
/// `openings`: per triangle 1 = part of an opening; empty: none. A face is buried if the winding number on both of its
/// sides, a thousandth of a cell away, is beyond 1/2: bodies that overlap or share a face (and not the tip of a wedge).
/// In a flow it would be a wall.
HiddenFaces hidden_faces(const TriangleTree& tree, const Voxels& voxels, const std::vector<char>& openings = {});

/// Throws GeometryError with the place and a remedy if `faces.buried` > 0.
void refuse_buried(const HiddenFaces& faces);

/// Errors on the grids dx, sqrt(2) dx, 2 dx, 2 sqrt(2) dx, 4 dx, and the powers of dx that fit them best (least squares
/// of the logarithms). No order where the finest grid, or all but two, has no error above rounding: the cells fit the
/// surface. The error of a counted volume has a random sign and scatters; its order is that of a fit through scatter.
struct Convergence {
  std::vector<double> dx, volume_error, surface_error;  // [m], relative, [m]
  std::optional<double> volume_order, surface_order;
};
Convergence convergence(const TriangleTree& tree, const Voxels& finest);

/// Slope of log(error) over log(dx), of the entries with error > floor[i]; nothing with fewer than three.
std::optional<double> order_of(const std::vector<double>& dx, const std::vector<double>& error,
                               const std::vector<double>& floor);

}  // namespace puffin::lbm::geometry
