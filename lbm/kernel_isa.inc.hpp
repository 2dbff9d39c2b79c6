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

/// Calls body(0) ... body(18) with the directions as constants, so that arrays of packs live in registers.
template <class F>
[[gnu::always_inline]] inline void for_directions(F&& body) {
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    (body(std::integral_constant<int, I>()), ...);
  }
  (std::make_integer_sequence<int, 19>());
}

template <class T>
inline Pack<T> load_float(const float* p) {
  Pack<T> v;
  v.copy_from(p, stdx::element_aligned);
  return v;
}

template <class P>
[[gnu::always_inline]] inline P minimum(P a, P b) {
  return stdx::min(a, b);
}

/// The rare path of the positivity limiter: scales the stress p = (1-omega) Pi down, cell by cell, until no population
/// falls below w_i/10. `g` holds the populations with the full stress.
template <bool Forced, class P>
[[gnu::noinline, gnu::cold]] void limit_stress(const P& drho, const P& rho, const P (&u)[3], P (&p)[6],
                                               const P (&force)[3], P (&g)[19]) {
  using T = typename P::value_type;
  P equilibrium[19];
  const P zero[6] = {P(T(0)), P(T(0)), P(T(0)), P(T(0)), P(T(0)), P(T(0))};
  Rr3::assemble<Forced>(drho, rho, u, zero, force, equilibrium);
  P scale(T(1));
  for (int i = 0; i < 19; ++i) {
    const P floor(T(-0.9 * d3q19::weight[i]));
    const P room = equilibrium[i] - floor, drop = equilibrium[i] - g[i];
    P s = room / stdx::max(drop, P(T(1e-30)));
    where(!(g[i] < floor), s) = P(T(1));
    where(s < P(T(0)), s) = P(T(0));
    scale = minimum(scale, s);
  }
  for (auto& n : p) n = n * scale;
  Rr3::assemble<Forced>(drho, rho, u, p, force, g);
}

/// One pack of cells: collides g in place. Returns the moments; counts limiter events among the first `lanes` lanes.
template <class L, bool Forced, class P>
[[gnu::always_inline]] inline CellMoments<P> collide(P (&g)[19], const P (&force_in)[3], const CollisionConstants& c,
                                                     const P& les, int lanes, std::int64_t& limited) {
  using T = typename P::value_type;
  // In the step that changes dt, `force_in` is in the new units and the populations in the old: F = F'/r^2.
  const P old_force = P(T(Forced ? 1.0 / (c.rescale * c.rescale) : 1.0));
  const P force_before[3] = {force_in[0] * old_force, force_in[1] * old_force, force_in[2] * old_force};
  auto h = detail::hydrodynamics<Forced>(g, force_before);
  CellMoments<P> found{h.drho, h.u[0], h.u[1], h.u[2]};
  if (L::regularised || c.rescale != 1.0) {
    const P trace = (h.pi[0] + h.pi[1] + h.pi[2]) * P(T(1.0 / 3.0));
    for (int a = 0; a < 3; ++a) h.pi[a] = h.pi[a] - trace;
    P tau = detail::smagorinsky_tau(h.pi, P(T(1)) / h.rho, P(T(c.tau0)), les);
    if (c.rescale != 1.0) {
      // New time step dt' = r dt: rho' = 1 + r^2 (rho-1), u' = r u, Pi' = r (tau'/tau) (rho'/rho) Pi.
      const P r(T(c.rescale)), r2(T(c.rescale * c.rescale));
      const P tau_new = P(T(c.tau0_rescaled)) + r * (tau - P(T(c.tau0)));
      const P drho_new = r2 * h.drho;
      const P factor = r * (tau_new / tau) * ((P(T(1)) + drho_new) / h.rho);
      for (auto& pi : h.pi) pi = pi * factor;
      for (auto& u : h.u) u = u * r;
      h.drho = drho_new;
      h.rho = P(T(1)) + drho_new;
      tau = tau_new;
      found = {h.drho, h.u[0], h.u[1], h.u[2]};
    }
    const P keep = P(T(1)) - P(T(1)) / tau;
    P p[6];
    for (int n = 0; n < 6; ++n) p[n] = keep * h.pi[n];
    Rr3::assemble<Forced>(h.drho, h.rho, h.u, p, force_in, g);
    // Positivity: f_i >= w_i/10. The smallest g_i/w_i over axes and diagonals decides; the stress is scaled down if
    // not.
    P low_axis = minimum(minimum(minimum(g[1], g[2]), minimum(g[3], g[4])), minimum(g[5], g[6]));
    P low_diagonal = minimum(minimum(minimum(minimum(g[7], g[8]), minimum(g[9], g[10])),
                                     minimum(minimum(g[11], g[12]), minimum(g[13], g[14]))),
                             minimum(minimum(g[15], g[16]), minimum(g[17], g[18])));
    const P lowest = minimum(minimum(g[0] * P(T(3)), low_axis * P(T(18))), low_diagonal * P(T(36)));
    const auto negative = lowest < P(T(-0.9));
    if (stdx::any_of(negative)) [[unlikely]] {
      limit_stress<Forced>(h.drho, h.rho, h.u, p, force_in, g);
      for (int l = 0; l < lanes; ++l) limited += negative[l] ? 1 : 0;
    }
  } else {
    const P tau = detail::smagorinsky_tau(h.pi, P(T(1)) / h.rho, P(T(c.tau0)), les);
    const P omega = P(T(1)) / tau;
    const P u2 = h.u[0] * h.u[0] + h.u[1] * h.u[1] + h.u[2] * h.u[2];
    for_directions([&](auto i) __attribute__((always_inline)) {
      const P w{T(d3q19::weight[i])};
      const P cx{T(d3q19::velocity[i][0])}, cy{T(d3q19::velocity[i][1])}, cz{T(d3q19::velocity[i][2])};
      const P cu = cx * h.u[0] + cy * h.u[1] + cz * h.u[2];
      const P eq = w * (h.drho + h.rho * (P(T(3)) * cu + P(T(4.5)) * cu * cu - P(T(1.5)) * u2));
      g[i] = g[i] + omega * (eq - g[i]);
      if constexpr (Forced) {
        const P cf = cx * force_in[0] + cy * force_in[1] + cz * force_in[2];
        const P uf = h.u[0] * force_in[0] + h.u[1] * force_in[1] + h.u[2] * force_in[2];
        g[i] = g[i] + (P(T(1)) - P(T(0.5)) * omega) * w * (P(T(3)) * (cf - uf) + P(T(9)) * cu * cf);
      }
    });
  }
  return found;
}

template <class T, class L, bool Forced, Parity Step>
void sweep_run(const KernelInput<T>& in, const Run& run, std::uint8_t flags, KernelReport& report) {
  using P = Pack<T>;
  constexpr int width = static_cast<int>(P::size());
  // The 19 places of a cell: its own slots before an even step, those of its neighbours before an odd one.
  T* place[19];
  for (int i = 0; i < 19; ++i) {
    const auto& c = d3q19::velocity[i];
    place[i] = in.f + i * in.stride + run.first;
    if (Step == Parity::odd) place[i] += c[0] + run.shift[c[1] + 1][c[2] + 1];
  }
  constexpr auto source = [](int i) { return Step == Parity::even ? i : d3q19::opposite(i); };
  constexpr auto target = [](int i) { return Step == Parity::even ? d3q19::opposite(i) : i; };
  P lane([](auto l) { return static_cast<T>(static_cast<int>(l)); });
  P max_speed2(T(0)), min_drho(T(0)), max_drho(T(0));
  alignas(stdx::memory_alignment_v<P>) T buffer[width];
  for (int n = 0; n < run.count; n += width) {
    const int lanes = std::min(width, run.count - n);
    const bool full = lanes == width;
    P g[19];
    if (full) {
      for_directions([&](auto i) __attribute__((always_inline)) {
        g[i].copy_from(place[source(i)] + n, stdx::element_aligned);
      });
    } else {
      for_directions([&](auto i) __attribute__((always_inline)) {
        for (int l = 0; l < width; ++l) buffer[l] = place[source(i)][n + std::min(l, lanes - 1)];
        g[i].copy_from(buffer, stdx::vector_aligned);
      });
    }
    const std::ptrdiff_t s = run.first + n;
    P force[3] = {P(T(0)), P(T(0)), P(T(0))};
    if constexpr (Forced) {
      for (int d = 0; d < 3; ++d) {
        force[d] = P(T(in.uniform_force[d]));
        if (flags & run_forced) force[d] = force[d] + load_float<T>(in.force[d] + s);
      }
    }
    const P les = in.les ? load_float<T>(in.les + s) : P(T(0));
    const auto m = collide<L, Forced>(g, force, in.constants, les, lanes, report.limited);
    if (full) {
      for_directions([&](auto i)
                         __attribute__((always_inline)) { g[i].copy_to(place[target(i)] + n, stdx::element_aligned); });
    } else {
      for_directions([&](auto i) __attribute__((always_inline)) {
        g[i].copy_to(buffer, stdx::vector_aligned);
        for (int l = 0; l < lanes; ++l) place[target(i)][n + l] = buffer[l];
      });
    }
    const P speed2 = m.ux * m.ux + m.uy * m.uy + m.uz * m.uz;
    const auto inside = lane < P(T(lanes));
    // Written so that a NaN counts as bad.
    const auto good =
        (speed2 < P(T(speed_limit * speed_limit))) && (m.density_excess < P(T(0.5))) && (m.density_excess > P(T(-0.5)));
    if (!stdx::all_of(good || !inside)) [[unlikely]]
      for (int l = 0; l < lanes; ++l) report.bad += good[l] ? 0 : 1;
    max_speed2 = stdx::max(max_speed2, speed2);  // lanes beyond the run repeat its last cell
    min_drho = stdx::min(min_drho, m.density_excess);
    max_drho = stdx::max(max_drho, m.density_excess);
    if (flags & run_moments) {
      const P* value[4] = {&m.density_excess, &m.ux, &m.uy, &m.uz};
      for (int k = 0; k < 4; ++k) {
        value[k]->copy_to(buffer, stdx::vector_aligned);
        for (int l = 0; l < lanes; ++l) in.moments[k][s + l] = static_cast<float>(buffer[l]);
      }
    }
  }
  report.max_speed2 = std::max<double>(report.max_speed2, stdx::hmax(max_speed2));
  report.min_density_excess = std::min<double>(report.min_density_excess, stdx::hmin(min_drho));
  report.max_density_excess = std::max<double>(report.max_density_excess, stdx::hmax(max_drho));
}

template <class T, class L>
KernelReport sweep(const KernelInput<T>& in) {
  KernelReport report;
  for (int r = in.first_run; r < in.last_run; ++r) {
    const std::uint8_t flags = in.run_flags[r];
    const bool forced = in.forced_everywhere || (flags & run_forced);
    if (in.parity == Parity::even)
      forced ? sweep_run<T, L, true, Parity::even>(in, in.runs[r], flags, report)
             : sweep_run<T, L, false, Parity::even>(in, in.runs[r], flags, report);
    else
      forced ? sweep_run<T, L, true, Parity::odd>(in, in.runs[r], flags, report)
             : sweep_run<T, L, false, Parity::odd>(in, in.runs[r], flags, report);
  }
  return report;
}

/// Reflection at the walls for `lanes` cells of one wall run, the first at offset n (links.hpp has the equations).
/// Width of V: a pack, or one cell.
template <class T, class V, class Load, class LoadFloat, class Store>
inline void reflect(const WallInput<T>& in, const WallRun& wall, int n, const Load& load,
                    const LoadFloat& load_float_at, const Store& store) {
  const Run& run = in.runs[wall.run];
  const auto offset = [&](int i) {
    const auto& c = d3q19::velocity[i];
    return c[0] + run.shift[c[1] + 1][c[2] + 1];
  };
  V incoming[18];
  T* target[18];
  V imbalance = constant<V>(0);
  double weight = 0.0;
  int links = 0;
  for (std::uint32_t bits = wall.directions; bits != 0; bits &= bits - 1, ++links) {
    const int i = __builtin_ctz(bits), o = d3q19::opposite(i);
    T* here = in.f + o * in.stride + wall.first + n;                // own slot of the returning direction
    T* beyond = in.f + i * in.stride + wall.first + n + offset(i);  // slot behind the wall
    T* behind = in.f + o * in.stride + wall.first + n + offset(o);
    T* own = in.f + i * in.stride + wall.first + n;
    if (in.parity == Parity::odd) std::swap(here, beyond), std::swap(behind, own);
    const std::size_t at = wall.coefficient + static_cast<std::size_t>(links) * wall.count + n;
    const V a = load_float_at(in.back + at), b = load_float_at(in.own + at);
    const V out = load(here);
    V f = out + a * (load(behind) - out) + b * (load(own) - out);
    if (wall.moving) f = f + constant<V>(in.wall_speed) * load_float_at(in.moving + at);
    incoming[links] = f;
    target[links] = beyond;
    imbalance = imbalance + (out - f);
    weight += d3q19::weight[i];
  }
  int k = 0;
  for (std::uint32_t bits = wall.directions; bits != 0; bits &= bits - 1, ++k)
    store(target[k], incoming[k] + constant<V>(d3q19::weight[__builtin_ctz(bits)] / weight) * imbalance);
}

template <class T>
void walls(const WallInput<T>& in) {
  using P = Pack<T>;
  constexpr int width = static_cast<int>(P::size());
  for (std::size_t w = in.first; w < in.last; ++w) {
    const WallRun& wall = in.walls[w];
    int n = 0;
    for (; n + width <= wall.count; n += width)
      reflect<T, P>(
          in, wall, n, [](const T* p) { return P(p, stdx::element_aligned); },
          [](const float* p) { return load_float<T>(p); },
          [](T* p, const P& v) { v.copy_to(p, stdx::element_aligned); });
    for (; n < wall.count; ++n)
      reflect<T, T>(
          in, wall, n, [](const T* p) { return *p; }, [](const float* p) { return static_cast<T>(*p); },
          [](T* p, T v) { *p = v; });
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
Kernel<float> kernel_float(Law law) { return law == Law::rr3 ? &sweep<float, Rr3> : &sweep<float, Bgk>; }
Kernel<double> kernel_double(Law law) { return law == Law::rr3 ? &sweep<double, Rr3> : &sweep<double, Bgk>; }

}  // namespace puffin::lbm::PUFFIN_ISA
