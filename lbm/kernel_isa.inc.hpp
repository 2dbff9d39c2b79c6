// The body of one kernel translation unit; included once by each kernel_<isa>.cpp, which sets PUFFIN_ISA to its name.
// Only raw memory is touched here and nothing but templates over this unit's own SIMD pack is instantiated, so code
// compiled for a newer processor cannot leak into the rest of the program.

#include <algorithm>
#include <cmath>
#include <experimental/simd>
#include <utility>

#include "lbm/kernel.hpp"

namespace puffin::lbm::PUFFIN_ISA {
namespace {

namespace stdx = std::experimental;

template <class T>
using Pack = stdx::native_simd<T>;

template <class T>
inline Pack<T> load_float(const float* p) {
  Pack<T> v;
  v.copy_from(p, stdx::element_aligned);
  return v;
}

/// Minimum and maximum as the processor does them: the second operand where either is not a number.
template <class P>
[[gnu::always_inline]] inline P minimum(const P& a, const P& b) {
  return stdx::min(b, a);
}
template <class P>
[[gnu::always_inline]] inline P maximum(const P& a, const P& b) {
  return stdx::max(b, a);
}

/// The rare path of the positivity limiter: scales the stress down, cell by cell, until no population falls below
/// w_i/10; to zero where the equilibrium itself does.
template <class L, bool Forced, class P>
[[gnu::noinline, gnu::cold]] void limit_stress(const P (&force)[3], CellState<P>& state) {
  using T = typename P::value_type;
  P full[19], none[19];
  L::template assemble<Forced>(state, force, [&](auto i, const P& v) { full[i] = v; });
  CellState<P> bare = state;
  for (auto& p : bare.p) p = P(T(0));
  L::template assemble<Forced>(bare, force, [&](auto i, const P& v) { none[i] = v; });
  P scale(T(1));
  for (int i = 0; i < 19; ++i) {
    const P floor(T(-0.9 * d3q19::weight[i]));
    const P room = none[i] - floor, drop = none[i] - full[i];
    P s = room / stdx::max(drop, P(T(1e-30)));
    where(!(full[i] < floor), s) = P(T(1));
    where(s < P(T(0)), s) = P(T(0));
    scale = stdx::min(scale, s);
  }
  for (auto& p : state.p) p = p * scale;
}

/// What the packs of a sweep saw.
template <class P>
struct Seen {
  P max_speed2{0}, min_drho{0}, max_drho{0}, not_a_number{0};
  std::int64_t limited = 0;
};

/// How a pack lies in its run: whole; over cells that the pack before it does (lanes below `skip`); or beyond the end
/// of a run shorter than a pack, where the lanes from `count` on belong to others, perhaps to another thread.
enum class Fit { whole, overlapping, short_run };

/// Where a run is read and written. Direction i of its first cell is found at from[i]: in its own slots before an even
/// step, in those of its neighbours before an odd one. What leaves in direction i goes where the opposite one was
/// found.
template <class T>
struct RunPlaces {
  T* from[19];
};

/// One pack of cells: [n + skip, n + end) of a run.
template <class T>
struct Place {
  T* const* from;
  std::ptrdiff_t slot;  // of lane 0
  int n, skip, end;
  Fit fit;
  std::uint8_t flags;
};

/// Packs are taken from the runs in order and treated in batches: all of a batch are read, then all relaxed, then all
/// written. A batch may span several runs, so short rows do not wait for the square roots of their few cells.
template <class T, class L, bool Forced>
class Batch {
 public:
  using P = Pack<T>;
  using Mask = typename P::mask_type;
  static constexpr int width = static_cast<int>(P::size());

  explicit Batch(const KernelInput<T>& in) : in_(in), constants_(in.constants) {
    for (int i = 0; i < 19; ++i) {
      const int o = d3q19::opposite(i);
      base_[i] = in.parity == Parity::even ? in.f + i * in.stride : in.f + o * in.stride + d3q19::velocity[o][0];
    }
  }

  void add(const Run& run, std::uint8_t flags, Seen<P>& seen) {
    T** from = runs_[run_count_++].from;
    if (in_.parity == Parity::even) {
      for (int i = 0; i < 19; ++i) from[i] = base_[i] + run.first;
    } else {
      for (int i = 0; i < 19; ++i) {
        const auto& c = d3q19::velocity[d3q19::opposite(i)];
        from[i] = base_[i] + run.first + run.shift[c[1] + 1][c[2] + 1];
      }
    }
    int n = 0;
    for (; n + width <= run.count; n += width) {
      place_[count_++] = {from, run.first + n, n, 0, width, Fit::whole, flags};
      if (count_ == size) flush_keeping(from, seen);
    }
    if (n < run.count) {
      if (n > 0)
        place_[count_++] = {
            from, run.first + run.count - width, run.count - width, width - (run.count - n), width, Fit::overlapping,
            flags};
      else
        place_[count_++] = {from, run.first, 0, 0, run.count, Fit::short_run, flags};
      if (count_ == size) flush(seen);
    }
  }

  void flush(Seen<P>& seen) {
    treat(seen);
    count_ = 0;
    run_count_ = 0;
  }

 private:
  static constexpr int size = 8;  // packs; their states stay in the first-level cache

  /// Within a run: its places move to the front.
  void flush_keeping(T**& from, Seen<P>& seen) {
    flush(seen);
    T** const first = runs_[run_count_++].from;
    if (first != from) std::copy(from, from + 19, first);
    from = first;
  }

  [[gnu::always_inline]] static Mask lanes(const Place<T>& p) {
    const P lane([](auto l) { return static_cast<T>(static_cast<int>(l)); });
    return lane >= P(T(p.skip)) && lane < P(T(p.end));
  }
  template <Fit fit>
  [[gnu::always_inline]] static P read(const Place<T>& p, int i, const Mask& mine) {
    if constexpr (fit == Fit::short_run) {
      P v(T(0));
      where(mine, v).copy_from(p.from[i] + p.n, stdx::element_aligned);
      return v;
    } else {
      return P(p.from[i] + p.n, stdx::element_aligned);
    }
  }
  template <Fit fit>
  [[gnu::always_inline]] static void write(const Place<T>& p, int i, const Mask& mine, const P& v) {
    T* const to = p.from[d3q19::opposite(i)] + p.n;
    if constexpr (fit == Fit::whole) v.copy_to(to, stdx::element_aligned);
    if constexpr (fit == Fit::short_run) where(mine, v).copy_to(to, stdx::element_aligned);
    if constexpr (fit == Fit::overlapping) {  // cheaper than a masked store, and all lanes are this run's own
      P kept(to, stdx::element_aligned);
      where(mine, kept) = v;
      kept.copy_to(to, stdx::element_aligned);
    }
  }
  [[gnu::always_inline]] void force_at(const Place<T>& p, double factor, P (&force)[3]) const {
    for (int d = 0; d < 3; ++d) {
      force[d] = P(T(0));
      if constexpr (Forced) {
        force[d] = P(T(in_.uniform_force[d]));
        if (p.flags & run_forced) force[d] = force[d] + load_float<T>(in_.force[d] + p.slot);
        force[d] = force[d] * P(T(factor));
      }
    }
  }

  void treat(Seen<P>& seen) {
    if constexpr (requires { &L::template relax<P>; }) {
      for (int k = 0; k < count_; ++k) {
        if (place_[k].fit == Fit::short_run) [[unlikely]]
          gather_short(place_[k], factor_[k], state_[k]);
        else
          gather<Fit::whole>(place_[k], factor_[k], state_[k]);
      }
      for (int k = 0; k < count_; ++k) factor_[k] = L::relax(constants_, factor_[k], state_[k]);
      // Overlapping packs first: they keep lanes by loading them, and loads would wait for stores still on their way.
      for (int k = 0; k < count_; ++k)
        if (place_[k].fit == Fit::overlapping) finish<Fit::overlapping>(place_[k], state_[k], factor_[k], seen);
      for (int k = 0; k < count_; ++k) {
        if (place_[k].fit == Fit::whole) finish<Fit::whole>(place_[k], state_[k], factor_[k], seen);
        if (place_[k].fit == Fit::short_run) finish_short(place_[k], state_[k], factor_[k], seen);
      }
    } else {
      for (int k = 0; k < count_; ++k) {
        if (place_[k].fit == Fit::whole) collide<Fit::whole>(place_[k], seen);
        if (place_[k].fit == Fit::short_run) collide<Fit::short_run>(place_[k], seen);
      }
      for (int k = 0; k < count_; ++k)
        if (place_[k].fit == Fit::overlapping) collide<Fit::overlapping>(place_[k], seen);
    }
  }

  template <Fit fit>
  [[gnu::always_inline]] void gather(const Place<T>& p, P& les, CellState<P>& state) const {
    const Mask mine = fit == Fit::short_run ? lanes(p) : Mask(true);
    P force[3];
    force_at(p, L::old_force(constants_), force);
    les = load_float<T>(in_.les + p.slot);
    find_state<Forced>(
        [&](auto i) __attribute__((always_inline)) { return read<fit>(p, i, mine); }, force, les, state);
  }
  [[gnu::noinline]] void gather_short(const Place<T>& p, P& les, CellState<P>& state) const {
    gather<Fit::short_run>(p, les, state);
  }
  template <Fit fit>
  [[gnu::always_inline]] void collide(const Place<T>& p, Seen<P>& seen) const {
    const Mask mine = fit == Fit::whole ? Mask(true) : lanes(p);
    P force[3];
    force_at(p, 1.0, force);
    const P les = load_float<T>(in_.les + p.slot);
    const auto m = L::template collide<Forced>(
        [&](auto i) __attribute__((always_inline)) { return read<fit>(p, i, mine); },
        [&](auto i, const P& v) __attribute__((always_inline)) { write<fit>(p, i, mine, v); }, force, constants_, les);
    look<fit>(p, m, mine, seen);
  }

  template <Fit fit>
  [[gnu::always_inline]] void finish(const Place<T>& p, const CellState<P>& unrelaxed, const P& factor,
                                     Seen<P>& seen) const {
    const Mask mine = fit == Fit::whole ? Mask(true) : lanes(p);
    CellState<P> s = unrelaxed;
    for (auto& n : s.p) n = n * factor;
    P force[3];
    force_at(p, 1.0, force);
    // Positivity, f_i >= w_i/10: the smallest g_i over axes and over diagonals decides. The populations are stored at
    // once; in the rare case they are made again from the state, which is still here.
    P rest, axis, diagonal;
    L::template assemble<Forced>(
        s, force, [&](auto i, const P& v) __attribute__((always_inline)) {
          write<fit>(p, i, mine, v);
          if constexpr (i == 0) rest = v;
          if constexpr (i == 1) axis = v;
          if constexpr (i == 7) diagonal = v;
          if constexpr (i > 1 && i < 7) axis = minimum(axis, v);
          if constexpr (i > 7) diagonal = minimum(diagonal, v);
        });
    const P lowest = minimum(minimum(rest * P(T(3)), axis * P(T(18))), diagonal * P(T(36)));
    Mask negative = lowest < P(T(-0.9));
    if constexpr (fit != Fit::whole) negative = negative && mine;
    if (stdx::any_of(negative)) [[unlikely]]
      seen.limited += write_limited<fit>(p, unrelaxed, factor, negative);
    look<fit>(p, CellMoments<P>{s.drho, s.u[0], s.u[1], s.u[2]}, mine, seen);
  }
  template <Fit fit>
  [[gnu::noinline, gnu::cold]] int write_limited(const Place<T>& p, const CellState<P>& unrelaxed, const P& factor,
                                                 const Mask& negative) const {
    CellState<P> s = unrelaxed;
    for (auto& n : s.p) n = n * factor;
    P force[3];
    force_at(p, 1.0, force);
    limit_stress<L, Forced>(force, s);
    const Mask mine = lanes(p);
    L::template assemble<Forced>(s, force, [&](auto i, const P& v) { write<fit>(p, i, mine, v); });
    return stdx::popcount(negative);
  }
  [[gnu::noinline]] void finish_short(const Place<T>& p, const CellState<P>& state, const P& factor,
                                      Seen<P>& seen) const {
    finish<Fit::short_run>(p, state, factor, seen);
  }

  template <Fit fit>
  [[gnu::always_inline]] void look(const Place<T>& p, CellMoments<P> m, const Mask& mine, Seen<P>& seen) const {
    if constexpr (fit != Fit::whole)
      for (P* v : {&m.density_excess, &m.ux, &m.uy, &m.uz}) where(!mine, *v) = P(T(0));
    const P speed2 = m.ux * m.ux + m.uy * m.uy + m.uz * m.uz;
    seen.max_speed2 = maximum(speed2, seen.max_speed2);
    seen.min_drho = minimum(m.density_excess, seen.min_drho);
    seen.max_drho = maximum(m.density_excess, seen.max_drho);
    seen.not_a_number = seen.not_a_number + speed2;  // a sum forgets no NaN, a maximum does
    if (!(p.flags & run_moments)) return;
    const P* value[4] = {&m.density_excess, &m.ux, &m.uy, &m.uz};
    alignas(stdx::memory_alignment_v<P>) T buffer[width];
    for (int k = 0; k < 4; ++k) {
      value[k]->copy_to(buffer, stdx::vector_aligned);
      for (int l = p.skip; l < p.end; ++l) in_.moments[k][p.slot + l] = static_cast<float>(buffer[l]);
    }
  }

  const KernelInput<T>& in_;
  const CollisionConstants constants_;
  T* base_[19];  // where direction i of slot 0 would be found, less the shift of its row
  RunPlaces<T> runs_[size + 1];
  int run_count_ = 0, count_ = 0;
  Place<T> place_[size];
  CellState<P> state_[size];
  P factor_[size];
};

template <class T, class L>
KernelReport sweep(const KernelInput<T>& in) {
  Seen<Pack<T>> seen;
  Batch<T, L, true> forced(in);
  Batch<T, L, false> free(in);
  for (int r = in.first_run; r < in.last_run; ++r) {
    const std::uint8_t flags = in.run_flags[r];
    if (in.forced_everywhere || (flags & run_forced))
      forced.add(in.runs[r], flags, seen);
    else
      free.add(in.runs[r], flags, seen);
  }
  forced.flush(seen);
  free.flush(seen);
  KernelReport report;
  report.limited = seen.limited;
  report.max_speed2 = stdx::hmax(seen.max_speed2);
  report.min_density_excess = stdx::hmin(seen.min_drho);
  report.max_density_excess = stdx::hmax(seen.max_drho);
  report.bad = !std::isfinite(stdx::reduce(seen.not_a_number)) || report.max_speed2 >= speed_limit * speed_limit ||
               report.min_density_excess <= -0.5 || report.max_density_excess >= 0.5;
  return report;
}

/// The links of one wall run, in the order of their directions (links.hpp has the equations).
template <class T>
struct WallLinks {
  const T* out[18];         // what left the cell
  const T* partner[18];     // what helps to interpolate
  const float* weight[18];  // of the partner
  const float* moving[18];
  T* back[18];      // where the reflected population goes
  T share[18];  // of the imbalance: w_i over the sum
  int count = 0;
};

template <class T>
[[gnu::always_inline]] inline void find_links(const WallInput<T>& in, const WallRun& wall, WallLinks<T>& links) {
  const Run& run = in.runs[wall.run];
  const auto offset = [&](int i) {
    const auto& c = d3q19::velocity[i];
    return c[0] + run.shift[c[1] + 1][c[2] + 1];
  };
  links.count = 0;
  T sum = 0;
  for (std::uint32_t bits = wall.directions; bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctz(bits), o = d3q19::opposite(i), k = links.count++;
    T* const f_i = in.f + i * in.stride + wall.first;
    T* const f_o = in.f + o * in.stride + wall.first;
    T* const beyond = f_i + offset(i);
    // f_own sits in the cell's own slot i after an even step, f_out(x-c) in slot o of the cell behind; odd: swapped.
    const bool far = (wall.far >> i & 1U) != 0;
    links.partner[k] = far == (in.parity == Parity::even) ? f_i : f_o + offset(o);
    links.out[k] = in.parity == Parity::even ? f_o : beyond;
    links.back[k] = in.parity == Parity::even ? beyond : f_o;
    const std::size_t at = wall.coefficient + static_cast<std::size_t>(k) * wall.count;
    links.weight[k] = in.partner + at;
    links.moving[k] = wall.moving ? in.moving + at : nullptr;
    links.share[k] = T(i < 7 ? 2 : 1);
    sum += links.share[k];
  }
  const T each = T(1) / sum;
  for (int k = 0; k < links.count; ++k) links.share[k] *= each;
}

/// Reflection for the cells of one pack (or one cell: V = T) from cell n of the wall run on.
template <class V, class T>
[[gnu::always_inline]] inline void reflect(const WallLinks<T>& links, bool moving, T speed, int n) {
  const auto load = [n]<class S>(const S* p) __attribute__((always_inline)) {
    if constexpr (std::is_same_v<V, T>)
      return static_cast<T>(p[n]);
    else if constexpr (std::is_same_v<S, T>)
      return V(p + n, stdx::element_aligned);
    else
      return load_float<T>(p + n);
  };
  V incoming[18];
  V imbalance = constant<V>(0);
  for (int k = 0; k < links.count; ++k) {
    const V out = load(links.out[k]);
    V change = load(links.weight[k]) * (load(links.partner[k]) - out);
    if (moving) change = change + V(speed) * load(links.moving[k]);
    incoming[k] = out + change;
    imbalance = imbalance - change;
  }
  for (int k = 0; k < links.count; ++k) {
    const V f = incoming[k] + V(links.share[k]) * imbalance;
    if constexpr (std::is_same_v<V, T>)
      links.back[k][n] = f;
    else
      f.copy_to(links.back[k] + n, stdx::element_aligned);
  }
}

template <class T>
void walls(const WallInput<T>& in) {
  using P = Pack<T>;
  constexpr int width = static_cast<int>(P::size());
  WallLinks<T> links;
  const T speed = static_cast<T>(in.wall_speed);
  for (std::size_t w = in.first; w < in.last; ++w) {
    const WallRun& wall = in.walls[w];
    find_links(in, wall, links);
    if (wall.count < width) {
      for (int n = 0; n < wall.count; ++n) reflect<T>(links, wall.moving, speed, n);
      continue;
    }
    // The last pack overlaps the one before it: what it reads has not been written, so the result is the same.
    for (int n = 0; n < wall.count; n += width) reflect<P>(links, wall.moving, speed, std::min(n, wall.count - width));
  }
}

/// Direction of D3Q19 along +-d and +-b (b = -1: along d alone).
constexpr int direction_of(int d, int sd, int b, int sb) {
  for (int i = 0; i < 19; ++i) {
    bool same = true;
    for (int a = 0; a < 3; ++a) same = same && d3q19::velocity[i][a] == (a == d ? sd : (a == b ? sb : 0));
    if (same) return i;
  }
  return 0;
}

template <class T, int D>
void face_fluxes_of_run(const FluxInput<T>& in, const Run& run) {
  // m(x -> y, i) = arrived_i(y) - arrived_o(x) = +-(f_i[slot y] - f_o[slot x]); + before an even step, - before an odd.
  const auto offset = [&](int i) {
    const auto& c = d3q19::velocity[i];
    return c[0] + run.shift[c[1] + 1][c[2] + 1];
  };
  const double sign = in.next == Parity::even ? 1.0 : -1.0;
  constexpr int along = direction_of(D, 1, -1, 0);
  const T* axis_to = in.f + along * in.stride + run.first + offset(along);
  const T* axis_from = in.f + d3q19::opposite(along) * in.stride + run.first;
  const T* to[8];
  const T* from[8];
  int k = 0;
  for (int step = 1; step <= 2; ++step) {
    const int b = (D + step) % 3;
    for (const int sb : {-1, 1}) {
      const int i1 = direction_of(D, 1, b, sb), i2 = direction_of(D, 1, b, -sb), side = direction_of(b, sb, -1, 0);
      to[k] = in.f + i1 * in.stride + run.first + offset(i1);  // from this cell to the far corner
      from[k++] = in.f + d3q19::opposite(i1) * in.stride + run.first;
      to[k] = in.f + i2 * in.stride + run.first + offset(along);  // from the cell beside to the cell ahead
      from[k++] = in.f + d3q19::opposite(i2) * in.stride + run.first + offset(side);
    }
  }
  const std::uint16_t* routes = in.routes[D] + run.first;
  const std::uint8_t* open = in.open[D] + run.first;
  double* mass = in.mass[D] + run.first;
  for (int n = 0; n < run.count; ++n) {
    const int code = routes[n];
    T sum = axis_to[n] - axis_from[n];
    for (int j = 0; j < 8; ++j) sum += T(0.5) * static_cast<T>((code >> (2 * j)) & 3) * (to[j][n] - from[j][n]);
    mass[n] = open[n] == 1 ? sign * static_cast<double>(sum) : 0.0;
  }
}

template <class T>
void fluxes(const FluxInput<T>& in) {
  for (int r = in.first_run; r < in.last_run; ++r) {
    const Run& run = in.runs[r];
    face_fluxes_of_run<T, 0>(in, run);
    face_fluxes_of_run<T, 1>(in, run);
    face_fluxes_of_run<T, 2>(in, run);
    const T* arrived[19];
    for (int i = 0; i < 19; ++i) {
      const int o = d3q19::opposite(i);
      const auto& b = d3q19::velocity[o];
      arrived[i] = in.next == Parity::even ? in.f + i * in.stride + run.first
                                           : in.f + o * in.stride + run.first + b[0] + run.shift[b[1] + 1][b[2] + 1];
    }
    double* density = in.density + run.first;
    for (int n = 0; n < run.count; ++n) {
      T sum = 0;
      for (int i = 0; i < 19; ++i) sum += arrived[i][n];
      density[n] = 1.0 + static_cast<double>(sum);
    }
  }
}

}  // namespace

// One unit per instruction set includes this file, each in its own namespace.
FluxKernel<float> fluxes_float() { return &fluxes<float>; }
FluxKernel<double> fluxes_double() { return &fluxes<double>; }
WallKernel<float> walls_float() { return &walls<float>; }
WallKernel<double> walls_double() { return &walls<double>; }
template <class T>
Kernel<T> kernel_of(Law law, bool rescale) {
  if (rescale) return &sweep<T, Rr3Rescaled>;
  switch (law) {
    case Law::bgk:
      return &sweep<T, Bgk>;
    case Law::trt:
      return &sweep<T, Trt>;
    case Law::central_moments:
      return &sweep<T, CentralMoments>;
    case Law::rr3:
      break;
  }
  return &sweep<T, Rr3>;
}
Kernel<float> kernel_float(Law law, bool rescale) { return kernel_of<float>(law, rescale); }
Kernel<double> kernel_double(Law law, bool rescale) { return kernel_of<double>(law, rescale); }

}  // namespace puffin::lbm::PUFFIN_ISA
