#include "lbm/openings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

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

/// Sums over what left a cell in the last step.
struct Departed {
  double density_excess = 0.0;
  Vec3 momentum = Vec3::Zero();
};

/// Its population at rest is given, for walls may be at work on it.
template <class T>
Departed departed(const Run& run, std::ptrdiff_t slot, Parity last, double at_rest, const Populations<T>& p) {
  Departed sum{at_rest};
  for (int i = 1; i < d3q19::q; ++i) {
    const double f = p.departed(run, slot, i, last);
    const auto& c = d3q19::velocity[i];
    sum.density_excess += f;
    sum.momentum += f * Vec3(c[0], c[1], c[2]);
  }
  return sum;
}

}  // namespace

template <class T>
void apply_inlets(const Air& air, const Drive& drive, Parity last, std::size_t first, std::size_t end,
                  Populations<T>& p) {
  const bool cubic = has_third_order(air.options.law);
  for (std::size_t k = first; k < end; ++k) {
    const OpeningLink& link = air.links.inlets[k];
    const Run& run = air.rows.runs()[link.run];
    double more = drive.inlet_fluctuation.empty() ? 0.0 : drive.inlet_fluctuation[k];
    if (link.wall >= 0) more += link.wall_gain * drive.speed[link.wall];
    const double speed = drive.speed[link.patch];
    if (cubic) more += link.cubic * speed * speed * speed;
    returning(run, link, last, p) =
        p.departed(run, link.slot, link.direction, last) + static_cast<T>(link.gain * speed + more);
  }
}

namespace {

/// Direction of the faces of each straight outlet, by patch; 0 for the others.
std::map<int, int> find_straight(const Rows& rows, const std::vector<OpeningLink>& outlets,
                                 const std::vector<std::uint8_t>& fluid) {
  const auto is_fluid = [&](std::ptrdiff_t slot) { return fluid.empty() || fluid[slot] != 0; };
  const auto closed = [&](std::ptrdiff_t slot, int direction) {  // by an outlet
    for (std::int32_t n = first_outlet_link(outlets, slot);
         n >= 0 && n < static_cast<std::int32_t>(outlets.size()) && outlets[n].slot == slot; ++n)
      if (outlets[n].direction == direction) return true;
    return false;
  };
  std::map<int, int> straight;
  for (const OpeningLink& link : outlets) {
    const int out = link.direction;
    const auto known = straight.try_emplace(link.patch, -1).first;  // -1: no face seen yet
    if (out > 6 || known->second == 0 || !is_fluid(link.slot)) continue;
    if (known->second < 0) known->second = out;
    if (known->second != out) known->second = 0;
    for (int beside = 1; beside <= 6; ++beside) {
      if (beside == out || beside == d3q19::opposite(out)) continue;
      auto cell = rows.cell(link.slot);
      for (int d = 0; d < 3; ++d) cell[d] += d3q19::velocity[beside][d];
      const std::ptrdiff_t next = rows.active_slot(cell[0], cell[1], cell[2]);
      if (next >= 0 && is_fluid(next) && !closed(next, out)) known->second = 0;
    }
  }
  return straight;
}

}  // namespace

std::int32_t first_outlet_link(const std::vector<OpeningLink>& outlets, std::ptrdiff_t slot) {
  const auto at = std::lower_bound(outlets.begin(), outlets.end(), slot,
                                   [](const OpeningLink& link, std::ptrdiff_t s) { return link.slot < s; });
  return at != outlets.end() && at->slot == slot ? static_cast<std::int32_t>(at - outlets.begin()) : -1;
}

std::vector<OutletSource> find_outlet_sources(const Rows& rows, const std::vector<OpeningLink>& outlets,
                                              const std::vector<std::uint8_t>& fluid) {
  std::map<int, std::array<std::size_t, 7>> faces;  // per patch: faces of cells that an outlet closes, per direction
  for (const OpeningLink& link : outlets)
    if (link.direction <= 6) ++faces[link.patch][link.direction];
  const std::map<int, int> straight = find_straight(rows, outlets, fluid);
  std::vector<OutletSource> sources;
  for (const OpeningLink& link : outlets) {
    const std::int32_t own = first_outlet_link(outlets, link.slot);
    const auto& closed = faces[link.patch];
    OutletSource source;
    source.straight = straight.at(link.patch) > 0;
    source.out = static_cast<std::int8_t>(std::max_element(closed.begin() + 1, closed.end()) - closed.begin());
    bool has_face = false;
    for (std::size_t n = own; n < outlets.size() && outlets[n].slot == link.slot; ++n) {
      if (outlets[n].direction > 6 || outlets[n].patch != link.patch) continue;
      if (!has_face || closed[outlets[n].direction] > closed[source.out])
        source.out = static_cast<std::int8_t>(outlets[n].direction);
      has_face = true;
    }
    const auto& out = d3q19::velocity[source.out];
    auto beside = rows.cell(link.slot);
    for (int d = 0; d < 3; ++d)
      if (out[d] == 0) beside[d] += d3q19::velocity[link.direction][d];
    const std::ptrdiff_t next = rows.active_slot(beside[0], beside[1], beside[2]);
    const std::int32_t there = next < 0 ? -1 : first_outlet_link(outlets, next);
    source.beside = there < 0 ? own : there;
    source.judge = has_face ? own : source.beside;
    auto behind = rows.cell(outlets[source.beside].slot);
    for (int d = 0; d < 3; ++d) behind[d] -= out[d];
    source.behind = rows.active_slot(behind[0], behind[1], behind[2]);
    if (source.behind >= 0) source.run_behind = run_of(rows, source.behind);
    sources.push_back(source);
  }
  return sources;
}

template <class T>
void find_outlet_air(const Air& air, Parity last, std::size_t first, std::size_t end, const Populations<T>& p,
                     std::vector<OutletAir>& state) {
  const auto& list = air.links.outlets;
  for (std::size_t k = first; k < end; ++k) {
    if (k > first && list[k].slot == list[k - 1].slot) continue;
    const Run& run = air.rows.runs()[list[k].run];
    const Departed sum = departed(run, list[k].slot, last, p.departed(run, list[k].slot, 0, last), p);
    state[k] = {sum.density_excess, sum.momentum / (1.0 + sum.density_excess)};
  }
}

std::vector<double> entering_heads(const Air& air, const Drive& drive, const std::vector<OutletAir>& state) {
  const std::size_t boundaries = air.boundaries.size();
  std::vector<double> flux(boundaries, 0.0), leaving(boundaries, 0.0), entering(boundaries, 0.0);
  const double lowest = lowest_outlet(air, drive);
  for (std::size_t b = 0; b < boundaries; ++b) {
    const BoundaryKind kind = air.boundaries[b].kind;
    if (kind == BoundaryKind::velocity_inlet ||
        (kind == BoundaryKind::pressure_outlet && drive.density_excess[b] != lowest))
      return entering;
  }
  const auto& list = air.links.outlets;
  for (std::size_t k = 0, cell = 0; k < list.size(); ++k) {
    if (list[k].slot != list[cell].slot) cell = k;  // `state` is that of a cell's first link
    if (list[k].direction > 6) continue;
    const auto& ci = d3q19::velocity[list[k].direction];
    const double out = state[cell].velocity.dot(Vec3(ci[0], ci[1], ci[2]));
    flux[list[k].patch] += out;
    if (out > 0.0) leaving[list[k].patch] = std::max(leaving[list[k].patch], 1.5 * state[cell].velocity.squaredNorm());
  }
  double most = 0.0;
  for (std::size_t b = 0; b < boundaries; ++b)
    if (flux[b] > 0.0) most = std::max(most, leaving[b]);
  for (std::size_t b = 0; b < boundaries; ++b)
    if (flux[b] < 0.0) entering[b] = most;
  return entering;
}

template <class T>
std::int64_t apply_outlets(const Air& air, const Drive& drive, const std::vector<OutletAir>& state,
                           const std::vector<double>& heads, Parity last, std::size_t first, std::size_t end,
                           Populations<T>& p) {
  std::int64_t cut = 0;
  const auto& list = air.links.outlets;
  const double lowest = lowest_outlet(air, drive);
  std::ptrdiff_t counted = -1;  // the last cell whose velocity was shortened
  for (std::size_t k = first, cell = first; k < end; ++k) {
    const OpeningLink& link = list[k];
    if (link.slot != list[cell].slot) cell = k;  // `state` is that of a cell's first link
    const OutletSource& source = air.links.schedule->outlet_sources[k];
    const int i = link.direction;
    const auto& ci = d3q19::velocity[i];
    const Vec3 c(ci[0], ci[1], ci[2]);
    const double w = d3q19::weight[i], outside = drive.density_excess[link.patch];
    double back = 0.0;
    const Vec3& judged = state[source.straight ? static_cast<std::size_t>(source.judge) : cell].velocity;
    const auto& away = d3q19::velocity[source.out];
    const Vec3& normal = air.normal[link.patch];  // zero: of several faces that look against each other
    const bool leaves = judged.dot(normal.isZero() ? Vec3(away[0], away[1], away[2]) : normal) >= 0.0;
    if (leaves && source.straight) {
      const OpeningLink& from = list[source.beside];
      const OutletAir& there = state[source.beside];
      const auto& out = d3q19::velocity[source.out];
      back = p.departed(air.rows.runs()[from.run], from.slot, d3q19::opposite(i), last) +
             2.0 * w * (outside - there.density_excess);
      if (source.behind >= 0 && c.dot(Vec3(out[0], out[1], out[2])) > 0.0) {
        const Departed behind = departed(air.rows.runs()[source.run_behind], source.behind, last, 0.0, p);
        back -= 3.0 * w * c.dot((1.0 + there.density_excess) * there.velocity - behind.momentum);
      }
    } else {
      Vec3 u = state[cell].velocity;
      const double head = 1.5 * u.squaredNorm();  // its dynamic pressure, as an excess of density
      const double most = std::max(outside - lowest, heads[static_cast<std::size_t>(link.patch)]);
      if (!leaves && head > most) {
        u *= std::sqrt(most / head);
        if (counted != link.slot) ++cut;
        counted = link.slot;
      }
      const double cu = u.dot(c), dynamic = (1.0 + outside) * (4.5 * cu * cu - 1.5 * u.squaredNorm());
      back = -p.departed(air.rows.runs()[link.run], link.slot, i, last) + 2.0 * w * (outside + dynamic);
    }
    returning(air.rows.runs()[link.run], link, last, p) = static_cast<T>(back);
  }
  return cut;
}

template void apply_inlets(const Air&, const Drive&, Parity, std::size_t, std::size_t, Populations<float>&);
template void apply_inlets(const Air&, const Drive&, Parity, std::size_t, std::size_t, Populations<double>&);
template void find_outlet_air(const Air&, Parity, std::size_t, std::size_t, const Populations<float>&,
                              std::vector<OutletAir>&);
template void find_outlet_air(const Air&, Parity, std::size_t, std::size_t, const Populations<double>&,
                              std::vector<OutletAir>&);
template std::int64_t apply_outlets(const Air&, const Drive&, const std::vector<OutletAir>&, const std::vector<double>&,
                                    Parity, std::size_t, std::size_t, Populations<float>&);
template std::int64_t apply_outlets(const Air&, const Drive&, const std::vector<OutletAir>&, const std::vector<double>&,
                                    Parity, std::size_t, std::size_t, Populations<double>&);

}  // namespace puffin::lbm
