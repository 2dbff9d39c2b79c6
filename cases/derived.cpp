#include "cases/derived.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "cases/size_distribution.hpp"

namespace puffin::cases {

double TimeTable::at(double t) const {
  if (t <= time.front()) return value.front();
  if (t >= time.back()) return value.back();
  const std::size_t i = std::upper_bound(time.begin(), time.end(), t) - time.begin();
  const double s = (t - time[i - 1]) / (time[i] - time[i - 1]);
  return value[i - 1] + s * (value[i] - value[i - 1]);
}

std::optional<double> flow_rate(const Boundary& b, double t, double area) {
  if (const auto* rate = std::get_if<FlowRate>(&b.flow)) return rate->table.at(t);
  if (const auto* speed = std::get_if<MeanSpeed>(&b.flow)) return speed->value * area;
  return std::nullopt;
}

double mean_speed(const Boundary& b, double t, double area) {
  if (const auto* rate = std::get_if<FlowRate>(&b.flow)) return rate->table.at(t) / area;
  if (const auto* speed = std::get_if<MeanSpeed>(&b.flow)) return speed->value;
  if (const auto* vector = std::get_if<Velocity>(&b.flow)) return vector->value.norm();
  return 0.0;
}

namespace {

double ratio_of(const Boundary& b, double section_ratio) {
  return b.type == BoundaryType::velocity_inlet ? section_ratio : 1.0;
}

double largest_speed(const Air& air, double end, const AreaOf& area_of, double section_ratio) {
  double largest = 0.0;
  for (const Boundary& b : air.boundaries) {
    const double area = std::holds_alternative<FlowRate>(b.flow) ? area_of(b.patch) : 1.0;
    const auto take = [&](double t) {
      largest = std::max(largest, ratio_of(b, section_ratio) * std::abs(mean_speed(b, t, area)));
    };
    take(0.0);
    take(end);
    if (const auto* rate = std::get_if<FlowRate>(&b.flow))
      for (const double t : rate->table.time)
        if (t < end) take(t);
  }
  return largest;
}

}  // namespace

double largest_mean_speed(const Air& air, double end, const AreaOf& area_of) {
  return largest_speed(air, end, area_of, 1.0);
}

double followed_speed(const Air& air, double t, const AreaOf& area_of) {
  double speed = air.initial_velocity.norm();
  for (const Boundary& b : air.boundaries) {
    const double area = std::holds_alternative<FlowRate>(b.flow) ? area_of(b.patch) : 1.0;
    speed = std::max(speed, std::abs(mean_speed(b, t, area)));
  }
  return speed;
}

double largest_followed_speed(const Air& air, double end, const AreaOf& area_of) {
  return std::max(largest_mean_speed(air, end, area_of), air.initial_velocity.norm());
}

double largest_section_speed(const Case& c, const AreaOf& area_of, double section_ratio) {
  double speed = std::max(largest_speed(c.air, c.stop.time, area_of, section_ratio), c.air.initial_velocity.norm());
  if (c.air.model == AirModel::frozen)
    if (const auto* uniform = std::get_if<UniformField>(&c.air.frozen))
      speed = std::max(speed, uniform->velocity.norm());
  return speed;
}

double reference_speed(const Case& c, const AreaOf& area_of, double section_ratio) {
  return c.numerics.reference_speed.value_or(largest_section_speed(c, area_of, section_ratio));
}

double cell_size(const Numerics& n, double fluid_volume) {
  if (n.dx) return *n.dx;
  if (n.cells) return std::cbrt(fluid_volume / static_cast<double>(*n.cells));
  throw std::invalid_argument("the case gives neither numerics.dx nor numerics.cells");
}

LatticeNumbers lattice_numbers(const Case& c, double dx, double reference, const AreaOf& area_of,
                               double section_ratio) {
  if (!(dx > 0.0) || !(reference > 0.0)) throw std::invalid_argument("cell size and reference speed must be positive");
  LatticeNumbers n;
  n.dx = dx;
  const bool given = c.numerics.time_step == TimeStepRule::given;
  n.dt = n.dt_largest = given ? c.numerics.time_step_seconds : c.numerics.lattice_speed * dx / reference;
  n.mach = std::sqrt(3.0) * std::max(reference, largest_section_speed(c, area_of, section_ratio)) * n.dt / dx;
  n.tau = 0.5 + 3.0 * c.air.viscosity / c.air.density * n.dt / (dx * dx);
  n.steps = c.stop.time / n.dt;
  if (c.numerics.time_step != TimeStepRule::follow_ramp || largest_mean_speed(c.air, c.stop.time, area_of) <= 0.0)
    return n;
  const double largest = largest_followed_speed(c.air, c.stop.time, area_of);
  constexpr int samples = 2000;  // of the ramp: midpoints, so linear pieces are exact but for the cells with a kink
  n.steps = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double t = (i + 0.5) / samples * c.stop.time;
    const double speed = followed_speed(c.air, t, area_of);
    const double stretch = std::clamp(largest / std::max(speed, 1e-30), 1.0, 4.0);
    n.dt_largest = std::max(n.dt_largest, n.dt * stretch);
    n.steps += c.stop.time / samples / (n.dt * stretch);
  }
  return n;
}

double reynolds(const Air& air, double speed, double length) { return air.density * speed * length / air.viscosity; }

double carrier_mass(double diameter, double density) {
  return density * std::numbers::pi / 6.0 * diameter * diameter * diameter;
}

double dose_mass(const Carriers& c) {
  const double fines = 1.0 + c.fines_each * c.fine_mass_ratio;
  if (c.list.empty()) return static_cast<double>(c.count) * carrier_mass(c.diameter, c.density) * fines;
  double mass = 0.0;
  for (const ListedCarrier& p : c.list) mass += c.parcel * carrier_mass(p.diameter, p.density) * fines;
  return mass;
}

double fines_diameter(const Carriers& c, double fines_density) {
  // Of a list without carriers.diameter: its first carrier.
  const bool first = !(c.diameter > 0.0) && !c.list.empty();
  const double diameter = first ? c.list.front().diameter : c.diameter;
  const double density = first ? c.list.front().density : c.density;
  return diameter * std::cbrt(c.fine_mass_ratio * density / fines_density);
}

double response_time(const Case& c) {
  constexpr double shortest = 2e-7;  // [s] smaller ones go with the air
  double least = std::numeric_limits<double>::infinity();
  if (c.air.model != AirModel::frozen || !c.carriers) return least;
  const auto take = [&](double diameter, double density) {
    if (diameter > 0.0) least = std::min(least, density * diameter * diameter / (18.0 * c.air.viscosity));
  };
  for (const ListedCarrier& one : c.carriers->list) take(one.diameter, one.density);
  if (c.carriers->list.empty())
    take(c.carriers->sizes ? size_table(*c.carriers->sizes).diameter.front() : c.carriers->diameter,
         c.carriers->density);
  return std::max(least, shortest);
}

}  // namespace puffin::cases
