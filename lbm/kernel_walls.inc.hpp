// Reflection at the walls, part of a kernel unit (kernel_isa.inc.hpp).

/// The links of one wall run, in the order of their directions (links.hpp has the equations).
template <class T>
struct WallLinks {
  const T* out[18];         // what left the cell
  const T* partner[18];     // what helps to interpolate
  const float* weight[18];  // of the partner
  const float* moving[18];
  const float* returned[18];
  T* back[18];  // where the reflected population goes
  T* rest;      // population at rest: takes the imbalance
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
  links.rest = in.f + wall.first;
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
    links.returned[k] = wall.moving ? in.returned + at : nullptr;
  }
}

/// Reflection for cell n of the wall run and those after it, as many as `load` and `store` take.
template <class V, class T>
[[gnu::always_inline]] inline void reflect(const WallLinks<T>& links, bool moving, T speed, int n, const auto& load,
                                           const auto& store) {
  V imbalance = constant<V>(0);
  for (int k = 0; k < links.count; ++k) {
    const V out = load(links.out[k] + n);
    V change = load(links.weight[k] + n) * (load(links.partner[k] + n) - out);
    imbalance = imbalance - change;
    if (moving) {
      imbalance = imbalance - V(speed) * load(links.returned[k] + n);
      change = change + V(speed) * load(links.moving[k] + n);
    }
    store(out + change, links.back[k] + n);
  }
  store(load(links.rest + n) + imbalance, links.rest + n);
}
/// For a whole pack.
template <class T>
[[gnu::always_inline]] inline void reflect_pack(const WallLinks<T>& links, bool moving, T speed, int n) {
  using P = Pack<T>;
  const auto load = []<class S>(const S* p) __attribute__((always_inline)) {
    if constexpr (std::is_same_v<S, T>)
      return P(p, stdx::element_aligned);
    else
      return load_float<T>(p);
  };
  const auto store = [](const P& v, T* p) __attribute__((always_inline)) { v.copy_to(p, stdx::element_aligned); };
  reflect<P>(links, moving, speed, n, load, store);
}
/// For the last `count` cells of a wall run, fewer than a pack.
template <class T>
[[gnu::always_inline]] inline void reflect_rest(const WallLinks<T>& links, bool moving, T speed, int n, int count) {
#ifdef __AVX512F__
  const auto lanes = lane_set<T>((1U << count) - 1U);
  const auto load = [lanes](const auto* p) __attribute__((always_inline)) { return load_lanes(p, lanes); };
  const auto store = [lanes](const Pack<T>& v, T* p) __attribute__((always_inline)) { store_lanes(v, lanes, p); };
  reflect<Pack<T>>(links, moving, speed, n, load, store);
#else
  const auto load = [](const auto* p) __attribute__((always_inline)) { return static_cast<T>(*p); };
  const auto store = [](T v, T * p) __attribute__((always_inline)) { *p = v; };
  for (const int end = n + count; n < end; ++n) reflect<T>(links, moving, speed, n, load, store);
#endif
}

/// Values at scattered places, and back.
template <class T>
[[gnu::always_inline]] inline Pack<T> gather(const T* base, const std::int32_t* at) {
#ifdef __AVX512F__
  if constexpr (std::is_same_v<T, float>)
    return Pack<T>(_mm512_i32gather_ps(_mm512_loadu_si512(at), base, sizeof(T)));
  else
    return Pack<T>(_mm512_i32gather_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)), base, sizeof(T)));
#else
  return Pack<T>([ base, at ](auto l) __attribute__((always_inline)) { return base[at[l]]; });
#endif
}
template <class T>
[[gnu::always_inline]] inline void scatter(const Pack<T>& v, T* base, const std::int32_t* at) {
#ifdef __AVX512F__
  if constexpr (std::is_same_v<T, float>)
    _mm512_i32scatter_ps(base, _mm512_loadu_si512(at), static_cast<__m512>(v), sizeof(T));
  else
    _mm512_i32scatter_pd(base, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)), static_cast<__m512d>(v),
                         sizeof(T));
#else
  for (std::size_t l = 0; l < Pack<T>::size(); ++l) base[at[l]] = v[l];
#endif
}

/// Reflection for the cells of a group.
template <class T>
void reflect_group(const WallInput<T>& in, const WallGroup& group) {
  using P = Pack<T>;
  struct Link {
    const T *out, *partner;
    T* back;
    const std::int32_t *out_at, *partner_at, *back_at;
  };
  Link link[18];
  const int count = group.count;
  const bool even = in.parity == Parity::even;
  const std::int32_t* const slot = in.places + group.place;
  int links = 0;
  for (std::uint32_t bits = group.directions; bits != 0; bits &= bits - 1, ++links) {
    const int i = __builtin_ctz(bits), o = d3q19::opposite(i);
    T* const f_i = in.f + i * in.stride;
    T* const f_o = in.f + o * in.stride;
    const std::int32_t *const beyond = slot + (1 + 2 * links) * count, *const behind = beyond + count;
    // Places as in find_links.
    const bool own = ((group.far >> i & 1U) != 0) == even;
    link[links] = {even ? f_o : f_i,     own ? f_i : f_o,     even ? f_i : f_o,
                   even ? slot : beyond, own ? slot : behind, even ? beyond : slot};
  }
  const P speed(static_cast<T>(in.wall_speed));
  // The last cell is repeated until packs are full. Where few cells are left one by one is faster.
  int cells = count;
  while (cells > 1 && slot[cells - 1] == slot[cells - 2]) --cells;
  constexpr int width = static_cast<int>(P::size()), few = width / 3;
  int n = 0;
  for (; cells - n > few; n += width) {
    P imbalance(T(0));
    const float* partner = in.group_partner + group.coefficient + n;
    for (int k = 0; k < links; ++k) {
      const P out = gather(link[k].out, link[k].out_at + n);
      P change = load_float<T>(partner + k * count) * (gather(link[k].partner, link[k].partner_at + n) - out);
      imbalance = imbalance - change;
      if (group.moving) {
        const std::size_t at = group.coefficient + n + static_cast<std::size_t>(k) * count;
        imbalance = imbalance - speed * load_float<T>(in.group_returned + at);
        change = change + speed * load_float<T>(in.group_moving + at);
      }
      scatter(out + change, link[k].back, link[k].back_at + n);
    }
    scatter(gather(in.f, slot + n) + imbalance, in.f, slot + n);  // the population at rest takes the imbalance
  }
  for (; n < cells; ++n) {
    T imbalance = 0;
    for (int k = 0; k < links; ++k) {
      const std::size_t at = group.coefficient + n + static_cast<std::size_t>(k) * count;
      const T out = link[k].out[link[k].out_at[n]];
      T change = static_cast<T>(in.group_partner[at]) * (link[k].partner[link[k].partner_at[n]] - out);
      imbalance -= change;
      if (group.moving) {
        imbalance -= static_cast<T>(in.wall_speed) * static_cast<T>(in.group_returned[at]);
        change += static_cast<T>(in.wall_speed) * static_cast<T>(in.group_moving[at]);
      }
      link[k].back[link[k].back_at[n]] = out + change;
    }
    in.f[slot[n]] += imbalance;
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
    int n = 0;
    for (; n + width <= wall.count; n += width) reflect_pack(links, wall.moving, speed, n);
    if (n < wall.count) reflect_rest(links, wall.moving, speed, n, wall.count - n);
  }
  for (std::size_t g = in.first_group; g < in.last_group; ++g) reflect_group(in, in.groups[g]);
}
