// Whole registers from narrower numbers, for the units that are compiled for one processor each (included inside their
// anonymous namespaces, after <immintrin.h>). Spelt out because gcc 12 does such conversions number by number.

template <class U, int N>
struct Register {
  using type [[gnu::vector_size(sizeof(U) * N)]] = U;
};
template <class U, int N>
using Lanes = typename Register<U, N>::type;

/// N small unsigned numbers as int.
template <int N, class U>
[[gnu::always_inline]] inline Lanes<int, N> widen(const U* p) {
  static_assert(sizeof(U) <= 2);
  [[maybe_unused]] constexpr bool bytes = sizeof(U) == 1;
  [[maybe_unused]] const auto* half = reinterpret_cast<const __m128i*>(p);
#ifdef __AVX512F__
  if constexpr (N == 16)
    return reinterpret_cast<Lanes<int, N>>(
        bytes ? _mm512_cvtepu8_epi32(_mm_loadu_si128(half))
              : _mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))));
#endif
#ifdef __AVX2__
  if constexpr (N == 8)
    return reinterpret_cast<Lanes<int, N>>(bytes ? _mm256_cvtepu8_epi32(_mm_loadl_epi64(half))
                                                 : _mm256_cvtepu16_epi32(_mm_loadu_si128(half)));
  if constexpr (N == 4 && bytes) {
    int four;
    __builtin_memcpy(&four, p, sizeof four);
    return reinterpret_cast<Lanes<int, N>>(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(four)));
  }
  if constexpr (N == 4) return reinterpret_cast<Lanes<int, N>>(_mm_cvtepu16_epi32(_mm_loadl_epi64(half)));
#endif
  Lanes<int, N> v;
  for (int i = 0; i < N; ++i) v[i] = p[i];
  return v;
}

/// The same numbers as double.
template <int N>
[[gnu::always_inline]] inline Lanes<double, N> to_doubles(const Lanes<int, N>& v) {
#ifdef __AVX512F__
  if constexpr (N == 8) return _mm512_cvtepi32_pd(reinterpret_cast<__m256i>(v));
#endif
#ifdef __AVX2__
  if constexpr (N == 4) return _mm256_cvtepi32_pd(reinterpret_cast<__m128i>(v));
#endif
  Lanes<double, N> d;
  for (int i = 0; i < N; ++i) d[i] = v[i];
  return d;
}

/// Numbers as double, to memory.
template <int N>
[[gnu::always_inline]] inline void store_doubles(const Lanes<float, N>& v, double* to) {
#ifdef __AVX512F__
  if constexpr (N == 16) {
    const __m512d pairs = reinterpret_cast<__m512d>(v);
    _mm512_storeu_pd(to, _mm512_cvtps_pd(_mm256_castpd_ps(_mm512_castpd512_pd256(pairs))));
    _mm512_storeu_pd(to + 8, _mm512_cvtps_pd(_mm256_castpd_ps(_mm512_extractf64x4_pd(pairs, 1))));
    return;
  }
#endif
  for (int i = 0; i < N; ++i) to[i] = v[i];
}
template <int N>
[[gnu::always_inline]] inline void store_doubles(const Lanes<double, N>& v, double* to) {
  __builtin_memcpy(to, &v, sizeof v);
}
