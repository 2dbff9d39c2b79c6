// The body of one wall-kernel unit; included once by each wall_kernels_<isa>.cpp, which sets PUFFIN_ISA. As in
// kernel_isa.inc.hpp, nothing but templates over this unit's own SIMD pack is instantiated.

#include <algorithm>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>

#include "lbm/collision_regularised.hpp"
#include "lbm/wall_kernels.hpp"

namespace puffin::lbm::PUFFIN_ISA {
namespace {

namespace stdx = std::experimental;
template <class T>
using Pack = stdx::native_simd<T>;

/// Loads of a pack, or of one cell where V is a plain number.
template <class V, class S>
[[gnu::always_inline]] inline V load(const S* p) {
  if constexpr (std::is_arithmetic_v<V>) {
    return static_cast<V>(*p);
  } else {
    V v;
    v.copy_from(p, stdx::element_aligned);
    return v;
  }
}
template <class V, class S>
[[gnu::always_inline]] inline void store(const V& v, S* p) {
  if constexpr (std::is_arithmetic_v<V>)
    *p = static_cast<S>(v);
  else
    v.copy_to(p, stdx::element_aligned);
}
template <class V>
[[gnu::always_inline]] inline V larger(const V& a, const V& b) {
  if constexpr (std::is_arithmetic_v<V>)
    return a > b ? a : b;
  else
    return stdx::max(a, b);
}

/// Where the directions of the first cell of a segment are found before a collision of this parity.
template <class T, class P>
[[gnu::always_inline]] inline void find_places(P* f, std::size_t stride, const Run& run, const CellSegment& segment,
                                               Parity parity, P* (&from)[19]) {
  for (int i = 0; i < 19; ++i) {
    const int o = d3q19::opposite(i);
    const auto& c = d3q19::velocity[o];
    from[i] = parity == Parity::even ? f + i * stride + segment.first
                                     : f + o * stride + segment.first + c[0] + run.shift[c[1] + 1][c[2] + 1];
  }
}

/// Calls body.template operator()<V>(n) for packs of a segment, the last overlapping the one before it, or for single
/// cells where it is shorter than a pack. Only for bodies that may do a cell twice.
template <class T, class Body>
[[gnu::always_inline]] inline void for_packs(int count, const Body& body) {
  using P = Pack<T>;
  constexpr int width = static_cast<int>(P::size());
  if (count < width) {
    for (int n = 0; n < count; ++n) body.template operator()<T>(n);
    return;
  }
  for (int n = 0; n < count; n += width) body.template operator()<P>(std::min(n, count - width));
}

template <class T>
void find_solid(const PartialInput<T>& in) {
  for (std::size_t k = in.first; k < in.last; ++k) {
    const CellSegment& segment = in.segments[k];
    T* from[19];
    find_places<T>(in.f, in.stride, in.runs[segment.run], segment, in.parity, from);
    for_packs<T>(
        segment.count, [&]<class V>(int n) __attribute__((always_inline)) {
          const std::size_t at = segment.at + n;
          V g[19];
          for (int i = 0; i < 19; ++i) g[i] = load<V>(from[i] + n);
          const V force[3] = {constant<V>(in.uniform_force[0]), constant<V>(in.uniform_force[1]),
                              constant<V>(in.uniform_force[2])};
          V les = load<V>(in.les + segment.first + n);
          CellState<V> s;
          find_state<true>(
              [&](auto i) __attribute__((always_inline)) { return g[i]; }, force, les, s);
          const V half = constant<V>(0.5), one = constant<V>(1);
          const V tau =
              larger<V>(half * twice_tau(s.p, in.constants, constant<V>(in.eddy) * les), constant<V>(in.least_tau));
          const V eps = load<V>(in.solid + at), excess = tau - half;
          const V weight = eps * excess / ((one - eps) + excess);
          // Equilibria of the fluid and of the solid, in the units of the time step to come.
          const V none[3] = {constant<V>(0), constant<V>(0), constant<V>(0)};
          const double r = in.constants.rescale;
          for (auto& p : s.p) p = constant<V>(0);
          V fluid[19], solid[19];
          Rr3::assemble<false>(
              s, none, [&](auto i, const V& v) __attribute__((always_inline)) { fluid[i] = v; });
          s.drho = constant<V>(r * r) * s.drho;
          for (int d = 0; d < 3; ++d) {
            s.u[d] = in.wall[d] ? constant<V>(in.wall_speed) * load<V>(in.wall[d] + at) : constant<V>(0);
            s.j[d] = (one + s.drho) * s.u[d];
          }
          Rr3::assemble<false>(
              s, none, [&](auto i, const V& v) __attribute__((always_inline)) { solid[i] = v; });
          for (int i = 0; i < 19; ++i) {
            const int o = d3q19::opposite(i);
            store(weight * (solid[i] + constant<V>(r) * (g[o] - fluid[o])), in.kept + i * in.cells + at);
          }
          store(weight, in.kept + 19 * in.cells + at);
        });
  }
}

/// What left in direction i lies where the opposite direction was found before the collision.
template <class T>
void blend(const PartialInput<T>& in) {
  for (std::size_t k = in.first; k < in.last; ++k) {
    const CellSegment& segment = in.segments[k];
    T* from[19];
    find_places<T>(in.f, in.stride, in.runs[segment.run], segment, in.parity, from);
    const auto cell = [&]<class V>(int n) __attribute__((always_inline)) {
      const std::size_t at = segment.at + n;
      const V rest = constant<V>(1) - load<V>(in.kept + 19 * in.cells + at);
      V taken[3] = {constant<V>(0), constant<V>(0), constant<V>(0)};
      for (int i = 0; i < 19; ++i) {
        T* const place = from[d3q19::opposite(i)] + n;
        const V before = load<V>(place), after = rest * before + load<V>(in.kept + i * in.cells + at);
        store(after, place);
        const V lost = before - after;
        for (int d = 0; d < 3; ++d) {
          if (d3q19::velocity[i][d] > 0) taken[d] = taken[d] + lost;
          if (d3q19::velocity[i][d] < 0) taken[d] = taken[d] - lost;
        }
      }
      for (int d = 0; d < 3; ++d) {
        if constexpr (std::is_same_v<V, float> || std::is_same_v<V, double>)
          in.taken[d][at] = static_cast<float>(taken[d]);
        else
          for (int l = 0; l < static_cast<int>(V::size()); ++l)
            in.taken[d][at + l] = static_cast<float>(static_cast<T>(taken[d][l]));
      }
    };
    using P = Pack<T>;
    constexpr int width = static_cast<int>(P::size());
    int n = 0;
    for (; n + width <= segment.count; n += width) cell.template operator()<P>(n);
    for (; n < segment.count; ++n) cell.template operator()<T>(n);
  }
}

template <class T>
void read_cells(const ReadInput<T>& in) {
  for (std::size_t k = in.first; k < in.last; ++k) {
    const CellSegment& segment = in.segments[k];
    const T* from[19];
    find_places<T>(in.f, in.stride, in.runs[segment.run], segment, in.parity, from);
    for_packs<T>(
        segment.count, [&]<class V>(int n) __attribute__((always_inline)) {
          const V none[3] = {constant<V>(0), constant<V>(0), constant<V>(0)};
          const auto h = hydrodynamics<false>(
              [&](auto i) __attribute__((always_inline)) { return load<V>(from[i] + n); }, none);
          const V value[4] = {h.u[0], h.u[1], h.u[2], h.rho};
          float* const to = in.state + 4 * (segment.at + n);
          if constexpr (std::is_arithmetic_v<V>) {
            for (int d = 0; d < 4; ++d) to[d] = static_cast<float>(value[d]);
          } else {
            alignas(stdx::memory_alignment_v<V>) T buffer[4][V::size()];
            for (int d = 0; d < 4; ++d) value[d].copy_to(buffer[d], stdx::vector_aligned);
            for (int l = 0; l < static_cast<int>(V::size()); ++l)
              for (int d = 0; d < 4; ++d) to[4 * l + d] = static_cast<float>(buffer[d][l]);
          }
        });
  }
}

}  // namespace

PartialKernels<float> partial_float() { return {&find_solid<float>, &blend<float>}; }
PartialKernels<double> partial_double() { return {&find_solid<double>, &blend<double>}; }
ReadKernel<float> read_float() { return &read_cells<float>; }
ReadKernel<double> read_double() { return &read_cells<double>; }

}  // namespace puffin::lbm::PUFFIN_ISA
