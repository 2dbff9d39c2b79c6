#include "lbm/wall_kernels.hpp"

namespace puffin::lbm {

#define PUFFIN_WALL_KERNELS(isa)           \
  namespace isa {                          \
  PartialKernels<float> partial_float();   \
  PartialKernels<double> partial_double(); \
  ReadKernel<float> read_float();          \
  ReadKernel<double> read_double();        \
  }
PUFFIN_WALL_KERNELS(baseline)
PUFFIN_WALL_KERNELS(avx2)
PUFFIN_WALL_KERNELS(avx512)
#undef PUFFIN_WALL_KERNELS

template <>
PartialKernels<float> select_partial_kernels<float>(Isa isa) {
  if (isa == Isa::avx512) return avx512::partial_float();
  return isa == Isa::avx2 ? avx2::partial_float() : baseline::partial_float();
}
template <>
PartialKernels<double> select_partial_kernels<double>(Isa isa) {
  if (isa == Isa::avx512) return avx512::partial_double();
  return isa == Isa::avx2 ? avx2::partial_double() : baseline::partial_double();
}
template <>
ReadKernel<float> select_read_kernel<float>(Isa isa) {
  if (isa == Isa::avx512) return avx512::read_float();
  return isa == Isa::avx2 ? avx2::read_float() : baseline::read_float();
}
template <>
ReadKernel<double> select_read_kernel<double>(Isa isa) {
  if (isa == Isa::avx512) return avx512::read_double();
  return isa == Isa::avx2 ? avx2::read_double() : baseline::read_double();
}

}  // namespace puffin::lbm
