#pragma once
// How much faster than at its inlets the air is where its passage is narrowest.

#include "cases/case.hpp"
#include "cases/surface.hpp"
#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/geometry/voxels.hpp"

namespace puffin::cases {

/// The largest section-mean speed behind the velocity inlets over the largest at one: 1 for ducts and wherever it is
/// less than a tenth more, or nothing can be said (no velocity inlet or no outlet).
///
/// The sections are the surfaces of equal potential phi of ideal flow from all inlets (each with its largest mean speed
/// until stop.time) to the pressure outlets, so they lie across the passage whichever way it turns or branches:
///   div grad phi = 0,   mean speed over a section = integral of |grad phi| dA / integral of dA,
/// and with both integrals gathered between phi and phi + d(phi) over volumes, where |grad phi| dA dn = dA d(phi),
///   mean speed = sum of V |grad phi|^2 / sum of V |grad phi|.
/// Solved with finite volumes on at most some 30,000 blocks of b x b x b cells, of which those that walls part inside
/// are two; between blocks the cells' faces that are open count: a straight duct along the axes is exact, a section of
/// n cells is found to about 1/n.
double section_ratio(const Case& c, const Surface& surface, const lbm::geometry::TriangleTree& tree,
                     const lbm::geometry::Voxels& voxels);

}  // namespace puffin::cases
