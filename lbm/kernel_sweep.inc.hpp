// Collision and streaming of the runs of a chunk, part of a kernel unit (kernel_isa.inc.hpp). Packs are taken from the
// runs in order and go through a pipeline: while one is read, the one before it is given its stress, the one before
// that its relaxation time, and a fourth is written. So no instruction waits for the square roots and divisions of its
// own pack: what a stage needs was ready when the stage before it ended, a hundred cycles ago. Packs of several runs
// follow each other without a gap. See docs/decisions/0024-packs-across-rows.md.

template <class T, class L, bool Forced>
class Pipeline {
 public:
  using P = Pack<T>;
  static constexpr int width = static_cast<int>(P::size());

  explicit Pipeline(const KernelInput<T>& in) : work_(in) {}

  /// The cells of one run, without masks: the last pack overlaps the one before it.
  void add(const Run& run, std::uint8_t flags, Seen<P>& seen) {
    T* const* const from = find_places(run, run.first);
    int n = 0;
    for (; n + width <= run.count; n += width) put({from, run.first + n, n, 0, width, 0, Fit::whole, flags}, seen);
    if (n == run.count) return;
    const int left = run.count - n;
    if (n > 0)
      put({from, run.first + run.count - width, run.count - width, width - left, width, 0, Fit::overlapping, flags},
          seen);
    else
      put({from, run.first, 0, 0, left, 0, Fit::beyond_end, flags}, seen);
  }

  /// The cells from the first of one run to the last of another of the same span, in packs that lie on cache lines.
  void add_span(const Run& first, const Run& last, const std::uint16_t* active, std::uint8_t flags, Seen<P>& seen) {
    const std::ptrdiff_t origin = first.first / width * width, end = last.first + last.count;
    T* const* const from = find_places(first, origin);
    for (std::ptrdiff_t s = origin; s < end; s += width) {
      std::uint32_t lanes = active[s / 16] >> s % 16 & ((1U << width) - 1U);
      if (s < first.first) lanes &= ~0U << (first.first - s);
      if (s + width > end) lanes &= (1U << (end - s)) - 1U;
      if (lanes != 0) put({from, s, static_cast<int>(s - origin), 0, width, lanes, Fit::lanes, flags}, seen);
    }
  }

  /// To the end with all packs on their way.
  void flush(Seen<P>& seen) {
    while (tick_ < count_ + depth) advance(seen);
    tick_ = count_ = 0;
  }

 private:
  // Packs between fetching and reading. Long spans are fetched by the processor itself.
  static constexpr int ahead = masked ? 0 : 3;
  static constexpr int depth = ahead + 3;  // between fetching and writing
  static constexpr int ring = 8;           // places of packs on their way
  static constexpr int states = 4;         // states of packs between reading and writing
  static_assert(depth < ring);

  T* const* find_places(const Run& run, std::ptrdiff_t origin) {
    auto& from = from_[spans_++ % (ring + 1)];
    work_.find_places(run, origin, from);
    return from;
  }

  [[gnu::always_inline]] void put(const Place<T>& place, Seen<P>& seen) {
    place_[count_++ % ring] = place;
    advance(seen);
  }

  /// Every pack on its way goes one stage further, the last one first.
  [[gnu::noinline]] void advance(Seen<P>& seen) {
    const unsigned tick = tick_++, count = count_;
    const auto stage = [&](unsigned behind, const auto& body) __attribute__((always_inline)) {
      const unsigned k = tick - behind;
      if (k < count) body(k);  // not before the first one (k has wrapped around) and not after the last
    };
    if constexpr (requires { &L::template relax<P>; }) {
      stage(
          ahead + 3, [&](unsigned k) __attribute__((always_inline)) { finish(k, seen); });
      stage(
          ahead + 2, [&](unsigned k) __attribute__((always_inline)) {
            const unsigned n = k % states;
            factor_[n] = work_.relax(factor_[n], state_[n], stress2_[n]);
          });
      stage(
          ahead + 1, [&](unsigned k) __attribute__((always_inline)) {
            work_.stress(place_[k % ring], factor_[k % states], state_[k % states]);
          });
      stage(
          ahead, [&](unsigned k) __attribute__((always_inline)) { read(k); });
    } else {
      stage(
          ahead, [&](unsigned k) __attribute__((always_inline)) { collide(k, seen); });
    }
    if constexpr (ahead > 0)
      stage(
          0, [&](unsigned k) __attribute__((always_inline)) {
            const Place<T>& p = place_[k % ring];
#pragma GCC unroll 19
            for (int i = 0; i < 19; ++i) __builtin_prefetch(p.from[i] + p.n, 1, 3);
          });
  }

  [[gnu::always_inline]] void read(unsigned k) {
    const Place<T>& p = place_[k % ring];
    CellState<P>& state = state_[k % states];
    if constexpr (masked)
      work_.template read<Fit::lanes>(p, state);
    else if (p.fit == Fit::beyond_end)
      read_tail(p, state);
    else
      work_.template read<Fit::whole>(p, state);
  }
  [[gnu::always_inline]] void finish(unsigned k, Seen<P>& seen) {
    const Place<T>& p = place_[k % ring];
    const unsigned n = k % states;
    if constexpr (masked)
      work_.template finish<Fit::lanes>(p, state_[n], factor_[n], stress2_[n], seen);
    else if (p.fit == Fit::whole)
      work_.template finish<Fit::whole>(p, state_[n], factor_[n], stress2_[n], seen);
    else if (p.fit == Fit::overlapping)
      finish_tail<Fit::overlapping>(p, n, seen);
    else
      finish_tail<Fit::beyond_end>(p, n, seen);
  }
  [[gnu::always_inline]] void collide(unsigned k, Seen<P>& seen) {
    const Place<T>& p = place_[k % ring];
    if constexpr (masked)
      work_.template collide<Fit::lanes>(p, seen);
    else if (p.fit == Fit::whole)
      work_.template collide<Fit::whole>(p, seen);
    else if (p.fit == Fit::overlapping)
      work_.template collide<Fit::overlapping>(p, seen);
    else
      work_.template collide<Fit::beyond_end>(p, seen);
  }
  [[gnu::noinline]] void read_tail(const Place<T>& p, CellState<P>& state) const {
    work_.template read<Fit::beyond_end>(p, state);
  }
  template <Fit fit>
  [[gnu::noinline]] void finish_tail(const Place<T>& p, unsigned n, Seen<P>& seen) const {
    work_.template finish<fit>(p, state_[n], factor_[n], stress2_[n], seen);
  }

  PackWork<T, L, Forced> work_;
  T* from_[ring + 1][19];  // places of the spans or runs that packs on their way lie in
  Place<T> place_[ring];
  CellState<P> state_[states];
  P factor_[states], stress2_[states];  // first what the eddy viscosity is made of, then 1 - omega
  unsigned spans_ = 0, count_ = 0, tick_ = 0;
};

template <class T, class L>
KernelReport sweep(const KernelInput<T>& in) {
  const FlushToZero flush;
  Seen<Pack<T>> seen;
  Pipeline<T, L, true> forced(in);
  Pipeline<T, L, false> free(in);
  for (int r = in.first_run; r < in.last_run; ++r) {
    const std::uint8_t flags = in.run_flags[r];
    const Run& first = in.runs[r];
    const auto add = [&](auto& pipeline) {
      if constexpr (masked) {
        while (r + 1 < in.last_run && in.runs[r + 1].span == first.span && in.run_flags[r + 1] == flags) ++r;
        pipeline.add_span(first, in.runs[r], in.active_lanes, flags, seen);
      } else {
        pipeline.add(first, flags, seen);
      }
    };
    if (in.forced_everywhere || (flags & run_forced))
      add(forced);
    else
      add(free);
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
