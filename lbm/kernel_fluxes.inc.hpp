// Mass fluxes through the faces of cells, part of a kernel unit (kernel_isa.inc.hpp).

/// Direction of D3Q19 along +-d and +-b (b = -1: along d alone).
constexpr int direction_of(int d, int sd, int b, int sb) {
  for (int i = 0; i < 19; ++i) {
    bool same = true;
    for (int a = 0; a < 3; ++a) same = same && d3q19::velocity[i][a] == (a == d ? sd : (a == b ? sb : 0));
    if (same) return i;
  }
  return 0;
}

template <class P>
[[gnu::always_inline]] inline void store_as_double(const P& v, double* to) {
  alignas(stdx::memory_alignment_v<P>) typename P::value_type buffer[P::size()];
  v.copy_to(buffer, stdx::vector_aligned);
  for (std::size_t l = 0; l < P::size(); ++l) to[l] = static_cast<double>(buffer[l]);
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
  const auto one = [&](int n) {
    const int code = routes[n];
    T sum = axis_to[n] - axis_from[n];
    for (int j = 0; j < 8; ++j) sum += T(0.5) * static_cast<T>((code >> (2 * j)) & 3) * (to[j][n] - from[j][n]);
    mass[n] = open[n] == 1 ? sign * static_cast<double>(sum) : 0.0;
  };
  using P = Pack<T>;
  constexpr int width = static_cast<int>(P::size());
  const auto load = [](const T* p) __attribute__((always_inline)) { return P(p, stdx::element_aligned); };
  constexpr std::uint16_t all_halves = 0x5555;  // away from walls: a half of each diagonal
  int n = 0;
  for (; n + width <= run.count; n += width) {
    if (!std::all_of(routes + n, routes + n + width, [](std::uint16_t code) { return code == all_halves; })) {
      for (int l = 0; l < width; ++l) one(n + l);
      continue;
    }
    P sum = load(axis_to + n) - load(axis_from + n);
    for (int j = 0; j < 8; ++j) sum = sum + P(T(0.5)) * (load(to[j] + n) - load(from[j] + n));
    store_as_double(sum * P(static_cast<T>(sign)), mass + n);
  }
  for (; n < run.count; ++n) one(n);
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
    using P = Pack<T>;
    constexpr int width = static_cast<int>(P::size());
    int n = 0;
    for (; n + width <= run.count; n += width) {
      P sum(T(0));
      for (int i = 0; i < 19; ++i) sum = sum + P(arrived[i] + n, stdx::element_aligned);
      store_as_double(sum, density + n);
      for (int l = 0; l < width; ++l) density[n + l] += 1.0;
    }
    for (; n < run.count; ++n) {
      T sum = 0;
      for (int i = 0; i < 19; ++i) sum += arrived[i][n];
      density[n] = 1.0 + static_cast<double>(sum);
    }
  }
}
