// The body of one translation unit of the sweeps; included once by each sweep_<isa>.cpp. Raw memory, nothing but
// functions of internal linkage: code compiled for a newer processor cannot leak into the rest of the program.
//
// Written in whole registers because the rows of a device are 10 to 60 cells long: left to itself the compiler does the
// last cells of each row one by one, and bytes beside doubles make its loops 64 cells wide. What lies beyond the end of
// a run (Rows::padding) is read and computed, but not stored.

#include <immintrin.h>

#include <cstdint>
#include <type_traits>

#include "lbm/scalars/sweep.hpp"

namespace puffin::lbm {
namespace {

#include "lbm/widen.inc.hpp"

#if defined(__AVX512F__)
constexpr int register_bytes = 64;
#elif defined(__AVX2__)
constexpr int register_bytes = 32;
#else
constexpr int register_bytes = 16;
#endif
template <class Real>
constexpr int lanes_of = register_bytes / static_cast<int>(sizeof(Real));
template <class Real>
using RealsOf = Lanes<Real, lanes_of<Real>>;  // one number a cell
constexpr int lanes = lanes_of<double>;
using Reals = RealsOf<double>;

constexpr double largest_drift = 0.5;  // see sweep.hpp

/// Of the faces of a pack: 1 where air passes (code 1 inner, 2 opening), and 1 where there is a neighbour behind (1).
template <class Real>
struct Codes {
  RealsOf<Real> passes, links;
};
template <class Real>
[[gnu::always_inline]] inline Codes<Real> read_codes(const std::uint8_t* open) {
  constexpr int n = lanes_of<Real>;
  const Lanes<int, n> code = widen<n>(open);
  return {to_numbers<Real, n>(((code + 1) >> 1) & 1), to_numbers<Real, n>(code & 1)};
}
template <class Real, class From>
[[gnu::always_inline]] inline RealsOf<Real> load(const From* p) {
  return load_as<Real, lanes_of<Real>>(p);
}
template <class V>
[[gnu::always_inline]] inline int cells_of_pack(int count, int n) {
  constexpr int width = static_cast<int>(sizeof(V) / sizeof(V{}[0]));
  return count - n < width ? count - n : width;
}

/// max(x, 0); what is no number stays none.
template <class V>
[[gnu::always_inline]] inline V positive_part(V x) {
  return detail::larger(V{}, x);
}

template <class V>
[[gnu::always_inline]] inline V slope(Scheme scheme, V low, V high) {
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

template <class Real>
void outgoing(const SweepRun& run, const SweepScalar<Real>* scalars, int count) {
  using V = RealsOf<Real>;
  const V half = detail::spread<V>(0.5), most_drift = detail::spread<V>(largest_drift);
  const V steps = detail::spread<V>(run.steps);
  for (int n = 0; n < run.count; n += lanes_of<Real>) {
    const int cells = cells_of_pack<V>(run.count, n);
    const Codes<Real> at_high = read_codes<Real>(run.open + n), at_low = read_codes<Real>(run.open + n + run.low);
    const V per_air = detail::spread<V>(1.0) / load<Real>(run.air + n);
    // What leaves through the faces, as air, and (1 - out/theta)/2.
    V mass_high = load<Real>(run.mass + n), mass_low = load<Real>(run.mass + n + run.low);
    if (run.drift) {
      mass_high = mass_high + load<Real>(run.drift + n);
      mass_low = mass_low + load<Real>(run.drift + n + run.low);
    }
    const V out_high = positive_part(steps * mass_high * at_high.passes);
    const V out_low = positive_part(-steps * mass_low * at_low.passes);
    const V reach_high = half - half * out_high * per_air, reach_low = half - half * out_low * per_air;
    // The net outflow to the high side per theta, clipped; half of what stays.
    const V half_left = half * (load<Real>(run.air + n) - (out_high + out_low));
    const V net = (out_high - out_low) * per_air, size = detail::smaller(detail::magnitude(net), most_drift);
    const V drift = net < V{} ? -size : size;
    // Exchange through the faces whatever the scalar.
    V eddy_high{}, eddy_low{};
    if (run.eddy) {
      eddy_high = steps * load<Real>(run.eddy + n) * at_high.links;
      eddy_low = steps * load<Real>(run.eddy + n + run.low) * at_low.links;
    }
    for (int k = 0; k < count; ++k) {
      const SweepScalar<Real>& s = scalars[k];
      const Real* at = s.concentration + n;
      const V exchange = detail::spread<V>(s.exchange);
      const V high = exchange * at_high.links + eddy_high, low = exchange * at_low.links + eddy_low;
      const V shift = high + low > half_left ? half * drift : drift;
      const V y = load<Real>(at);
      const V rise = slope(s.scheme, (y - load<Real>(at + run.low)) * at_low.links,
                           (load<Real>(at + run.high) - y) * at_high.links);
      // Not negative but for rounding.
      const V leaves_high = (out_high + high) * y + (out_high * reach_high - high * shift) * rise;
      const V leaves_low = (out_low + low) * y - (out_low * reach_low + low * shift) * rise;
      store_first<Real, lanes_of<Real>>(positive_part(leaves_high), cells, s.out_high + n);
      store_first<Real, lanes_of<Real>>(positive_part(leaves_low), cells, s.out_low + n);
    }
  }
}

template <class Real>
void update(const SweepRun& run, const SweepScalar<Real>* scalars, int count) {
  for (int n = 0; n < run.count; n += lanes) {
    const int cells = cells_of_pack<Reals>(run.count, n);
    const Reals high = run.steps * load<double>(run.mass + n) * read_codes<double>(run.open + n).passes;
    const Reals low =
        run.steps * load<double>(run.mass + n + run.low) * read_codes<double>(run.open + n + run.low).passes;
    const Reals air = load_first<double, lanes>(run.air + n, cells) + (low - high), per_air = 1.0 / air;
    store_first<double, lanes>(air, cells, run.air + n);
    for (int k = 0; k < count; ++k) {
      const SweepScalar<Real>& s = scalars[k];
      const Reals from_low = load<double>(s.out_high + n + run.low) - load<double>(s.out_high + n);
      const Reals from_high = load<double>(s.out_low + n + run.high) - load<double>(s.out_low + n);
      const Reals now = load_first<double, lanes>(s.amount + n, cells) + (from_low + from_high);
      store_first<double, lanes>(now, cells, s.amount + n);
      if (s.concentration == nullptr) continue;
      store_first<double, lanes>(per_air * (now > s.resting ? now : Reals{}), cells, s.concentration + n);
    }
  }
}

template <class Real>
void concentrate(int count, const double* air, const SweepScalar<Real>* scalars, int n_scalars) {
  for (int n = 0; n < count; n += lanes) {
    const int cells = cells_of_pack<Reals>(count, n);
    const Reals per_air = 1.0 / load_first<double, lanes>(air + n, cells);
    for (int k = 0; k < n_scalars; ++k) {
      const Reals amount = load_first<double, lanes>(scalars[k].amount + n, cells);
      store_first<double, lanes>(per_air * (amount > scalars[k].resting ? amount : Reals{}), cells,
                                 scalars[k].concentration + n);
    }
  }
}

/// Eight sums, whatever the register: equal bits.
Content content(int count, const double* amount) {
  double part[8] = {}, most[8] = {};
  int n = 0;
  for (; n + 8 <= count; n += 8)
    for (int l = 0; l < 8; ++l) {
      part[l] += amount[n + l];
      most[l] = detail::larger(most[l], amount[n + l]);
    }
  for (int l = 0; n + l < count; ++l) {
    part[l] += amount[n + l];
    most[l] = detail::larger(most[l], amount[n + l]);
  }
  for (int l = 1; l < 8; ++l) most[0] = detail::larger(most[0], most[l]);
  return {((part[0] + part[4]) + (part[1] + part[5])) + ((part[2] + part[6]) + (part[3] + part[7])), most[0]};
}

double mismatch(int count, const double* air, const double* density) {
  Reals most{};
  Lanes<long long, lanes> lane;
  for (int l = 0; l < lanes; ++l) lane[l] = l;
  for (int n = 0; n < count; n += lanes) {
    const Reals wanted = load<double>(density + n);
    const Reals off = detail::magnitude(load<double>(air + n) - wanted) / wanted;
    most = detail::larger(lane < cells_of_pack<Reals>(count, n) ? off : Reals{}, most);
  }
  double found = most[0];
  for (int l = 1; l < lanes; ++l) found = detail::larger(most[l], found);
  return found;
}

/// What a cell asks of each half of a mirrored pair around direction `c` (max_steps.hpp), before the division by theta.
[[gnu::always_inline]] inline Reals pair_demand(const Reals (&out)[3], const Reals (&net)[3], int c, double cfl) {
  using detail::larger;
  const int a = c == 0 ? 1 : 0, b = c == 2 ? 1 : 2;
  const Reals one = net[a], two = one + net[b], three = two + 2.0 * net[c], four = three + net[b];
  const Reals there = larger(larger(out[a], out[b] + cfl * one), 2.0 * out[c] + cfl * two);
  const Reals back = larger(out[b] + cfl * three, out[a] + cfl * four);
  return larger(larger(there, back), 2.0 * cfl * larger(larger(one, two), larger(three, four)));
}

LimitFound limit(const LimitRun& run) {
  using detail::larger;
  Reals most{}, pair[3] = {}, least = Reals{} + run.air[0];
  Lanes<long long, lanes> lane;
  for (int l = 0; l < lanes; ++l) lane[l] = l;
  for (int n = 0; n < run.count; n += lanes) {
    Reals out[3], net[3];  // through both faces, per air step; net: of the air alone
    for (int d = 0; d < 3; ++d) {
      const double* mass = run.mass[d] + n;
      const std::uint8_t* open = run.open[d] + n;
      const Reals at_high = read_codes<double>(open).passes;
      const Reals at_low = read_codes<double>(open + run.low[d]).passes;
      const Reals high = load<double>(mass) * at_high, low = load<double>(mass + run.low[d]) * at_low;
      out[d] = positive_part(high) + positive_part(-low);
      net[d] = high - low;
      if (!run.drift[d]) continue;
      const double* drift = run.drift[d] + n;  // the larger outflow counts, of the air or of what drifts in it
      const Reals with_high = (load<double>(mass) + load<double>(drift)) * at_high;
      const Reals with_low = (load<double>(mass + run.low[d]) + load<double>(drift + run.low[d])) * at_low;
      out[d] = larger(out[d], positive_part(with_high) + positive_part(-with_low));
    }
    const Reals x = net[0], y = net[1], z = net[2];
    const Reals first = larger(out[0], out[2]);
    const Reals second = out[1] + run.cfl * larger(x, z);
    const Reals third = larger(out[2] + run.cfl * (x + y), out[0] + run.cfl * (z + y));
    const Reals between = larger(larger(x, z), larger(x, z) + y);
    const auto mine = lane < cells_of_pack<Reals>(run.count, n);
    const Reals theta = mine ? load<double>(run.air + n) : Reals{} + run.air[0];
    const Reals need = larger(larger(first, second), larger(third, 2.0 * run.cfl * between)) / theta;
    most = larger(mine ? need : Reals{}, most);
    for (int c = 0; c < 3; ++c) pair[c] = larger(mine ? pair_demand(out, net, c, run.cfl) / theta : Reals{}, pair[c]);
    least = detail::smaller(theta, least);
  }
  LimitFound found{most[0], {pair[0][0], pair[1][0], pair[2][0]}, least[0]};
  for (int l = 1; l < lanes; ++l) {
    found.demand = larger(most[l], found.demand);
    for (int c = 0; c < 3; ++c) found.pair[c] = larger(pair[c][l], found.pair[c]);
    found.least_air = detail::smaller(least[l], found.least_air);
  }
  return found;
}

SweepKernel this_sweep() {
  return {{outgoing<float>, update<float>, concentrate<float>},
          {outgoing<double>, update<double>, concentrate<double>},
          limit,
          content,
          mismatch};
}

}  // namespace
}  // namespace puffin::lbm
