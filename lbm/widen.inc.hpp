// Whole registers from narrower numbers, for the units that are compiled for one processor each (included inside their
// anonymous namespaces, after <immintrin.h>). Spelt out because gcc 12 does such conversions number by number.

// What includes it has <type_traits>, <cstdint>.
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

/// Numbers as double, each with `more` on top, to memory.
template <int N>
[[gnu::always_inline]] inline void store_doubles(const Lanes<float, N>& v, double* to, double more) {
#ifdef __AVX512F__
  if constexpr (N == 16) {
    const __m512d pairs = reinterpret_cast<__m512d>(v), top = _mm512_set1_pd(more);
    const __m256 low = _mm256_castpd_ps(_mm512_castpd512_pd256(pairs));
    const __m256 high = _mm256_castpd_ps(_mm512_extractf64x4_pd(pairs, 1));
    _mm512_storeu_pd(to, _mm512_add_pd(top, _mm512_cvtps_pd(low)));
    _mm512_storeu_pd(to + 8, _mm512_add_pd(top, _mm512_cvtps_pd(high)));
    return;
  }
#endif
  for (int i = 0; i < N; ++i) to[i] = more + v[i];
}
template <int N>
[[gnu::always_inline]] inline void store_doubles(const Lanes<double, N>& v, double* to, double more) {
  const Lanes<double, N> raised = more + v;
  __builtin_memcpy(to, &raised, sizeof raised);
}

/// N small numbers as T.
template <class T, int N>
[[gnu::always_inline]] inline Lanes<T, N> to_numbers(const Lanes<int, N>& v) {
  if constexpr (sizeof(T) == sizeof(int))
    return __builtin_convertvector(v, Lanes<T, N>);
  else
    return to_doubles<N>(v);
}

/// N numbers from memory as T, rounded where T is shorter.
template <class T, int N, class From>
[[gnu::always_inline]] inline Lanes<T, N> load_as(const From* p) {
  Lanes<T, N> v;
  if constexpr (std::is_same_v<T, From>) {
    __builtin_memcpy(&v, p, sizeof v);
    return v;
  }
  [[maybe_unused]] constexpr bool shorter = sizeof(T)<sizeof(From), longer = sizeof(T)> sizeof(From);
#ifdef __AVX512F__
  if constexpr (shorter && N == 16) {
    const __m256d low = _mm256_castps_pd(_mm512_cvtpd_ps(_mm512_loadu_pd(p)));
    const __m256d high = _mm256_castps_pd(_mm512_cvtpd_ps(_mm512_loadu_pd(p + 8)));
    return reinterpret_cast<Lanes<T, N>>(_mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1));
  }
  if constexpr (longer && N == 8) return reinterpret_cast<Lanes<T, N>>(_mm512_cvtps_pd(_mm256_loadu_ps(p)));
#endif
#ifdef __AVX2__
  if constexpr (shorter && N == 8)
    return reinterpret_cast<Lanes<T, N>>(
        _mm256_set_m128(_mm256_cvtpd_ps(_mm256_loadu_pd(p + 4)), _mm256_cvtpd_ps(_mm256_loadu_pd(p))));
  if constexpr (longer && N == 4) return reinterpret_cast<Lanes<T, N>>(_mm256_cvtps_pd(_mm_loadu_ps(p)));
#endif
  for (int i = 0; i < N; ++i) v[i] = static_cast<T>(p[i]);
  return v;
}

/// The first `count` of N doubles from memory. The others are not to be used: zero with AVX-512, whose long packs may
/// reach into cells that another thread writes, else what lies there.
template <class T, int N>
[[gnu::always_inline]] inline Lanes<T, N> load_first(const double* p, [[maybe_unused]] int count) {
#ifdef __AVX512F__
  const auto mine = static_cast<std::uint32_t>((1ULL << count) - 1U);
  if constexpr (sizeof(T) == sizeof(double) && N == 8)
    return reinterpret_cast<Lanes<T, N>>(_mm512_maskz_loadu_pd(static_cast<__mmask8>(mine), p));
#endif
  return load_as<T, N>(p);
}

/// The first `count` of N numbers to memory, rounded where it holds shorter ones.
template <class T, int N, class To>
[[gnu::always_inline]] inline void store_first(const Lanes<T, N>& v, int count, To* to) {
#ifdef __AVX512F__
  if constexpr (sizeof(T) * N == 64) {
    const auto mine = static_cast<std::uint32_t>((1ULL << count) - 1U);
    if constexpr (sizeof(T) > sizeof(To))
      return _mm256_mask_storeu_ps(to, static_cast<__mmask8>(mine), _mm512_cvtpd_ps(reinterpret_cast<__m512d>(v)));
    else if constexpr (sizeof(T) == sizeof(double))
      return _mm512_mask_storeu_pd(to, static_cast<__mmask8>(mine), reinterpret_cast<__m512d>(v));
    else
      return _mm512_mask_storeu_ps(to, static_cast<__mmask16>(mine), reinterpret_cast<__m512>(v));
  }
#endif
  if constexpr (std::is_same_v<T, To>) {
    if (count == N) {
      __builtin_memcpy(to, &v, sizeof v);
      return;
    }
  }
#ifdef __AVX2__
  if constexpr (sizeof(T) > sizeof(To) && N == 4) {
    if (count == N) return _mm_storeu_ps(to, _mm256_cvtpd_ps(reinterpret_cast<__m256d>(v)));
  }
#endif
  for (int l = 0; l < count; ++l) to[l] = static_cast<To>(v[l]);
}
