// The body of one flux-kernel unit; included once by each flux_kernels_<isa>.cpp, which sets PUFFIN_ISA. As in
// kernel_isa.inc.hpp, nothing but templates over this unit's own SIMD pack is instantiated.

#include <immintrin.h>

#include <array>
#include <cstdint>
#include <experimental/simd>

#include "lbm/kernel.hpp"

namespace puffin::lbm::PUFFIN_ISA {
namespace {

#include "lbm/widen.inc.hpp"

namespace stdx = std::experimental;
template <class T>
using Pack = stdx::native_simd<T>;
template <class T>
constexpr int width = static_cast<int>(Pack<T>::size());

/// Direction of D3Q19 along +-d and +-b (b = -1: along d alone).
constexpr int direction_of(int d, int sd, int b, int sb) {
  for (int i = 0; i < 19; ++i) {
    bool same = true;
    for (int a = 0; a < 3; ++a) same = same && d3q19::velocity[i][a] == (a == d ? sd : (a == b ? sb : 0));
    if (same) return i;
  }
  return 0;
}

/// The eight diagonal links that go half through the high face of a cell in direction D: link j leaves the cell, or the
/// one beside it, in direction `out`.
struct Diagonal {
  int out;
  int beside;  // 0: from this cell to the far corner; else the direction of the cell beside, whose link ends ahead
};
template <int D>
constexpr std::array<Diagonal, 8> diagonals() {
  std::array<Diagonal, 8> all{};
  int k = 0;
  for (int step = 1; step <= 2; ++step)
    for (const int sb : {-1, 1}) {
      const int b = (D + step) % 3;
      all[k++] = {direction_of(D, 1, b, sb), 0};
      all[k++] = {direction_of(D, 1, b, -sb), direction_of(b, sb, -1, 0)};
    }
  return all;
}

template <class T>
[[gnu::always_inline]] inline Pack<T> pack_of(const Lanes<T, width<T>>& v) {
  Pack<T> p;
  __builtin_memcpy(static_cast<void*>(&p), &v, sizeof v);
  return p;
}
/// Small numbers as a pack.
template <class T>
[[gnu::always_inline]] inline Pack<T> pack_of_small(const Lanes<int, width<T>>& v) {
  if constexpr (sizeof(T) == sizeof(int))
    return pack_of<T>(__builtin_convertvector(v, Lanes<T, width<T>>));
  else
    return pack_of<T>(to_doubles<width<T>>(v));
}

template <class T>
[[gnu::always_inline]] inline Pack<T> load(const T* p) {
  return Pack<T>(p, stdx::element_aligned);
}

/// Calls pack(n, cells) until all `count` cells are done: lanes [0, cells) of a pack at n. The last pack of a run
/// overlaps the one before; a run shorter than a pack reads beyond its end, which Rows::padding allows.
template <class T, class Body>
[[gnu::always_inline]] inline void for_packs(int count, const Body& pack) {
  if (count < width<T>) return pack(0, count);
  for (int n = 0; n + width<T> <= count; n += width<T>) pack(n, width<T>);
  if (count % width<T> != 0) pack(count - width<T>, width<T>);
}

/// The first `cells` lanes as doubles, each with `more` on top.
template <class T>
[[gnu::always_inline]] inline void store(const Pack<T>& v, int cells, double* to, double more = 0.0) {
  Lanes<T, width<T>> plain;
  __builtin_memcpy(&plain, &v, sizeof plain);
  if (cells == width<T>) return store_doubles<width<T>>(plain, to, more);
  for (int l = 0; l < cells; ++l) to[l] = more + plain[l];
}

/// The code of a face all of whose eight diagonal links go half through it.
constexpr int every_link_half = 0x5555;

template <class T>
[[gnu::always_inline]] inline bool all_equal(const Lanes<int, width<T>>& v, int wanted) {
#ifdef __AVX512F__
  if constexpr (width<T> == 16)
    return _mm512_cmpneq_epi32_mask(reinterpret_cast<__m512i>(v), _mm512_set1_epi32(wanted)) == 0;
#endif
#ifdef __AVX2__
  if constexpr (width<T> == 8) {
    const __m256i different = _mm256_xor_si256(reinterpret_cast<__m256i>(v), _mm256_set1_epi32(wanted));
    return _mm256_testz_si256(different, different) != 0;
  }
#endif
  int different = 0;
  for (int l = 0; l < width<T>; ++l) different |= v[l] ^ wanted;
  return different == 0;
}

template <class T, int D>
void face_fluxes_of_run(const FluxInput<T>& in, const Run& run) {
  // m(x -> y, i) = arrived_i(y) - arrived_o(x) = +-(f_i[slot y] - f_o[slot x]); + before an even step, - before an odd.
  const auto offset = [&](int i) {
    const auto& c = d3q19::velocity[i];
    return c[0] + run.shift[c[1] + 1][c[2] + 1];
  };
  const T sign = in.next == Parity::even ? T(1) : T(-1);
  constexpr int along = direction_of(D, 1, -1, 0);
  const T* axis_to = in.f + along * in.stride + run.first + offset(along);
  const T* axis_from = in.f + d3q19::opposite(along) * in.stride + run.first;
  const T* to[8];
  const T* from[8];
  constexpr std::array<Diagonal, 8> links = diagonals<D>();
#pragma GCC unroll 8
  for (int j = 0; j < 8; ++j) {
    const auto [out, beside] = links[j];
    to[j] = in.f + out * in.stride + run.first + offset(beside == 0 ? out : along);
    from[j] = in.f + d3q19::opposite(out) * in.stride + run.first + (beside == 0 ? 0 : offset(beside));
  }
  const std::uint16_t* routes = in.routes[D] + run.first;
  const std::uint8_t* open = in.open[D] + run.first;
  double* mass = in.mass[D] + run.first;
  for_packs<T>(
      run.count, [&](int n, int cells) __attribute__((always_inline)) {
        Pack<T> sum = load(axis_to + n) - load(axis_from + n);
        const auto halves = widen<width<T>>(routes + n);  // of each link, 2 bits each
        if (all_equal<T>(halves, every_link_half)) {      // away from walls
#pragma GCC unroll 8
          for (int j = 0; j < 8; ++j) sum = sum + Pack<T>(T(0.5)) * (load(to[j] + n) - load(from[j] + n));
        } else {
#pragma GCC unroll 8
          for (int j = 0; j < 8; ++j) {
            const Pack<T> share = pack_of_small<T>((halves >> (2 * j)) & 3);
            sum = sum + Pack<T>(T(0.5)) * share * (load(to[j] + n) - load(from[j] + n));
          }
        }
        const auto passes = widen<width<T>>(open + n) & 1;  // 0 where closed or an opening
        store<T>(sum * Pack<T>(sign) * pack_of_small<T>(passes), cells, mass + n);
      });
}

template <class T>
void density_of_run(const FluxInput<T>& in, const Run& run) {
  const T* arrived[19];
  for (int i = 0; i < 19; ++i) {
    const int o = d3q19::opposite(i);
    const auto& b = d3q19::velocity[o];
    arrived[i] = in.next == Parity::even ? in.f + i * in.stride + run.first
                                         : in.f + o * in.stride + run.first + b[0] + run.shift[b[1] + 1][b[2] + 1];
  }
  double* density = in.density + run.first;
  for_packs<T>(
      run.count, [&](int n, int cells) __attribute__((always_inline)) {
        Pack<T> sum = load(arrived[0] + n);
        for (int i = 1; i < 19; ++i) sum = sum + load(arrived[i] + n);
        store<T>(sum, cells, density + n, 1.0);
      });
}

template <class T>
void fluxes(const FluxInput<T>& in) {
  for (int r = in.first_run; r < in.last_run; ++r) {
    const Run& run = in.runs[r];
    face_fluxes_of_run<T, 0>(in, run);
    face_fluxes_of_run<T, 1>(in, run);
    face_fluxes_of_run<T, 2>(in, run);
    density_of_run(in, run);
  }
}

}  // namespace

FluxKernel<float> fluxes_float() { return &fluxes<float>; }
FluxKernel<double> fluxes_double() { return &fluxes<double>; }

}  // namespace puffin::lbm::PUFFIN_ISA
