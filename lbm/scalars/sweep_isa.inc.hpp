// The body of one translation unit of the sweeps; included once by each sweep_<isa>.cpp. Raw memory, nothing but
// functions of internal linkage: code compiled for a newer processor cannot leak into the rest of the program.

#include "lbm/scalars/sweep.hpp"

namespace puffin::lbm {
namespace {

constexpr double largest_drift = 1.0 / 6.0;  // see sweep.hpp
constexpr int tile = 128;  // cells done at a time: the coefficients, shared by all scalars, stay in the first cache

struct Coefficients {
  alignas(64) double out_high[tile], out_low[tile];      // air leaving through the faces
  alignas(64) double reach_high[tile], reach_low[tile];  // (1 - out/theta)/2
  alignas(64) double link_high[tile], link_low[tile];    // 1: a neighbour behind the face
  alignas(64) double eddy_high[tile], eddy_low[tile];    // exchange through it whatever the scalar
  alignas(64) double drift[tile];                        // half the net outflow to the high side per theta, clipped
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
    const double drift = c.reach_low[i] - c.reach_high[i];
    const double size = detail::smaller(detail::magnitude(drift), largest_drift);
    c.drift[i] = drift < 0.0 ? -size : size;
    c.link_high[i] = links(open[i]);
    c.link_low[i] = links(open_low[i]);
  }
}

/// Flux of the scalars: of the air and their own.
void add(int n, const double* __restrict air, const double* __restrict drift, double* __restrict sum) {
  for (int i = 0; i < n; ++i) sum[i] = air[i] + drift[i];
}

/// What leaves through a face is a part of Y plus a part of the slope: shared by all scalars of equal diffusivity.
struct Parts {
  alignas(64) double value_high[tile], slope_high[tile], value_low[tile], slope_low[tile];
};

void eddies(int n, const double* __restrict at_high, const double* __restrict at_low, double steps, Coefficients& c) {
  for (int i = 0; i < n; ++i) {
    c.eddy_high[i] = steps * at_high[i] * c.link_high[i];
    c.eddy_low[i] = steps * at_low[i] * c.link_low[i];
  }
}
void no_eddies(int n, Coefficients& c) {
  for (int i = 0; i < n; ++i) c.eddy_high[i] = c.eddy_low[i] = 0.0;
}

void combine(int n, const Coefficients& c, double exchange, Parts& p) {
  for (int i = 0; i < n; ++i) {
    const double high = exchange * c.link_high[i] + c.eddy_high[i], low = exchange * c.link_low[i] + c.eddy_low[i];
    p.value_high[i] = c.out_high[i] + high;
    p.slope_high[i] = c.out_high[i] * c.reach_high[i] - high * c.drift[i];
    p.value_low[i] = c.out_low[i] + low;
    p.slope_low[i] = -(c.out_low[i] * c.reach_low[i] + low * c.drift[i]);
  }
}

template <class Limiter>
void leaving(int n, const double* y_low, const double* y, const double* y_high, const Coefficients& c, const Parts& p,
             double* __restrict out_high, double* __restrict out_low) {
  for (int i = 0; i < n; ++i) {
    const double slope = Limiter::slope((y[i] - y_low[i]) * c.link_low[i], (y_high[i] - y[i]) * c.link_high[i]);
    out_high[i] = p.value_high[i] * y[i] + p.slope_high[i] * slope;
    out_low[i] = p.value_low[i] * y[i] + p.slope_low[i] * slope;
  }
}

void outgoing(const SweepRun& run, const SweepScalar* scalars, int count) {
  Coefficients c;
  Parts p;
  for (int from = 0; from < run.count; from += tile) {
    const int n = run.count - from < tile ? run.count - from : tile;
    const double *mass = run.mass + from, *mass_low = mass + run.low;
    alignas(64) double sum[tile], sum_low[tile];
    if (run.drift) {
      add(n, mass, run.drift + from, sum);
      add(n, mass_low, run.drift + from + run.low, sum_low);
      mass = sum, mass_low = sum_low;
    }
    shared_by_scalars(n, mass, mass_low, run.open + from, run.open + from + run.low, run.air + from, run.steps, c);
    if (run.eddy)
      eddies(n, run.eddy + from, run.eddy + from + run.low, run.steps, c);
    else
      no_eddies(n, c);
    for (int k = 0; k < count; ++k) {
      const SweepScalar& s = scalars[k];
      if (k == 0 || s.exchange != scalars[k - 1].exchange) combine(n, c, s.exchange, p);
      const double* y = s.concentration + from;
      const auto law = s.scheme == Scheme::upwind     ? leaving<Upwind>
                       : s.scheme == Scheme::minmod   ? leaving<Minmod>
                       : s.scheme == Scheme::van_leer ? leaving<VanLeer>
                                                      : leaving<MonotonizedCentral>;
      law(n, y + run.low, y, y + run.high, c, p, s.out_high + from, s.out_low + from);
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

struct Outflow {
  alignas(64) double out[3][tile], net[3][tile];  // through both faces, per air step; net: of the air alone
};

void outflow(int n, const double* __restrict mass, const double* __restrict mass_low,
             const std::uint8_t* __restrict open, const std::uint8_t* __restrict open_low, double* __restrict out,
             double* __restrict net) {
  for (int i = 0; i < n; ++i) {
    const double high = mass[i] * passes(open[i]), low = mass_low[i] * passes(open_low[i]);
    out[i] = positive_part(high) + positive_part(-low);
    net[i] = high - low;
  }
}

/// The larger outflow, of the air or of what drifts in it.
void outflow_with_drift(int n, const double* __restrict mass, const double* __restrict mass_low,
                        const double* __restrict drift, const double* __restrict drift_low,
                        const std::uint8_t* __restrict open, const std::uint8_t* __restrict open_low,
                        double* __restrict out) {
  for (int i = 0; i < n; ++i) {
    const double high = (mass[i] + drift[i]) * passes(open[i]),
                 low = (mass_low[i] + drift_low[i]) * passes(open_low[i]);
    out[i] = detail::larger(out[i], positive_part(high) + positive_part(-low));
  }
}

LimitFound limit(const LimitRun& run) {
  using detail::larger;
  constexpr int lanes = 8;  // partial maxima that the compiler can keep in one register or two
  Outflow f;
  double most[lanes] = {}, least[lanes];
  for (double& l : least) l = run.air[0];
  for (int from = 0; from < run.count; from += tile) {
    const int n = run.count - from < tile ? run.count - from : tile;
    for (int d = 0; d < 3; ++d)
      outflow(n, run.mass[d] + from, run.mass[d] + from + run.low[d], run.open[d] + from,
              run.open[d] + from + run.low[d], f.out[d], f.net[d]);
    for (int d = 0; d < 3; ++d)
      if (run.drift[d])
        outflow_with_drift(n, run.mass[d] + from, run.mass[d] + from + run.low[d], run.drift[d] + from,
                           run.drift[d] + from + run.low[d], run.open[d] + from, run.open[d] + from + run.low[d],
                           f.out[d]);
    alignas(64) double need[tile], air[tile];
    for (int i = 0; i < n; ++i) {
      const double x = f.net[0][i], y = f.net[1][i], z = f.net[2][i];
      const double first = larger(f.out[0][i], f.out[2][i]);
      const double second = f.out[1][i] + run.cfl * larger(x, z);
      const double third = larger(f.out[2][i] + run.cfl * (x + y), f.out[0][i] + run.cfl * (z + y));
      const double between = larger(larger(x, z), larger(x, z) + y);
      const double theta = run.air[from + i];
      need[i] = larger(larger(first, second), larger(third, 2.0 * run.cfl * between)) / theta;
      air[i] = theta;
    }
    for (int i = n; i < (n + lanes - 1) / lanes * lanes; ++i) need[i] = 0.0, air[i] = air[0];
    for (int i = 0; i < n; i += lanes)
      for (int l = 0; l < lanes; ++l) {
        most[l] = larger(need[i + l], most[l]);
        least[l] = detail::smaller(air[i + l], least[l]);
      }
  }
  LimitFound found{most[0], least[0]};
  for (int l = 1; l < lanes; ++l) {
    found.demand = larger(most[l], found.demand);
    found.least_air = detail::smaller(least[l], found.least_air);
  }
  return found;
}

}  // namespace
}  // namespace puffin::lbm
