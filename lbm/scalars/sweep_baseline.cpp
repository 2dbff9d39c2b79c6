#include "lbm/kernel.hpp"
#include "lbm/scalars/sweep_isa.inc.hpp"

namespace puffin::lbm {

SweepKernel baseline_sweep() { return this_sweep(); }

SweepKernel select_sweep() {
#if defined(__x86_64__)
  if (detect_isa() == Isa::avx512 && avx512_sweep().limit) return avx512_sweep();
  if (detect_isa() != Isa::baseline && avx2_sweep().limit) return avx2_sweep();
#endif
  return baseline_sweep();
}

}  // namespace puffin::lbm
