// The sweeps for avx512; the flags are set in sources.cmake.
#include "lbm/scalars/sweep_isa.inc.hpp"

namespace puffin::lbm {

SweepKernel avx512_sweep() {
#if defined(__AVX512DQ__)
  return {outgoing, update, limit};
#else
  static_cast<void>(outgoing), static_cast<void>(update), static_cast<void>(limit);
  return {};
#endif
}

}  // namespace puffin::lbm
