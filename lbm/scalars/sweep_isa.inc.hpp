// The body of one translation unit of the sweeps; included once by each sweep_<isa>.cpp. Raw memory, nothing but
// functions of internal linkage: code compiled for a newer processor cannot leak into the rest of the program.

#include "lbm/scalars/sweep.hpp"

namespace puffin::lbm {
namespace {

constexpr int tile = 128;  // cells done at a time: the coefficients, shared by all scalars, stay in the first cache

struct Coefficients {
  alignas(64) double out_high[tile], out_low[tile];      // air leaving through the faces
  alignas(64) double reach_high[tile], reach_low[tile];  // (1 - out/theta)/2
  alignas(64) double link_high[tile], link_low[tile];    // 1: a neighbour behind the face
};

/// 1 for faces that air passes (1 inner, 2 opening), and 1 for those with a neighbour behind (1).
[[gnu::always_inline]] inline double passes(std::uint8_t open) { return (static_cast<int>(open) + 1) >> 1; }
[[gnu::always_inline]] inline double links(std::uint8_t open) { return static_cast<int>(open) & 1; }

/// max(x, 0), exactly, without a comparison that the compiler might turn into a jump.
[[gnu::always_inline]] inline double positive_part(double x) { return 0.5 * (x + detail::magnitude(x)); }

void shared_by_scalars(int n, const double* __restrict mass, const double* __restrict mass_low,
                       const std::uint8_t* __restrict open, const std::uint8_t* __restrict open_low,
                       const double* __restrict air, double steps, Coefficients& c) {
  for (int i = 0; i < n; ++i) {
    const double per_air = 1.0 / air[i];
    const double high = steps * mass[i] * passes(open[i]);
    const double low = -steps * mass_low[i] * passes(open_low[i]);
    const double out_high = positive_part(high);
    const double out_low = positive_part(low);
    c.out_high[i] = out_high;
    c.out_low[i] = out_low;
    c.reach_high[i] = 0.5 - 0.5 * out_high * per_air;
    c.reach_low[i] = 0.5 - 0.5 * out_low * per_air;
    c.link_high[i] = links(open[i]);
    c.link_low[i] = links(open_low[i]);
  }
}

template <class Limiter>
void leaving(int n, const double* y_low, const double* y, const double* y_high, const Coefficients& c, double exchange,
             double* __restrict out_high, double* __restrict out_low) {
  for (int i = 0; i < n; ++i) {
    const double slope = Limiter::slope((y[i] - y_low[i]) * c.link_low[i], (y_high[i] - y[i]) * c.link_high[i]);
    out_high[i] = c.out_high[i] * (y[i] + c.reach_high[i] * slope) + exchange * c.link_high[i] * y[i];
    out_low[i] = c.out_low[i] * (y[i] - c.reach_low[i] * slope) + exchange * c.link_low[i] * y[i];
  }
}

void outgoing(const SweepRun& run, const SweepScalar* scalars, int count) {
  Coefficients c;
  for (int from = 0; from < run.count; from += tile) {
    const int n = run.count - from < tile ? run.count - from : tile;
    shared_by_scalars(n, run.mass + from, run.mass + from + run.low, run.open + from, run.open + from + run.low,
                      run.air + from, run.steps, c);
    for (int k = 0; k < count; ++k) {
      const SweepScalar& s = scalars[k];
      const double* y = s.concentration + from;
      const auto law = s.scheme == Scheme::upwind     ? leaving<Upwind>
                       : s.scheme == Scheme::minmod   ? leaving<Minmod>
                       : s.scheme == Scheme::van_leer ? leaving<VanLeer>
                                                      : leaving<MonotonizedCentral>;
      law(n, y + run.low, y, y + run.high, c, s.exchange, s.out_high + from, s.out_low + from);
    }
  }
}

void carry_air(int n, const double* __restrict mass, const double* __restrict mass_low,
               const std::uint8_t* __restrict open, const std::uint8_t* __restrict open_low, double steps,
               double* __restrict air, double* __restrict per_air) {
  for (int i = 0; i < n; ++i) {
    const double high = steps * mass[i] * passes(open[i]);
    const double low = steps * mass_low[i] * passes(open_low[i]);
    air[i] += low - high;
    per_air[i] = 1.0 / air[i];
  }
}

void carry_amount(int n, const double* __restrict from_low, const double* __restrict to_high,
                  const double* __restrict from_high, const double* __restrict to_low, const double* __restrict per_air,
                  double* __restrict amount, double* __restrict concentration) {
  for (int i = 0; i < n; ++i) {
    const double now = amount[i] + ((from_low[i] - to_high[i]) + (from_high[i] - to_low[i]));
    amount[i] = now;
    concentration[i] = per_air[i] * (now > dust ? now : 0.0);
  }
}

void update(const SweepRun& run, const SweepScalar* scalars, int count) {
  alignas(64) double per_air[tile];
  for (int from = 0; from < run.count; from += tile) {
    const int n = run.count - from < tile ? run.count - from : tile;
    carry_air(n, run.mass + from, run.mass + from + run.low, run.open + from, run.open + from + run.low, run.steps,
              run.air + from, per_air);
    for (int k = 0; k < count; ++k) {
      const SweepScalar& s = scalars[k];
      carry_amount(n, s.out_high + from + run.low, s.out_high + from, s.out_low + from + run.high, s.out_low + from,
                   per_air, s.amount + from, s.concentration + from);
    }
  }
}

}  // namespace
}  // namespace puffin::lbm
