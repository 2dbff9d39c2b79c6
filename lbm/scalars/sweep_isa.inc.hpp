// The body of one translation unit of the sweeps; included once by each sweep_<isa>.cpp. Raw memory, nothing but
// functions of internal linkage: code compiled for a newer processor cannot leak into the rest of the program.
//
// Written in whole registers because the rows of a device are 10 to 60 cells long: left to itself the compiler does the
// last cells of each row one by one, and bytes beside doubles make its loops 64 cells wide. What lies beyond the end of
// a run (Rows::padding) is read and computed, but not stored.

#include <immintrin.h>

#include "lbm/scalars/sweep.hpp"

namespace puffin::lbm {
namespace {

#include "lbm/widen.inc.hpp"

#if defined(__AVX512F__)
constexpr int lanes = 8;
#elif defined(__AVX2__)
constexpr int lanes = 4;
#else
constexpr int lanes = 2;
#endif
using Reals = Lanes<double, lanes>;  // one number a cell

constexpr double largest_drift = 1.0 / 6.0;  // see sweep.hpp

[[gnu::always_inline]] inline Reals load(const double* p) {
  Reals v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
/// Stores the first `cells` lanes.
[[gnu::always_inline]] inline void store(const Reals& v, int cells, double* to) {
  if (cells == lanes) {
    __builtin_memcpy(to, &v, sizeof v);
    return;
  }
#if defined(__AVX512F__)
  _mm512_mask_storeu_pd(to, static_cast<__mmask8>((1U << cells) - 1U), v);
#else
  for (int l = 0; l < cells; ++l) to[l] = v[l];
#endif
}
[[gnu::always_inline]] inline int cells_of_pack(int count, int n) { return count - n < lanes ? count - n : lanes; }

/// Of the faces of a pack: 1 where air passes (code 1 inner, 2 opening), and 1 where there is a neighbour behind (1).
struct Codes {
  Reals passes, links;
};
[[gnu::always_inline]] inline Codes read_codes(const std::uint8_t* open) {
  const Lanes<int, lanes> code = widen<lanes>(open);
  return {to_doubles<lanes>((code + 1) >> 1), to_doubles<lanes>(code & 1)};
}

/// max(x, 0), exactly.
[[gnu::always_inline]] inline Reals positive_part(Reals x) { return 0.5 * (x + detail::magnitude(x)); }

[[gnu::always_inline]] inline Reals slope(Scheme scheme, Reals low, Reals high) {
  switch (scheme) {
    case Scheme::upwind:
      return Upwind::slope(low, high);
    case Scheme::minmod:
      return Minmod::slope(low, high);
    case Scheme::van_leer:
      return VanLeer::slope(low, high);
    case Scheme::mc:
      break;
  }
  return MonotonizedCentral::slope(low, high);
}

void outgoing(const SweepRun& run, const SweepScalar* scalars, int count) {
  for (int n = 0; n < run.count; n += lanes) {
    const int cells = cells_of_pack(run.count, n);
    const Codes at_high = read_codes(run.open + n), at_low = read_codes(run.open + n + run.low);
    const Reals per_air = 1.0 / load(run.air + n);
    // Air leaving through the faces, and (1 - out/theta)/2.
    const Reals out_high = positive_part(run.steps * load(run.mass + n) * at_high.passes);
    const Reals out_low = positive_part(-run.steps * load(run.mass + n + run.low) * at_low.passes);
    const Reals reach_high = 0.5 - 0.5 * out_high * per_air, reach_low = 0.5 - 0.5 * out_low * per_air;
    // Half the net outflow to the high side per theta, clipped.
    const Reals net = reach_low - reach_high, size = detail::smaller(detail::magnitude(net), Reals{} + largest_drift);
    const Reals drift = net < 0.0 ? -size : size;
    // Exchange through the faces whatever the scalar.
    Reals eddy_high{}, eddy_low{};
    if (run.eddy) {
      eddy_high = run.steps * load(run.eddy + n) * at_high.links;
      eddy_low = run.steps * load(run.eddy + n + run.low) * at_low.links;
    }
    for (int k = 0; k < count; ++k) {
      const SweepScalar& s = scalars[k];
      const double* at = s.concentration + n;
      const Reals high = s.exchange * at_high.links + eddy_high, low = s.exchange * at_low.links + eddy_low;
      const Reals y = load(at);
      const Reals rise =
          slope(s.scheme, (y - load(at + run.low)) * at_low.links, (load(at + run.high) - y) * at_high.links);
      store((out_high + high) * y + (out_high * reach_high - high * drift) * rise, cells, s.out_high + n);
      store((out_low + low) * y + -(out_low * reach_low + low * drift) * rise, cells, s.out_low + n);
    }
  }
}

void update(const SweepRun& run, const SweepScalar* scalars, int count) {
  for (int n = 0; n < run.count; n += lanes) {
    const int cells = cells_of_pack(run.count, n);
    const Reals high = run.steps * load(run.mass + n) * read_codes(run.open + n).passes;
    const Reals low = run.steps * load(run.mass + n + run.low) * read_codes(run.open + n + run.low).passes;
    const Reals air = load(run.air + n) + (low - high), per_air = 1.0 / air;
    store(air, cells, run.air + n);
    for (int k = 0; k < count; ++k) {
      const SweepScalar& s = scalars[k];
      const Reals from_low = load(s.out_high + n + run.low) - load(s.out_high + n);
      const Reals from_high = load(s.out_low + n + run.high) - load(s.out_low + n);
      const Reals now = load(s.amount + n) + (from_low + from_high);
      store(now, cells, s.amount + n);
      store(per_air * (now > dust ? now : Reals{}), cells, s.concentration + n);
    }
  }
}

LimitFound limit(const LimitRun& run) {
  using detail::larger;
  Reals most{}, least = Reals{} + run.air[0];
  Lanes<long long, lanes> lane;
  for (int l = 0; l < lanes; ++l) lane[l] = l;
  for (int n = 0; n < run.count; n += lanes) {
    Reals out[3], net[3];  // through both faces, per air step
    for (int d = 0; d < 3; ++d) {
      const double* mass = run.mass[d] + n;
      const std::uint8_t* open = run.open[d] + n;
      const Reals high = load(mass) * read_codes(open).passes;
      const Reals low = load(mass + run.low[d]) * read_codes(open + run.low[d]).passes;
      out[d] = positive_part(high) + positive_part(-low);
      net[d] = high - low;
    }
    const Reals x = net[0], y = net[1], z = net[2];
    const Reals first = larger(out[0], out[2]);
    const Reals second = out[1] + run.cfl * larger(x, z);
    const Reals third = larger(out[2] + run.cfl * (x + y), out[0] + run.cfl * (z + y));
    const Reals between = larger(larger(x, z), larger(x, z) + y);
    const auto mine = lane < cells_of_pack(run.count, n);
    const Reals theta = mine ? load(run.air + n) : Reals{} + run.air[0];
    const Reals need = larger(larger(first, second), larger(third, 2.0 * run.cfl * between)) / theta;
    most = larger(mine ? need : Reals{}, most);
    least = detail::smaller(theta, least);
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
