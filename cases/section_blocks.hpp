#pragma once
// The cells of a geometry in blocks, with the faces that are open between them: what ideal flow is solved on.

#include <array>
#include <cstdint>
#include <vector>

#include "cases/case.hpp"
#include "cases/surface.hpp"
#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/geometry/voxels.hpp"

namespace puffin::cases {

struct Faces {
  std::int32_t from = 0, to = 0;  // blocks, one behind the other along an axis
  double count = 0.0;             // open faces between them
};

/// Blocks of b x b x b cells, what a wall parts inside one being two. Lengths in cells, so areas are numbers of faces;
/// speeds in parts of the fastest inlet's.
struct Blocks {
  int edge = 1;                                             // b
  std::vector<double> volume;                               // by block: fluid cells
  std::array<std::vector<Faces>, 3> faces;                  // along each axis
  std::array<std::vector<double>, 3> open_faces, entering;  // by axis and block: of openings; the inlets' flow
  std::vector<double> to_outlet;                            // conductance to phi = 0
};

/// The blocks between the velocity inlets, each with its largest mean speed until stop.time, and the pressure outlets;
/// none if there are no such inlets or outlets. Cells from which no outlet is reached take no part.
Blocks blocks_of(const Case& c, const Surface& surface, const lbm::geometry::TriangleTree& tree,
                 const lbm::geometry::Voxels& voxels);

}  // namespace puffin::cases
