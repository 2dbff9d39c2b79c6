#pragma once
// Limited slopes of the cell averages: sharp where the field is smooth, flat at an extremum.

#include <type_traits>

namespace puffin::lbm {

enum class Scheme { upwind, minmod, van_leer, mc };

// Each law takes the differences to the low and to the high neighbour and gives the rise across the cell. All of them
// have the sign of both differences, or are 0, and are at most twice the smaller one, which is what the proof of
// monotonicity in sweep.hpp needs. Differences are never multiplied with each other: the product of two small ones
// would be 0 in float. V is a float or a double, or the compiler's vector of several: for all of them a selection is
// written c ? x : y. Always inlined, so that code compiled for a newer processor cannot leak out of its file.

namespace detail {
/// The number x in every lane.
template <class V>
[[gnu::always_inline]] inline V spread(double x) {
  if constexpr (std::is_floating_point_v<V>)
    return static_cast<V>(x);
  else
    return V{} + static_cast<std::remove_cvref_t<decltype(V{}[0])>>(x);
}
template <class V>
[[gnu::always_inline]] inline V magnitude(V x) {
  if constexpr (std::is_floating_point_v<V>) {
    return static_cast<V>(__builtin_fabs(x));
  } else {
    using Bits = decltype(x < x);  // integers of the same size
    constexpr auto all_but_sign = sizeof(V{}[0]) == 4 ? 0x7fffffffLL : 0x7fffffffffffffffLL;
    using Bit = std::remove_cvref_t<decltype(Bits{}[0])>;
    return reinterpret_cast<V>(reinterpret_cast<Bits>(x) & static_cast<Bit>(all_but_sign));
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
/// Two numbers that are not 0 have the same sign.
template <class V>
[[gnu::always_inline]] inline auto alike(V x, V y) {
  const V none{};
  return (x > none) == (y > none);
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
    const V least = detail::magnitude(low) < detail::magnitude(high) ? low : high;  // 0 if one of them is
    return detail::alike(low, high) ? least : V{};
  }
};

/// The harmonic mean. Source: B. van Leer, J. Comput. Phys. 14, 361 (1974).
struct VanLeer {
  template <class V>
  [[gnu::always_inline]] static V slope(V low, V high) {
    const V smaller = detail::magnitude(low) < detail::magnitude(high) ? low : high;
    const V greater = detail::magnitude(low) < detail::magnitude(high) ? high : low;
    const V sum = smaller != V{} ? low + high : detail::spread<V>(1.0);
    return detail::alike(low, high) ? detail::spread<V>(2.0) * smaller * (greater / sum) : V{};
  }
};

/// The central difference, at most twice the smaller one. Source: B. van Leer, J. Comput. Phys. 23, 276 (1977).
struct MonotonizedCentral {
  template <class V>
  [[gnu::always_inline]] static V slope(V low, V high) {
    const V least = detail::smaller(detail::magnitude(low), detail::magnitude(high));
    const V rise =
        detail::smaller(detail::spread<V>(2.0) * least, detail::spread<V>(0.5) * detail::magnitude(low + high));
    return detail::alike(low, high) ? (low > V{} ? rise : -rise) : V{};
  }
};

}  // namespace puffin::lbm
