// What is done with one pack of cells, part of a kernel unit (kernel_isa.inc.hpp): read, relax, write, look.

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

/// How a pack lies among the cells. Without masks (masked = false) it belongs to one run: whole; over cells that the
/// pack before it does (lanes below `skip`); or beyond the end of the run, where the lanes from `end` on belong to
/// others, perhaps to another thread. With masks it lies anywhere in a span of runs: those of its lanes that are cells.
enum class Fit { whole, overlapping, beyond_end, lanes };

/// One pack of slots. Direction i of slot `origin` is found at from[i]: in its own slots before an even step, in those
/// of its neighbours before an odd one. What leaves in direction i goes where the opposite one was found.
template <class T>
struct Place {
  T* const* from;
  std::ptrdiff_t slot;  // of lane 0
  int n;                // from `origin`
  int skip, end;        // lanes [skip, end) are cells of this pack
  std::uint32_t lanes;  // or those whose bits are set
  Fit fit;
  std::uint8_t flags;
};

/// Reads and writes packs, for one law.
template <class T, class L, bool Forced>
class PackWork {
 public:
  using P = Pack<T>;
  using Mask = typename P::mask_type;
  static constexpr int width = static_cast<int>(P::size());

  explicit PackWork(const KernelInput<T>& in) : in_(in), constants_(in.constants) {
    for (int i = 0; i < 19; ++i) {
      const int o = d3q19::opposite(i);
      base_[i] = in.parity == Parity::even ? in.f + i * in.stride : in.f + o * in.stride + d3q19::velocity[o][0];
    }
  }

  /// Where the directions of slot `origin` are found; the slot and its neighbours as in `run`.
  [[gnu::always_inline]] void find_places(const Run& run, std::ptrdiff_t origin, T* (&from)[19]) const {
    const std::ptrdiff_t* const shift = run.shift[0].data();
    if (in_.parity == Parity::even) {
#pragma GCC unroll 19
      for (int i = 0; i < 19; ++i) from[i] = base_[i] + origin;
    } else {
#pragma GCC unroll 19
      for (int i = 0; i < 19; ++i) {
        const auto& c = d3q19::velocity[d3q19::opposite(i)];
        from[i] = base_[i] + origin + shift[3 * (c[1] + 1) + c[2] + 1];
      }
    }
  }

  /// Reads a pack of cells.
  template <Fit fit>
  [[gnu::always_inline]] void read(const Place<T>& p, CellState<P>& state) const {
    const auto mine = lanes<fit>(p);
    read_moments(
        [&](auto i) __attribute__((always_inline)) { return load<fit>(p, i, mine); }, state);
  }
  /// From sums to velocity and stress. `les` over the density on return.
  [[gnu::always_inline]] void stress(const Place<T>& p, P& les, CellState<P>& state) const {
    P force[3];
    force_at(p, L::old_force(constants_), force);
    P length = load_float<T>(in_.les + p.slot);
    find_stress<Forced>(force, length, state);
    if constexpr (requires { &L::template blend<P>; }) {
      P strain[6];
      for (int n = 0; n < 6; ++n) strain[n] = load_float<T>(in_.strain[n] + p.slot);
      L::blend(constants_, length, strain, state);
    }
    les = length;
  }
  /// 1 - omega; the state is changed where the time step changes.
  [[gnu::always_inline]] P relax(const P& les, CellState<P>& state, P& stress2) const {
    return L::relax(constants_, les, state, stress2);
  }

  /// Writes a pack of cells.
  template <Fit fit>
  [[gnu::always_inline]] void finish(const Place<T>& place, const CellState<P>& unrelaxed, const P& factor,
                                     const P& stress2, Seen<P>& seen) const {
    const Place<T> p{place.from, place.slot, place.n, place.skip, place.end, place.lanes, place.fit, place.flags};
    const auto mine = lanes<fit>(p);
    const CellState<P> s = relaxed(unrelaxed, factor);  // given to no function that is called: it stays in registers
    P force[3];
    force_at(p, 1.0, force);
    const CellMoments<P> m{s.drho, s.u[0], s.u[1], s.u[2]};
    const P speed2 = m.ux * m.ux + m.uy * m.uy + m.uz * m.uz;
    // Positivity, f_i >= w_i/10. The populations are stored at once; in the rare case they are made again from the
    // state.
    if constexpr (!Forced && requires { L::positive_near_rest; }) {
      L::template assemble<Forced>(
          s, force, [&](auto i, const P& v) __attribute__((always_inline)) { store<fit>(p, i, mine, v); });
      if (!all_below(distance_from_rest(s.drho, speed2, stress2), T(1), mine)) [[unlikely]] {
        seen.limited += write_limited<fit>(place, unrelaxed, factor);
      }
    } else {
      P rest, axis, diagonal;
      L::template assemble<Forced>(
          s, force, [&](auto i, const P& v) __attribute__((always_inline)) {
            store<fit>(p, i, mine, v);
            take_lowest(i, v, rest, axis, diagonal);
          });
      if (count_below(lowest(rest, axis, diagonal), T(-0.9), mine) > 0) [[unlikely]]
        seen.limited += write_limited<fit>(place, unrelaxed, factor);
    }
    look<fit>(p, m, speed2, mine, seen);
  }
  /// All at once, for laws that relax populations.
  template <Fit fit>
  [[gnu::always_inline]] void collide(const Place<T>& p, Seen<P>& seen) const {
    const auto mine = lanes<fit>(p);
    P force[3];
    force_at(p, 1.0, force);
    const P les = load_float<T>(in_.les + p.slot);
    const auto m = L::template collide<Forced>(
        [&](auto i) __attribute__((always_inline)) { return load<fit>(p, i, mine); },
        [&](auto i, const P& v) __attribute__((always_inline)) { store<fit>(p, i, mine, v); }, force, constants_, les);
    look<fit>(p, m, m.ux * m.ux + m.uy * m.uy + m.uz * m.uz, mine, seen);
  }

 private:
  /// The lanes that are cells of this pack.
  template <Fit fit>
  [[gnu::always_inline]] static auto lanes(const Place<T>& p) {
    if constexpr (fit == Fit::lanes) {
      return lane_set<T>(p.lanes);
    } else if constexpr (fit == Fit::whole) {
      return Mask(true);
    } else {
      const P lane([](auto l) { return static_cast<T>(static_cast<int>(l)); });
      return Mask(lane >= P(T(p.skip)) && lane < P(T(p.end)));
    }
  }
  /// Lanes that are no cells are read too where others may be writing them; nothing is made of them.
  template <Fit fit>
  [[gnu::always_inline]] static P load(const Place<T>& p, int i, const auto& mine) {
    if constexpr (fit == Fit::beyond_end) {
      P v(T(0));
      where(mine, v).copy_from(p.from[i] + p.n, stdx::element_aligned);
      return v;
    } else {
      return P(p.from[i] + p.n, stdx::element_aligned);
    }
  }
  template <Fit fit>
  [[gnu::always_inline]] static void store(const Place<T>& p, int i, const auto& mine, const P& v) {
    T* const to = p.from[d3q19::opposite(i)] + p.n;
    if constexpr (fit == Fit::whole) v.copy_to(to, stdx::element_aligned);
    if constexpr (fit == Fit::lanes) store_lanes(v, mine, to);
    if constexpr (fit == Fit::beyond_end) where(mine, v).copy_to(to, stdx::element_aligned);
    if constexpr (fit == Fit::overlapping) {  // cheaper than a masked store, and all lanes are this run's own
      P kept(to, stdx::element_aligned);
      where(mine, kept) = v;
      kept.copy_to(to, stdx::element_aligned);
    }
  }
  [[gnu::always_inline]] void force_at(const Place<T>& p, double factor, P (&force)[3]) const {
    each<3>([&](auto d) __attribute__((always_inline)) {
      if constexpr (Forced) {
        P f(T(in_.uniform_force[d]));
        if (p.flags & run_forced) f = f + load_float<T>(in_.force[d] + p.slot);
        force[d] = f * P(T(factor));
      } else {
        force[d] = P(T(0));
      }
    });
  }

  [[gnu::always_inline]] static CellState<P> relaxed(const CellState<P>& state, const P& factor) {
    const auto& [drho, j, u, p] = state;  // member by member: a copy of the whole would be made in memory
    return {drho,
            {j[0], j[1], j[2]},
            {u[0], u[1], u[2]},
            {p[0] * factor, p[1] * factor, p[2] * factor, p[3] * factor, p[4] * factor, p[5] * factor}};
  }
  /// Writes the populations of a pack anew in the cells in which the limiter acts; returns how many. The others keep
  /// theirs to the last bit: what a cell becomes does not depend on the cells that share its pack.
  template <Fit fit>
  [[gnu::noinline, gnu::cold]] int write_limited(const Place<T>& p, const CellState<P>& unrelaxed,
                                                 const P& factor) const {
    CellState<P> s = relaxed(unrelaxed, factor);
    P force[3], rest, axis, diagonal, limited[19];
    force_at(p, 1.0, force);
    L::template assemble<Forced>(s, force, [&](auto i, const P& v) { take_lowest(i, v, rest, axis, diagonal); });
    const P low = lowest(rest, axis, diagonal);
    limit_stress<L, Forced>(force, s);
    L::template assemble<Forced>(s, force, [&](auto i, const P& v) { limited[i] = v; });
    int cells = 0;
    for (int l = 0; l < width; ++l) {
      const bool mine = fit == Fit::lanes ? (p.lanes >> l & 1U) != 0 : l >= p.skip && l < p.end;
      if (!mine || !(low[l] < T(-0.9))) continue;
      for (int i = 0; i < d3q19::q; ++i) p.from[d3q19::opposite(i)][p.n + l] = limited[i][l];
      ++cells;
    }
    return cells;
  }
  /// The smallest g_i of the axes, and of the diagonals.
  template <int I>
  [[gnu::always_inline]] static void take_lowest(Index<I>, const P& v, P& rest, P& axis, P& diagonal) {
    if constexpr (I == 0) rest = v;
    if constexpr (I == 1) axis = v;
    if constexpr (I == 7) diagonal = v;
    if constexpr (I > 1 && I < 7) axis = minimum(axis, v);
    if constexpr (I > 7) diagonal = minimum(diagonal, v);
  }
  /// The smallest g_i/w_i.
  [[gnu::always_inline]] static P lowest(const P& rest, const P& axis, const P& diagonal) {
    return minimum(minimum(rest * P(T(3)), axis * P(T(18))), diagonal * P(T(36)));
  }
  template <Fit fit>
  [[gnu::always_inline]] void look(const Place<T>& p, const CellMoments<P>& m, P speed2, const auto& mine,
                                   Seen<P>& seen) const {
    P drho = m.density_excess;
    if constexpr (fit != Fit::whole) {
      speed2 = only(speed2, mine);
      drho = only(drho, mine);
    }
    seen.max_speed2 = maximum(speed2, seen.max_speed2);
    seen.min_drho = minimum(drho, seen.min_drho);
    seen.max_drho = maximum(drho, seen.max_drho);
    seen.not_a_number = seen.not_a_number + speed2;  // a sum forgets no NaN, a maximum does
    if (!(p.flags & run_moments)) return;
    const P* value[4] = {&m.density_excess, &m.ux, &m.uy, &m.uz};
    if constexpr (fit == Fit::lanes) {
      for (int k = 0; k < 4; ++k) store_lanes(*value[k], mine, in_.moments[k] + p.slot);
      return;
    }
    alignas(stdx::memory_alignment_v<P>) T buffer[width];
    for (int k = 0; k < 4; ++k) {
      value[k]->copy_to(buffer, stdx::vector_aligned);
      for (int l = p.skip; l < p.end; ++l) in_.moments[k][p.slot + l] = static_cast<float>(buffer[l]);
    }
  }

  const KernelInput<T>& in_;
  const CollisionConstants constants_;
  T* base_[19];  // where direction i of slot 0 would be found, less the shift of its row
};
