#pragma once
// Limited slopes of the cell averages: sharp where the field is smooth, flat at an extremum.

#include <type_traits>

namespace puffin::lbm {

enum class Scheme { upwind, minmod, van_leer, mc };

// Each law takes the differences to the low and to the high neighbour and gives the rise across the cell. All of them
// have the sign of both differences, or are 0, and are at most twice the smaller one, which is what the proof of
// monotonicity in sweep.hpp needs. V is a double, or the compiler's vector of several: for both a selection is written
// c ? x : y. Always inlined, so that code compiled for a newer processor cannot leak out of its file.

namespace detail {
template <class V>
[[gnu::always_inline]] inline V magnitude(V x) {
  if constexpr (std::is_floating_point_v<V>) {
    return __builtin_fabs(x);
  } else {
    using Bits = decltype(x < x);  // integers of the same size
    return reinterpret_cast<V>(reinterpret_cast<Bits>(x) & 0x7fffffffffffffffLL);
  }
}
template <class V>
[[gnu::always_inline]] inline V smaller(V x, V y) {
  return x < y ? x : y;
}
template <class V>
[[gnu::always_inline]] inline V larger(V x, V y) {
  return x > y ? x : y;
}
}  // namespace detail

/// First order: no slope.
struct Upwind {
  template <class V>
  [[gnu::always_inline]] static V slope(V, V) {
    return V{};
  }
};

/// The smaller difference. Source: P. L. Roe, Annu. Rev. Fluid Mech. 18, 337 (1986).
struct Minmod {
  template <class V>
  [[gnu::always_inline]] static V slope(V low, V high) {
    const V least = detail::magnitude(low) < detail::magnitude(high) ? low : high;
    return low * high > 0.0 ? least : V{};
  }
};

/// The harmonic mean. Source: B. van Leer, J. Comput. Phys. 14, 361 (1974).
struct VanLeer {
  template <class V>
  [[gnu::always_inline]] static V slope(V low, V high) {
    const V product = low * high;
    const V sum = product > 0.0 ? low + high : V{} + 1.0;
    return 2.0 * (product > 0.0 ? product : V{}) / sum;
  }
};

/// The central difference, at most twice the smaller one. Source: B. van Leer, J. Comput. Phys. 23, 276 (1977).
struct MonotonizedCentral {
  template <class V>
  [[gnu::always_inline]] static V slope(V low, V high) {
    const V least = detail::smaller(detail::magnitude(low), detail::magnitude(high));
    const V rise = detail::smaller(2.0 * least, 0.5 * detail::magnitude(low + high));
    return low * high > 0.0 ? (low > 0.0 ? rise : -rise) : V{};
  }
};

}  // namespace puffin::lbm
