#pragma once
// Which links of a cell the surface cuts, and where.

#include <cstdint>
#include <memory>
#include <vector>

#include "lbm/links.hpp"

namespace puffin::lbm {

/// What cuts one link.
struct Cut {
  std::int8_t direction = 0;
  bool thin = false;  // the neighbour is active as well
  std::int16_t patch = 0;
  float q = 0.5F;  // distance to the surface over the length of the link
};

/// The surface without its periodic faces, and the shifts under which it repeats. Keeps references to its arguments.
class CutFinder {
 public:
  /// `band`: cells behind the walls are live air (ibm).
  CutFinder(const Rows& rows, const LinkGeometry& surface, const CellKinds& kinds, bool band);

  /// All cut links of one active cell. `missed` counts links that leave the fluid without a crossing.
  std::vector<Cut> cuts(const Run& run, std::ptrdiff_t slot, std::size_t& missed) const;

 private:
  /// Where the link itself meets the plane of the triangle that it meets at t when moved aside; t for a grazing one.
  float wall_distance(double t, int triangle, const geometry::Vec3& link) const;
  /// A link that meets the surface at t of its length leaves it at once: it touches a corner's edge, where being moved
  /// aside brought it in (beside two edges of four, if all lie on faces of cells). A sheet has opposite normals.
  bool grazes(const geometry::Vec3& from, const geometry::Vec3& link, double t, int triangle) const;
  bool is_solid(std::ptrdiff_t slot) const;
  std::ptrdiff_t active(std::ptrdiff_t slot) const;
  bool is_fluid(std::ptrdiff_t slot) const { return kinds_.fluid.empty() || kinds_.fluid[slot] != 0; }
  /// A thin wall lies between two computed cells.
  bool parted(std::ptrdiff_t a, std::ptrdiff_t b) const;
  std::int16_t patch_near(std::ptrdiff_t slot) const;
  /// The outlet that ends a row of fluid cells, where a diagonal link out of that row's last cell crosses to the row of
  /// the live band beside it, or the other way; -1: none. Beyond the end the air goes on as before it, band and all, so
  /// what comes back along such a link is the outlet's matter and not the wall's.
  std::int16_t outlet_across(std::ptrdiff_t slot, const std::array<int, 3>& c) const;
  /// A diagonal between two active cells whose common neighbours are both solid passes through an edge of the wall.
  bool closed_corner(const Run& run, std::ptrdiff_t slot, const std::array<int, 3>& c) const;

  const Rows& rows_;
  const LinkGeometry& surface_;
  const CellKinds& kinds_;
  bool band_;
  std::unique_ptr<geometry::TriangleTree> tree_;
  std::vector<int> original_;  // triangle of the reduced mesh -> triangle of the surface
  std::vector<geometry::Vec3> shifts_;
  geometry::Vec3 aside_;  // where voxelize asked: a link in the plane of a wall runs beside it, not in it
};

}  // namespace puffin::lbm
