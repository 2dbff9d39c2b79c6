#include "lbm/kernel.hpp"

#include <type_traits>

namespace puffin::lbm {

// The same functions stand in the units of every instruction set.
namespace baseline {
#include "lbm/kernel_units.inc.hpp"
}
namespace avx2 {
#include "lbm/kernel_units.inc.hpp"
}
namespace avx512 {
#include "lbm/kernel_units.inc.hpp"
}

namespace {

template <class Unit>
Unit of(Isa isa, Unit base, Unit avx2, Unit avx512) {
  if (isa == Isa::avx512) return avx512;
  return isa == Isa::avx2 ? avx2 : base;
}

}  // namespace

template <class T>
Kernel<T> select_kernel(Law law, bool rescale, Isa isa) {
  if constexpr (std::is_same_v<T, float>)
    return of(isa, baseline::kernel_float, avx2::kernel_float, avx512::kernel_float)(law, rescale);
  else
    return of(isa, baseline::kernel_double, avx2::kernel_double, avx512::kernel_double)(law, rescale);
}

template <class T>
WallKernel<T> select_wall_kernel(Isa isa) {
  if constexpr (std::is_same_v<T, float>)
    return of(isa, baseline::walls_float, avx2::walls_float, avx512::walls_float)();
  else
    return of(isa, baseline::walls_double, avx2::walls_double, avx512::walls_double)();
}

template <class T>
FluxKernel<T> select_flux_kernel(Isa isa) {
  if constexpr (std::is_same_v<T, float>)
    return of(isa, baseline::fluxes_float, avx2::fluxes_float, avx512::fluxes_float)();
  else
    return of(isa, baseline::fluxes_double, avx2::fluxes_double, avx512::fluxes_double)();
}

template <class T>
VelocityKernel<T> select_velocity_kernel(Isa isa) {
  if constexpr (std::is_same_v<T, float>)
    return of(isa, baseline::velocities_float, avx2::velocities_float, avx512::velocities_float)();
  else
    return of(isa, baseline::velocities_double, avx2::velocities_double, avx512::velocities_double)();
}

GradientKernel select_gradient_kernel(Isa isa) {
  return of(isa, baseline::gradients, avx2::gradients, avx512::gradients)();
}

template VelocityKernel<float> select_velocity_kernel<float>(Isa);
template VelocityKernel<double> select_velocity_kernel<double>(Isa);
template FluxKernel<float> select_flux_kernel<float>(Isa);
template FluxKernel<double> select_flux_kernel<double>(Isa);
template WallKernel<float> select_wall_kernel<float>(Isa);
template WallKernel<double> select_wall_kernel<double>(Isa);
template Kernel<float> select_kernel<float>(Law, bool, Isa);
template Kernel<double> select_kernel<double>(Law, bool, Isa);

}  // namespace puffin::lbm
