#include "lbm/openings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace puffin::lbm {

using geometry::Vec3;

namespace {

/// Place of the population that comes back along a cut link, between a collision of kind `last` and the next.
template <class T>
T& returning(const Run& run, const OpeningLink& link, Parity last, Populations<T>& p) {
  const int i = link.direction, o = d3q19::opposite(i);
  if (last == Parity::even) return p.f[i * p.stride + link.slot + neighbour_offset(run, i)];
  return p.f[o * p.stride + link.slot];
}

/// The lowest of the pressures at the outlets, as an excess of density.
double lowest_outlet(const Air& air, const Drive& drive) {
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < air.boundaries.size(); ++b)
    if (air.boundaries[b].kind == BoundaryKind::pressure_outlet) lowest = std::min(lowest, drive.density_excess[b]);
  return lowest;
}

}  // namespace

template <class T>
void apply_inlets(const Air& air, const Drive& drive, Parity last, std::size_t first, std::size_t end,
                  Populations<T>& p) {
  for (std::size_t k = first; k < end; ++k) {
    const OpeningLink& link = air.links.inlets[k];
    const Run& run = air.rows.runs()[link.run];
    const double more = drive.inlet_fluctuation.empty() ? 0.0 : drive.inlet_fluctuation[k];
    returning(run, link, last, p) =
        p.departed(run, link.slot, link.direction, last) + static_cast<T>(link.gain * drive.speed[link.patch] + more);
  }
}

template <class T>
std::int64_t apply_outlets(const Air& air, const Drive& drive, Parity last, std::size_t first, std::size_t end,
                           Populations<T>& p) {
  std::int64_t cut = 0;
  const auto& list = air.links.outlets;
  const double lowest = lowest_outlet(air, drive);
  for (std::size_t k = first; k < end;) {
    const std::ptrdiff_t slot = list[k].slot;
    const Run& run = air.rows.runs()[list[k].run];
    double drho = 0.0;
    Vec3 j = Vec3::Zero();
    for (int i = 0; i < d3q19::q; ++i) {
      const double f = p.departed(run, slot, i, last);
      const auto& c = d3q19::velocity[i];
      drho += f;
      j += f * Vec3(c[0], c[1], c[2]);
    }
    Vec3 u = j / (1.0 + drho);
    const double head = 1.5 * u.squaredNorm();  // its dynamic pressure, as an excess of density
    if (head > 0.0 && u.dot(air.normal[list[k].patch]) < 0.0) {
      const double driving = drive.density_excess[list[k].patch] - lowest;
      if (head > driving) {
        u *= std::sqrt(driving / head);
        ++cut;
      }
    }
    for (; k < end && list[k].slot == slot; ++k) {
      const int i = list[k].direction;
      const auto& c = d3q19::velocity[i];
      const double cu = u.dot(Vec3(c[0], c[1], c[2])), rho = 1.0 + drive.density_excess[list[k].patch];
      const double dynamic = rho * (4.5 * cu * cu - 1.5 * u.squaredNorm());
      returning(run, list[k], last, p) = static_cast<T>(
          -p.departed(run, slot, i, last) + 2.0 * d3q19::weight[i] * (drive.density_excess[list[k].patch] + dynamic));
    }
  }
  return cut;
}

template void apply_inlets(const Air&, const Drive&, Parity, std::size_t, std::size_t, Populations<float>&);
template void apply_inlets(const Air&, const Drive&, Parity, std::size_t, std::size_t, Populations<double>&);
template std::int64_t apply_outlets(const Air&, const Drive&, Parity, std::size_t, std::size_t, Populations<float>&);
template std::int64_t apply_outlets(const Air&, const Drive&, Parity, std::size_t, std::size_t, Populations<double>&);

}  // namespace puffin::lbm
