#include "lbm/kernel.hpp"

#include <type_traits>

namespace puffin::lbm {

namespace baseline {
Kernel<float> kernel_float(Law law, bool rescale);
Kernel<double> kernel_double(Law law, bool rescale);
WallKernel<float> walls_float();
WallKernel<double> walls_double();
FluxKernel<float> fluxes_float();
FluxKernel<double> fluxes_double();
VelocityKernel<float> velocities_float();
VelocityKernel<double> velocities_double();
GradientKernel gradients();
}  // namespace baseline
namespace avx2 {
Kernel<float> kernel_float(Law law, bool rescale);
Kernel<double> kernel_double(Law law, bool rescale);
WallKernel<float> walls_float();
WallKernel<double> walls_double();
FluxKernel<float> fluxes_float();
FluxKernel<double> fluxes_double();
VelocityKernel<float> velocities_float();
VelocityKernel<double> velocities_double();
GradientKernel gradients();
}  // namespace avx2
namespace avx512 {
Kernel<float> kernel_float(Law law, bool rescale);
Kernel<double> kernel_double(Law law, bool rescale);
WallKernel<float> walls_float();
WallKernel<double> walls_double();
FluxKernel<float> fluxes_float();
FluxKernel<double> fluxes_double();
VelocityKernel<float> velocities_float();
VelocityKernel<double> velocities_double();
GradientKernel gradients();
}  // namespace avx512

template <class T>
Kernel<T> select_kernel(Law law, bool rescale, Isa isa) {
  if constexpr (std::is_same_v<T, float>) {
    if (isa == Isa::avx512) return avx512::kernel_float(law, rescale);
    return isa == Isa::avx2 ? avx2::kernel_float(law, rescale) : baseline::kernel_float(law, rescale);
  } else {
    if (isa == Isa::avx512) return avx512::kernel_double(law, rescale);
    return isa == Isa::avx2 ? avx2::kernel_double(law, rescale) : baseline::kernel_double(law, rescale);
  }
}

template <class T>
WallKernel<T> select_wall_kernel(Isa isa) {
  if constexpr (std::is_same_v<T, float>) {
    if (isa == Isa::avx512) return avx512::walls_float();
    return isa == Isa::avx2 ? avx2::walls_float() : baseline::walls_float();
  } else {
    if (isa == Isa::avx512) return avx512::walls_double();
    return isa == Isa::avx2 ? avx2::walls_double() : baseline::walls_double();
  }
}

template <class T>
FluxKernel<T> select_flux_kernel(Isa isa) {
  if constexpr (std::is_same_v<T, float>) {
    if (isa == Isa::avx512) return avx512::fluxes_float();
    return isa == Isa::avx2 ? avx2::fluxes_float() : baseline::fluxes_float();
  } else {
    if (isa == Isa::avx512) return avx512::fluxes_double();
    return isa == Isa::avx2 ? avx2::fluxes_double() : baseline::fluxes_double();
  }
}

template <class T>
VelocityKernel<T> select_velocity_kernel(Isa isa) {
  if constexpr (std::is_same_v<T, float>) {
    if (isa == Isa::avx512) return avx512::velocities_float();
    return isa == Isa::avx2 ? avx2::velocities_float() : baseline::velocities_float();
  } else {
    if (isa == Isa::avx512) return avx512::velocities_double();
    return isa == Isa::avx2 ? avx2::velocities_double() : baseline::velocities_double();
  }
}

GradientKernel select_gradient_kernel(Isa isa) {
  if (isa == Isa::avx512) return avx512::gradients();
  return isa == Isa::avx2 ? avx2::gradients() : baseline::gradients();
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
