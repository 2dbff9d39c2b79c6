// Sets of lanes of a pack as AVX-512 has them, in a mask register; part of its kernel unit (kernel_isa.inc.hpp).

template <class T>
using LaneSet = std::conditional_t<sizeof(T) == 4, __mmask16, __mmask8>;

/// The lanes whose bits are set. Kept in a mask register: gcc would move it there again for each store.
template <class T>
[[gnu::always_inline]] inline LaneSet<T> lane_set(std::uint32_t bits) {
  auto set = static_cast<LaneSet<T>>(bits);
  asm("" : "+Yk"(set));
  return set;
}

[[gnu::always_inline]] inline void store_lanes(const Pack<float>& v, __mmask16 lanes, float* to) {
  _mm512_mask_storeu_ps(to, lanes, static_cast<__m512>(v));
}
[[gnu::always_inline]] inline void store_lanes(const Pack<double>& v, __mmask8 lanes, double* to) {
  _mm512_mask_storeu_pd(to, lanes, static_cast<__m512d>(v));
}
[[gnu::always_inline]] inline void store_lanes(const Pack<double>& v, __mmask8 lanes, float* to) {
  _mm256_mask_storeu_ps(to, lanes, _mm512_cvtpd_ps(static_cast<__m512d>(v)));
}

/// Zero in the other lanes.
[[gnu::always_inline]] inline Pack<float> only(const Pack<float>& v, __mmask16 lanes) {
  return Pack<float>(_mm512_maskz_mov_ps(lanes, static_cast<__m512>(v)));
}
[[gnu::always_inline]] inline Pack<double> only(const Pack<double>& v, __mmask8 lanes) {
  return Pack<double>(_mm512_maskz_mov_pd(lanes, static_cast<__m512d>(v)));
}

/// How many of the lanes are below a limit.
[[gnu::always_inline]] inline int count_below(const Pack<float>& v, float limit, __mmask16 lanes) {
  return __builtin_popcount(_mm512_mask_cmp_ps_mask(lanes, static_cast<__m512>(v), _mm512_set1_ps(limit), _CMP_LT_OQ));
}
[[gnu::always_inline]] inline int count_below(const Pack<double>& v, double limit, __mmask8 lanes) {
  return __builtin_popcount(_mm512_mask_cmp_pd_mask(lanes, static_cast<__m512d>(v), _mm512_set1_pd(limit), _CMP_LT_OQ));
}
/// Whether all of the lanes are below a limit (what is not a number is not).
[[gnu::always_inline]] inline bool all_below(const Pack<float>& v, float limit, __mmask16 lanes) {
  return _mm512_mask_cmp_ps_mask(lanes, static_cast<__m512>(v), _mm512_set1_ps(limit), _CMP_NLT_UQ) == 0;
}
[[gnu::always_inline]] inline bool all_below(const Pack<double>& v, double limit, __mmask8 lanes) {
  return _mm512_mask_cmp_pd_mask(lanes, static_cast<__m512d>(v), _mm512_set1_pd(limit), _CMP_NLT_UQ) == 0;
}

/// Floats as numbers of a pack; no others are touched, zero in their lanes.
[[gnu::always_inline]] inline Pack<float> load_lanes(const float* p, __mmask16 lanes) {
  return Pack<float>(_mm512_maskz_loadu_ps(lanes, p));
}
[[gnu::always_inline]] inline Pack<double> load_lanes(const double* p, __mmask8 lanes) {
  return Pack<double>(_mm512_maskz_loadu_pd(lanes, p));
}
[[gnu::always_inline]] inline Pack<double> load_lanes(const float* p, __mmask8 lanes) {
  return Pack<double>(_mm512_cvtps_pd(_mm256_maskz_loadu_ps(lanes, p)));
}
