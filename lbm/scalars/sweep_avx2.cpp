// The sweeps for avx2; the flags are set in sources.cmake.
#include "lbm/scalars/sweep_isa.inc.hpp"

namespace puffin::lbm {

SweepKernel avx2_sweep() {
#if defined(__AVX2__)
  return this_sweep();
#else
  static_cast<void>(this_sweep);
  return {};
#endif
}

}  // namespace puffin::lbm
