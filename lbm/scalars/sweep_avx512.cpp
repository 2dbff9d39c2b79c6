// The sweeps for avx512; the flags are set in sources.cmake.
#include "lbm/scalars/sweep_isa.inc.hpp"

namespace puffin::lbm {

SweepKernel avx512_sweep() {
#if defined(__AVX512DQ__)
  return this_sweep();
#else
  static_cast<void>(this_sweep);
  return {};
#endif
}

}  // namespace puffin::lbm
