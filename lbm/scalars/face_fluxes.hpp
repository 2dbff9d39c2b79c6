#pragma once
// The air's mass fluxes through the faces of the cells: what carries a scalar.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace puffin::lbm {

/// A face in an opening whose flux another face of its cell takes: closed, but no wall that could absorb.
inline constexpr std::uint8_t passed_over = 4;

/// Face d of slot s lies between s and its neighbour in +d (x: s+1; y, z: through Run::shift). Values are held at every
/// stored slot, so also for the low faces of the first active cells (there s is a ghost).
/// Lattice units: mass of air (reference density 1) through the face in one air step, positive in +d.
struct FaceFluxes {
  std::array<std::vector<double>, 3> mass;   // [d][slot]
  std::array<std::vector<double>, 3> drift;  // [d][slot] what the scalars drift through the air, as mass of the air
                                             // that holds them; moves no air; empty: none
  std::array<std::vector<std::uint8_t>, 3> open;  // [d][slot] 0: wall (no flux, no diffusion), 1: open, 2: opening of
                                                  // the domain (inlet, outlet), one side is a ghost; or `passed_over`
  std::array<std::vector<double>, 3> eddy;        // [d][slot] diffusivity on top of each scalar's own [dx^2 per air
                                                  // step], >= 0; empty: none
  std::vector<double> density;                    // [slot] air density at the start of the interval, lattice units
  /// Walls that take what drifts into them (wall_sinks.hpp): of what a cell holds, `rate` in one air step.
  struct Sink {
    std::ptrdiff_t slot = 0;
    double rate = 0.0;
  };
  std::vector<Sink> sinks;
};

}  // namespace puffin::lbm
