// Collision and streaming, part of a kernel unit (kernel_isa.inc.hpp): batches of packs of cells.

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
    if constexpr (requires { &L::template blend<P>; }) {
      P strain[6];
      for (int n = 0; n < 6; ++n) strain[n] = load_float<T>(in_.strain[n] + p.slot);
      L::blend(constants_, les, strain, state);
    }
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
