// Reflection at the walls, part of a kernel unit (kernel_isa.inc.hpp).

/// The links of one wall run, in the order of their directions (links.hpp has the equations).
template <class T>
struct WallLinks {
  const T* out[18];         // what left the cell
  const T* partner[18];     // what helps to interpolate
  const float* weight[18];  // of the partner
  const float* moving[18];
  T* back[18];  // where the reflected population goes
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
