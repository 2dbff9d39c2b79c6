#pragma once
// The surface that a case asks for: generated or read, checked, with its patches named.

#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/case_error.hpp"
#include "lbm/geometry/patches.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::cases {

struct Surface {
  lbm::geometry::TriangleMesh mesh;
  lbm::geometry::Patches patches;
  std::vector<lbm::geometry::Defect> defects;  // what is worth a look; fatal ones have been thrown
  double volume = 0.0;                         // [m^3]
  double area = 0.0;                           // [m^2]

  /// Area [m^2] of a patch; 0 if there is none of that name.
  double area_of(const std::string& patch) const;
  /// Per triangle: 1 if it lies in one of the patches.
  std::vector<char> marked(const std::vector<std::string>& patches) const;
};

/// Names that need no tag: a case that says "x-min" where no solid and no tag is called so means all that lies in that
/// extreme plane of the bounding box ("plane:x-min").
inline const std::vector<std::string> box_faces{"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"};

/// Generates or reads the surface, checks it, names its patches. Throws lbm::geometry::StlError or GeometryError (all
/// fatal defects in one message), GeneratorError for parameters that do not fit together.
Surface load_surface(const Case& c, bool self_intersections = false);

/// Patches through which air passes: inlets, outlets, periodic faces (with their partners).
std::vector<std::string> openings_of(const Case& c);

/// Patches of slip walls, which are exact on faces of cells alone.
std::vector<std::string> slip_patches_of(const Case& c);

}  // namespace puffin::cases
