// Velocities of the cells and their gradients, part of a kernel unit (kernel_isa.inc.hpp).

/// One cell or one pack of cells from slot s on.
template <class V, class T>
[[gnu::always_inline]] inline void velocity_at(const VelocityInput<T>& in, const T* const (&arrived)[19], int n,
                                               std::ptrdiff_t slot) {
  V f[19];
  for (int i = 0; i < 19; ++i) {
    if constexpr (std::is_same_v<V, T>)
      f[i] = arrived[i][n];
    else
      f[i].copy_from(arrived[i] + n, stdx::element_aligned);
  }
  const V none[3] = {constant<V>(0), constant<V>(0), constant<V>(0)};
  const auto m = moments_of(hydrodynamics<false>(
      [&](auto i) __attribute__((always_inline)) { return f[i]; }, none));
  const V* value[4] = {&m.density_excess, &m.ux, &m.uy, &m.uz};
  for (int k = 0; k < 4; ++k) {
    float* const to = in.moments[k] + slot;
    if constexpr (std::is_same_v<V, T>)
      *to = static_cast<float>(*value[k]);
    else
      value[k]->copy_to(to, stdx::element_aligned);
  }
}

template <class T>
void velocities(const VelocityInput<T>& in) {
  using P = Pack<T>;
  constexpr int width = static_cast<int>(P::size());
  for (int r = in.first_run; r < in.last_run; ++r) {
    const Run& run = in.runs[r];
    const T* arrived[19];
    for (int i = 0; i < 19; ++i) {
      const int o = d3q19::opposite(i);
      const auto& b = d3q19::velocity[o];
      arrived[i] = in.next == Parity::even ? in.f + i * in.stride + run.first
                                           : in.f + o * in.stride + run.first + b[0] + run.shift[b[1] + 1][b[2] + 1];
    }
    // The last pack overlaps the one before it: it finds the same values again.
    if (run.count < width)
      for (int n = 0; n < run.count; ++n) velocity_at<T>(in, arrived, n, run.first + n);
    else
      for (int n = 0; n < run.count; n += width) {
        const int at = std::min(n, run.count - width);
        velocity_at<P>(in, arrived, at, run.first + at);
      }
  }
}

template <class V>
[[gnu::always_inline]] inline void gradient_at(const GradientInput& in, const Run& run, std::ptrdiff_t slot) {
  // One step along +x, +y, +z and along -x, -y, -z.
  const std::ptrdiff_t up[3] = {1, run.shift[2][1], run.shift[1][2]}, down[3] = {-1, run.shift[0][1], run.shift[1][0]};
  const auto load = [](const float* p) __attribute__((always_inline)) {
    if constexpr (std::is_same_v<V, float>)
      return *p;
    else
      return V(p, stdx::element_aligned);
  };
  const auto store = [](const V& v, float* p) __attribute__((always_inline)) {
    if constexpr (std::is_same_v<V, float>)
      *p = v;
    else
      v.copy_to(p, stdx::element_aligned);
  };
  V g[3][3];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const float* u = in.moments[1 + b] + slot;
      g[a][b] = constant<V>(0.5) * (load(u + up[a]) - load(u + down[a]));
    }
  if (in.strain[0] != nullptr) {
    V s[6];
    deviatoric_strain(g, s);
    for (int n = 0; n < 6; ++n) store(s[n], in.strain[n] + slot);
  }
  if (in.length2 != nullptr) {
    const V rho = constant<V>(1) + load(in.moments[0] + slot);
    store(rho * prescribed_les(vreman_viscosity(g, load(in.length2 + slot)), in.tau0), in.les + slot);
  }
}

void find_gradients(const GradientInput& in) {
  using P = Pack<float>;
  constexpr int width = static_cast<int>(P::size());
  for (int r = in.first_run; r < in.last_run; ++r) {
    const Run& run = in.runs[r];
    if (run.count < width)
      for (int n = 0; n < run.count; ++n) gradient_at<float>(in, run, run.first + n);
    else
      for (int n = 0; n < run.count; n += width) gradient_at<P>(in, run, run.first + std::min(n, run.count - width));
  }
}
