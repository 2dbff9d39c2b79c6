#pragma once
// Limited slopes of the cell averages: sharp where the field is smooth, flat at an extremum.

namespace puffin::lbm {

enum class Scheme { upwind, minmod, van_leer, mc };

// Each law takes the differences to the low and to the high neighbour and gives the rise across the cell. All of them
// have the sign of both differences, or are 0, and are at most twice the smaller one, which is what the proof of
// monotonicity in sweep.hpp needs. Written as selections, so that the compiler can do several cells at once; always
// inlined, so that code compiled for a newer processor cannot leak out of its file.

namespace detail {
[[gnu::always_inline]] inline double magnitude(double x) { return __builtin_fabs(x); }
[[gnu::always_inline]] inline double smaller(double x, double y) { return x < y ? x : y; }
[[gnu::always_inline]] inline double larger(double x, double y) { return x > y ? x : y; }
}  // namespace detail

/// First order: no slope.
struct Upwind {
  [[gnu::always_inline]] static double slope(double, double) { return 0.0; }
};

/// The smaller difference. Source: P. L. Roe, Annu. Rev. Fluid Mech. 18, 337 (1986).
struct Minmod {
  [[gnu::always_inline]] static double slope(double low, double high) {
    const double least = detail::magnitude(low) < detail::magnitude(high) ? low : high;
    return low * high > 0.0 ? least : 0.0;
  }
};

/// The harmonic mean. Source: B. van Leer, J. Comput. Phys. 14, 361 (1974).
struct VanLeer {
  [[gnu::always_inline]] static double slope(double low, double high) {
    const double product = low * high;
    const double sum = product > 0.0 ? low + high : 1.0;
    return 2.0 * (product > 0.0 ? product : 0.0) / sum;
  }
};

/// The central difference, at most twice the smaller one. Source: B. van Leer, J. Comput. Phys. 23, 276 (1977).
struct MonotonizedCentral {
  [[gnu::always_inline]] static double slope(double low, double high) {
    const double least = detail::smaller(detail::magnitude(low), detail::magnitude(high));
    const double rise = detail::smaller(2.0 * least, 0.5 * detail::magnitude(low + high));
    return low * high > 0.0 ? (low > 0.0 ? rise : -rise) : 0.0;
  }
};

}  // namespace puffin::lbm
