#pragma once
// How fast this machine is, measured in a second.

#include "cases/case.hpp"

namespace puffin::tools {

struct Calibration {
  double updates_per_second = 0.0;  // cells, bare lattice
  int threads = 0;
};

/// Collides and streams a periodic box of 64^3 cells with the case's operator, precision and threads.
Calibration calibrate(const cases::Numerics& n);

/// Bytes a second of a triad over arrays beyond the caches: the bound of the lattice.
double memory_bandwidth();

}  // namespace puffin::tools
