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

/// Generates or reads the surface, checks it, names its patches. Throws lbm::geometry::StlError or GeometryError (all
/// fatal defects in one message), GeneratorError for parameters that do not fit together.
Surface load_surface(const Case& c, bool self_intersections = false);

/// Names of patches in the case that the surface does not have, each with the likeliest. What read_case could not know
/// for an STL file.
std::vector<Problem> unknown_patches(const Case& c, const lbm::geometry::Patches& patches);

/// Patches through which air passes: inlets, outlets, periodic faces (with their partners).
std::vector<std::string> openings_of(const Case& c);

}  // namespace puffin::cases
