// The sweeps for avx2; the flags are set in sources.cmake.
#include "lbm/scalars/sweep_isa.inc.hpp"

namespace puffin::lbm {

SweepKernel avx2_sweep() {
#if defined(__AVX2__)
  return {outgoing, update, limit};
#else
  static_cast<void>(outgoing), static_cast<void>(update), static_cast<void>(limit);
  return {};
#endif
}

}  // namespace puffin::lbm
