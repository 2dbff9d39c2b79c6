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

/// How a pack lies in its run: whole; over cells that the pack before it does (lanes below `skip`); beyond the end of
/// the run, where the lanes from `end` on belong to others, perhaps to another thread; or joined: the ends of two runs.
enum class Fit { whole, overlapping, beyond_end, joined };

/// One pack of cells: [n + skip, n + end) of a run. Direction i of the first cell of the run is found at from[i]: in
/// its own slots before an even step, in those of its neighbours before an odd one. What leaves in direction i goes
/// where the opposite one was found.
template <class T>
struct Place {
  T* const* from;
  std::ptrdiff_t slot;  // of lane 0
  int n, skip, end;
  Fit fit;
  std::uint8_t flags;
  // Joined: lane l of [end, end_other) is cell n_other + l of another run, with slot slot_other + l.
  T* const* other = nullptr;
  std::ptrdiff_t slot_other = 0;
  int n_other = 0, end_other = 0;
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

  [[gnu::always_inline]] void find_places(const Run& run, T* (&from)[19]) const {
    const std::ptrdiff_t* const shift = run.shift[0].data();
    if (in_.parity == Parity::even) {
#pragma GCC unroll 19
      for (int i = 0; i < 19; ++i) from[i] = base_[i] + run.first;
    } else {
#pragma GCC unroll 19
      for (int i = 0; i < 19; ++i) {
        const auto& c = d3q19::velocity[d3q19::opposite(i)];
        from[i] = base_[i] + run.first + shift[3 * (c[1] + 1) + c[2] + 1];
      }
    }
  }

  /// Reads a pack of cells.
  template <Fit fit>
  [[gnu::always_inline]] void read(const Place<T>& p, CellState<P>& state) const {
    const Lanes mine = lanes<fit>(p);
    read_moments(
        [&](auto i) __attribute__((always_inline)) { return load<fit>(p, i, mine); }, state);
  }
  [[gnu::always_inline]] void stress(const Place<T>& p, P& les, CellState<P>& state) const {
    P force[3];
    force_at(p, L::old_force(constants_), force);
    les = at_cells(p, in_.les);
    find_stress<Forced>(force, les, state);
    if constexpr (requires { &L::template blend<P>; }) {
      P strain[6];
      for (int n = 0; n < 6; ++n) strain[n] = at_cells(p, in_.strain[n]);
      L::blend(constants_, les, strain, state);
    }
  }
  /// 1 - omega; the state is changed where the time step changes.
  [[gnu::always_inline]] P relax(const P& les, CellState<P>& state) const { return L::relax(constants_, les, state); }

  /// Writes a pack of cells.
  template <Fit fit>
  [[gnu::always_inline]] void finish(const Place<T>& p, const CellState<P>& unrelaxed, const P& factor,
                                     Seen<P>& seen) const {
    const Lanes mine = lanes<fit>(p);
    CellState<P> s = unrelaxed;
    for (auto& n : s.p) n = n * factor;
    P force[3];
    force_at(p, 1.0, force);
    // Positivity, f_i >= w_i/10: the smallest g_i over axes and over diagonals decides. The populations are stored at
    // once; in the rare case they are made again from the state, which is still here.
    P rest, axis, diagonal;
    L::template assemble<Forced>(
        s, force, [&](auto i, const P& v) __attribute__((always_inline)) {
          store<fit>(p, i, mine, v);
          if constexpr (i == 0) rest = v;
          if constexpr (i == 1) axis = v;
          if constexpr (i == 7) diagonal = v;
          if constexpr (i > 1 && i < 7) axis = minimum(axis, v);
          if constexpr (i > 7) diagonal = minimum(diagonal, v);
        });
    const P lowest = minimum(minimum(rest * P(T(3)), axis * P(T(18))), diagonal * P(T(36)));
    Mask negative = lowest < P(T(-0.9));
    if constexpr (fit != Fit::whole) negative = negative && mine.all;
    if (stdx::any_of(negative)) [[unlikely]]
      seen.limited += write_limited<fit>(p, s, negative);
    look<fit>(p, CellMoments<P>{s.drho, s.u[0], s.u[1], s.u[2]}, mine, seen);
  }
  /// All at once, for laws that relax populations.
  template <Fit fit>
  [[gnu::always_inline]] void collide(const Place<T>& p, Seen<P>& seen) const {
    const Lanes mine = lanes<fit>(p);
    P force[3];
    force_at(p, 1.0, force);
    const P les = at_cells(p, in_.les);
    const auto m = L::template collide<Forced>(
        [&](auto i) __attribute__((always_inline)) { return load<fit>(p, i, mine); },
        [&](auto i, const P& v) __attribute__((always_inline)) { store<fit>(p, i, mine, v); }, force, constants_, les);
    look<fit>(p, m, mine, seen);
  }

 private:
  /// The lanes that are cells of this pack, and those of its first run.
  struct Lanes {
    Mask all, first;
  };
  template <Fit fit>
  [[gnu::always_inline]] static Lanes lanes(const Place<T>& p) {
    if constexpr (fit == Fit::whole) return {Mask(true), Mask(true)};
    const P lane([](auto l) { return static_cast<T>(static_cast<int>(l)); });
    const Mask first = lane >= P(T(p.skip)) && lane < P(T(p.end));
    return {fit == Fit::joined ? lane < P(T(p.end_other)) : first, first};
  }
  template <Fit fit>
  [[gnu::always_inline]] static P load(const Place<T>& p, int i, const Lanes& mine) {
    if constexpr (fit == Fit::beyond_end || fit == Fit::joined) {
      P v(T(0));
      where(mine.first, v).copy_from(p.from[i] + p.n, stdx::element_aligned);
      if constexpr (fit == Fit::joined)
        where(mine.all && !mine.first, v).copy_from(p.other[i] + p.n_other, stdx::element_aligned);
      return v;
    } else {
      return P(p.from[i] + p.n, stdx::element_aligned);
    }
  }
  template <Fit fit>
  [[gnu::always_inline]] static void store(const Place<T>& p, int i, const Lanes& mine, const P& v) {
    T* const to = p.from[d3q19::opposite(i)] + p.n;
    if constexpr (fit == Fit::whole) v.copy_to(to, stdx::element_aligned);
    if constexpr (fit == Fit::beyond_end || fit == Fit::joined) where(mine.first, v).copy_to(to, stdx::element_aligned);
    if constexpr (fit == Fit::joined)
      where(mine.all && !mine.first, v).copy_to(p.other[d3q19::opposite(i)] + p.n_other, stdx::element_aligned);
    if constexpr (fit == Fit::overlapping) {  // cheaper than a masked store, and all lanes are this run's own
      P kept(to, stdx::element_aligned);
      where(mine.all, kept) = v;
      kept.copy_to(to, stdx::element_aligned);
    }
  }
  /// Values of an array over slots.
  [[gnu::always_inline]] static P at_cells(const Place<T>& p, const float* values) {
    P v = load_float<T>(values + p.slot);
    if (p.fit == Fit::joined) {
      const P lane([](auto l) { return static_cast<T>(static_cast<int>(l)); });
      where(lane >= P(T(p.end)), v) = load_float<T>(values + p.slot_other);
    }
    return v;
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

  template <Fit fit>
  [[gnu::noinline, gnu::cold]] int write_limited(const Place<T>& p, CellState<P> s, const Mask& negative) const {
    P force[3];
    force_at(p, 1.0, force);
    limit_stress<L, Forced>(force, s);
    const Lanes mine = lanes<fit>(p);
    L::template assemble<Forced>(s, force, [&](auto i, const P& v) { store<fit>(p, i, mine, v); });
    return stdx::popcount(negative);
  }
  template <Fit fit>
  [[gnu::always_inline]] void look(const Place<T>& p, CellMoments<P> m, const Lanes& mine, Seen<P>& seen) const {
    if constexpr (fit != Fit::whole)
      for (P* v : {&m.density_excess, &m.ux, &m.uy, &m.uz}) where(!mine.all, *v) = P(T(0));
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
};
