#pragma once
// Inverse and square root of 16 floats from the processor's estimates (14 bits) and one Newton step each: right to
// 2^-23, in 3 and 5 cycles of the multipliers instead of 10 and 12 of the divider. For kernel_avx512.cpp alone.

#include <immintrin.h>

#include <experimental/simd>
#include <limits>

#include "lbm/collision.hpp"

namespace puffin::lbm {

template <>
struct Arithmetic<std::experimental::native_simd<float>> {
  using Pack = std::experimental::native_simd<float>;
  static_assert(Pack::size() == 16);

  /// y (2 - x y) with y the estimate of 1/x.
  [[gnu::always_inline]] static inline Pack inverse(const Pack& x) {
    const __m512 v = static_cast<__m512>(x), y = _mm512_rcp14_ps(v);
    return Pack(_mm512_fmadd_ps(y, _mm512_fnmadd_ps(v, y, _mm512_set1_ps(1.0F)), y));
  }
  /// s + y (x - s^2)/2 with y the estimate of 1/sqrt(x) and s = x y. x > 0.
  [[gnu::always_inline]] static inline Pack positive_root(const Pack& x) { return with(x, static_cast<__m512>(x)); }
  /// The same, and zero for zero.
  [[gnu::always_inline]] static inline Pack root(const Pack& x) {
    return with(x, _mm512_max_ps(static_cast<__m512>(x), _mm512_set1_ps(std::numeric_limits<float>::min())));
  }

 private:
  [[gnu::always_inline]] static inline Pack with(const Pack& x, const __m512& not_zero) {
    const __m512 v = static_cast<__m512>(x), y = _mm512_rsqrt14_ps(not_zero);
    const __m512 s = _mm512_mul_ps(v, y), half = _mm512_mul_ps(y, _mm512_set1_ps(0.5F));
    return Pack(_mm512_fmadd_ps(half, _mm512_fnmadd_ps(s, s, v), s));
  }
};

}  // namespace puffin::lbm
