// Collision and streaming of the runs of a chunk, part of a kernel unit (kernel_isa.inc.hpp). Packs are taken from the
// runs in order and treated in batches: all of a batch are read, then all relaxed, then all written, so that the square
// roots and divisions of one pack do not wait for those of another (docs/decisions/0004-batches-of-packs.md). A batch
// may span several runs, so short rows do not wait either. While one batch is computed the populations of the next are
// fetched, a few at a time between the computations: all at once they would only move the waiting to another place
// (docs/decisions/0005-where-the-air-waited.md).

template <class T, class L, bool Forced>
class Batch {
 public:
  using P = Pack<T>;
  static constexpr int width = static_cast<int>(P::size());

  explicit Batch(const KernelInput<T>& in) : work_(in) {}

  void add(const Run& run, std::uint8_t flags, Seen<P>& seen) {
    Places* places = &next_->runs[next_->run_count++];
    work_.find_places(run, places->from);
    int n = 0;
    for (; n + width <= run.count; n += width)
      put({places->from, run.first + n, n, 0, width, Fit::whole, flags}, places, seen);
    if (n == run.count) return;
    const int left = run.count - n;
    if (!masked && n > 0) {
      put({places->from, run.first + run.count - width, run.count - width, width - left, width, Fit::overlapping,
           flags},
          places, seen);
    } else if (joins && flags == 0 && pending_.end > 0 && pending_.end + left <= width) {
      Place<T> both{places->from, run.first + n, n, 0, left, Fit::joined, flags};
      next_->others[next_->count] = pending_places_;
      both.other = next_->others[next_->count].from;
      both.slot_other = pending_.slot - left;
      both.n_other = pending_.n - left;
      both.end_other = left + pending_.end;
      pending_.end = 0;
      put(both, places, seen);
    } else if (joins && flags == 0 && pending_.end == 0 && 2 * left <= width) {
      pending_places_ = *places;
      if (n == 0) --next_->run_count;  // no pack of this batch lies in the run
      pending_ = {nullptr, run.first + n, n, 0, left, Fit::beyond_end, flags};
    } else {
      put({places->from, run.first + n, n, 0, left, Fit::beyond_end, flags}, places, seen);
    }
  }

  void flush(Seen<P>& seen) {
    if (pending_.end > 0) {
      next_->others[next_->count] = pending_places_;
      pending_.from = next_->others[next_->count].from;
      Places* places = &pending_places_;
      put(pending_, places, seen);
      pending_.end = 0;
    }
    treat(*now_, *next_, seen);
    treat(*next_, Packs(), seen);
    now_->count = now_->run_count = next_->count = next_->run_count = 0;
  }

 private:
  static constexpr bool joins = masked && !Forced;
  static constexpr int size = masked ? 4 : 8;  // packs; their states stay in the first-level cache
  struct Places {
    T* from[19];
  };
  /// The packs of a batch, and the places of the runs that they lie in.
  struct Packs {
    Places runs[size + 1];
    Places others[size];  // of runs whose end is joined to that of another
    Place<T> place[size];
    int run_count = 0, count = 0;
  };

  [[gnu::always_inline]] void put(const Place<T>& place, Places*& places, Seen<P>& seen) {
    next_->place[next_->count++] = place;
    if (next_->count < size) return;
    treat(*now_, *next_, seen);
    std::swap(now_, next_);
    next_->count = 0;
    next_->run_count = 1;
    next_->runs[0] = *places;  // the run may go on
    places = &next_->runs[0];
  }

  /// Asks for directions [First, Last) of a pack of the next batch.
  template <int First, int Last>
  [[gnu::always_inline]] static void fetch(const Packs& next, int k) {
    if (k >= next.count) return;
    const Place<T>& p = next.place[k];
#pragma GCC unroll 19
    for (int i = First; i < Last; ++i) __builtin_prefetch(p.from[i] + p.n, 1, 3);
    if (!joins || p.fit != Fit::joined) return;
#pragma GCC unroll 19
    for (int i = First; i < Last; ++i) __builtin_prefetch(p.other[i] + p.n_other + p.end, 1, 3);
  }

  void treat(const Packs& packs, const Packs& next, Seen<P>& seen) {
    const int count = packs.count;
    const Place<T>* const place = packs.place;
    if constexpr (requires { &L::template relax<P>; }) {
      for (int k = 0; k < count; ++k) {
        if (joins && place[k].fit == Fit::joined)
          read_tail<Fit::joined>(place[k], state_[k]);
        else if (place[k].fit == Fit::beyond_end)
          read_tail<Fit::beyond_end>(place[k], state_[k]);
        else
          work_.template read<Fit::whole>(place[k], state_[k]);
      }
      for (int k = 0; k < count; ++k) {
        fetch<0, 6>(next, k);
        work_.stress(place[k], factor_[k], state_[k]);
      }
      for (int k = 0; k < count; ++k) {
        fetch<6, 10>(next, k);
        factor_[k] = work_.relax(factor_[k], state_[k]);
      }
      // Overlapping packs first: they keep lanes by loading them, and loads would wait for stores still on their way.
      for (int k = 0; k < count && !masked; ++k)
        if (place[k].fit == Fit::overlapping)
          work_.template finish<Fit::overlapping>(place[k], state_[k], factor_[k], seen);
      for (int k = 0; k < count; ++k) {
        fetch<10, 19>(next, k);
        if (place[k].fit == Fit::whole) work_.template finish<Fit::whole>(place[k], state_[k], factor_[k], seen);
        if (place[k].fit == Fit::beyond_end) finish_tail<Fit::beyond_end>(place[k], state_[k], factor_[k], seen);
        if (joins && place[k].fit == Fit::joined) finish_tail<Fit::joined>(place[k], state_[k], factor_[k], seen);
      }
    } else {
      for (int k = 0; k < count; ++k) {
        fetch<0, 19>(next, k);
        if (place[k].fit == Fit::whole) work_.template collide<Fit::whole>(place[k], seen);
        if (place[k].fit == Fit::beyond_end) work_.template collide<Fit::beyond_end>(place[k], seen);
        if (joins && place[k].fit == Fit::joined) work_.template collide<Fit::joined>(place[k], seen);
      }
      for (int k = 0; k < count && !masked; ++k)
        if (place[k].fit == Fit::overlapping) work_.template collide<Fit::overlapping>(place[k], seen);
    }
  }

  template <Fit fit>
  [[gnu::noinline]] void read_tail(const Place<T>& p, CellState<P>& state) const {
    work_.template read<fit>(p, state);
  }
  template <Fit fit>
  [[gnu::noinline]] void finish_tail(const Place<T>& p, const CellState<P>& state, const P& factor,
                                     Seen<P>& seen) const {
    work_.template finish<fit>(p, state, factor, seen);
  }

  PackWork<T, L, Forced> work_;
  Packs packs_[2];
  Packs *now_ = &packs_[0], *next_ = &packs_[1];  // while one is treated the other is gathered, and on its way
  Places pending_places_;
  Place<T> pending_{};  // the end of a run that waits for another to join; end = 0: none
  CellState<P> state_[size];
  P factor_[size];
};

template <class T, class L>
KernelReport sweep(const KernelInput<T>& in) {
  const FlushToZero flush;
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
