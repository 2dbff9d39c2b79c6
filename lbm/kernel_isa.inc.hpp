// The body of one kernel translation unit; included once by each kernel_<isa>.cpp, which sets PUFFIN_ISA to its name.
// Only raw memory is touched here and nothing but templates over this unit's own SIMD pack is instantiated, so code
// compiled for a newer processor cannot leak into the rest of the program.

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>

#include "lbm/flush_to_zero.hpp"
#include "lbm/kernel.hpp"
#include "lbm/vreman.hpp"

namespace puffin::lbm::PUFFIN_ISA {
namespace {

namespace stdx = std::experimental;

template <class T>
using Pack = stdx::native_simd<T>;

template <class T>
inline Pack<T> load_float(const float* p) {
  Pack<T> v;
  v.copy_from(p, stdx::element_aligned);
  return v;
}

/// Whether a masked store costs no more than a plain one.
#ifdef __AVX512F__
constexpr bool masked = true;
#include "lbm/lanes_avx512.inc.hpp"
#else
constexpr bool masked = false;
#endif

/// The same for the lanes of a pack that a mask names.
template <class P>
[[gnu::always_inline]] inline P only(const P& v, const typename P::mask_type& lanes) {
  P kept(typename P::value_type(0));
  where(lanes, kept) = v;
  return kept;
}
template <class P>
[[gnu::always_inline]] inline int count_below(const P& v, typename P::value_type limit,
                                              const typename P::mask_type& lanes) {
  const auto below = v < P(limit);
  return stdx::any_of(below) ? stdx::popcount(below && lanes) : 0;
}
template <class P>
[[gnu::always_inline]] inline bool all_below(const P& v, typename P::value_type limit,
                                             const typename P::mask_type& lanes) {
  const auto not_below = !(v < P(limit));
  return !stdx::any_of(not_below) || !stdx::any_of(not_below && lanes);
}

/// Minimum and maximum as the processor does them: the second operand where either is not a number.
template <class P>
[[gnu::always_inline]] inline P minimum(const P& a, const P& b) {
  return stdx::min(b, a);
}
template <class P>
[[gnu::always_inline]] inline P maximum(const P& a, const P& b) {
  return stdx::max(b, a);
}

// The parts of this unit, in this namespace.
#include "lbm/kernel_gradients.inc.hpp"
#include "lbm/kernel_pack.inc.hpp"
#include "lbm/kernel_sweep.inc.hpp"
#include "lbm/kernel_walls.inc.hpp"

}  // namespace

// One unit per instruction set includes this file, each in its own namespace.
WallKernel<float> walls_float() { return &walls<float>; }
WallKernel<double> walls_double() { return &walls<double>; }
VelocityKernel<float> velocities_float() { return &velocities<float>; }
VelocityKernel<double> velocities_double() { return &velocities<double>; }
GradientKernel gradients() { return &find_gradients; }
template <class T>
Kernel<T> kernel_of(Law law, bool rescale) {
  if (rescale) return &sweep<T, Rr3Rescaled>;
  switch (law) {
    case Law::bgk:
      return &sweep<T, Bgk>;
    case Law::trt:
      return &sweep<T, Trt>;
    case Law::central_moments:
      return &sweep<T, CentralMoments>;
    case Law::hrr:
      return &sweep<T, Hrr>;
    case Law::rr3:
      break;
  }
  return &sweep<T, Rr3>;
}
Kernel<float> kernel_float(Law law, bool rescale) { return kernel_of<float>(law, rescale); }
Kernel<double> kernel_double(Law law, bool rescale) { return kernel_of<double>(law, rescale); }

}  // namespace puffin::lbm::PUFFIN_ISA
