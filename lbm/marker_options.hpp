#pragma once
// How markers of an immersed boundary are placed; see markers.hpp.

namespace puffin::lbm {

struct MarkerOptions {
  MarkerOptions();                                  // what docs/decisions/0007-walls.md found
  double spacing = 0.0;                             // [cells] between markers, about
  double retraction = 0.0;                          // [cells] behind the surface
  double band() const { return retraction + 1.5; }  // depth of the live band that holds the kernels [cells]
};

}  // namespace puffin::lbm
