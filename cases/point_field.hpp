#pragma once
// A velocity field given at points: rows x, y, z, u, v, w of a file, or the cells that another run has stored.

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace puffin::cases {

using Vec3 = Eigen::Vector3d;

/// Interpolation between given points; constant beyond them. Immutable, safe to query from any thread.
///
/// Points that fill a rectangular grid (also a plane or a line of one; equal coordinates to 1e-6 of the extent):
/// multilinear, exact for linear fields; along a direction with a single coordinate the field is constant.
/// Points anywhere else: moving least squares, a linear fit to the 12 nearest points with weights 1/r^4, which passes
/// through the points and is exact for linear fields (Lancaster & Salkauskas, Math. Comput. 37, 141 (1981)); each
/// component is kept within the range of these neighbours, so nothing is extrapolated.
class PointField {
 public:
  /// Throws std::invalid_argument if there is no point, the lengths differ, or two values stand at one point.
  PointField(std::vector<Vec3> points, std::vector<Vec3> values);

  Vec3 at(const Vec3& x) const;
  bool is_grid() const { return !grid_.empty(); }
  std::size_t size() const { return points_.size(); }

 private:
  bool find_grid();
  Vec3 on_grid(const Vec3& x) const;
  Vec3 scattered(const Vec3& x) const;
  void sort_tree(int begin, int end, int depth);
  void nearest(const Vec3& x, int begin, int end, int depth, std::vector<std::pair<double, int>>& best) const;

  std::vector<Vec3> points_, values_;
  std::array<std::vector<double>, 3> axis_;  // coordinates of the grid, rising
  std::vector<int> grid_;                    // point of node (i,j,k), i fastest; empty: scattered
  std::vector<int> tree_;                    // scattered: indices, a balanced tree over x, y, z in turn
};

/// Points [m] and velocities [m/s] as a file has them.
struct PointRows {
  std::vector<Vec3> points, values;
};

/// Reads x, y, z, u, v, w from a CSV file. Throws std::invalid_argument naming the file.
PointRows read_point_rows(const std::string& file);
PointField read_point_field(const std::string& file);

}  // namespace puffin::cases
