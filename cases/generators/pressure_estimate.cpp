#include "cases/generators/pressure_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace puffin::cases {
namespace {

/// Piecewise linear in a table with ascending x, constant beyond its ends.
template <std::size_t n>
double interpolate(const std::array<double, n>& x, const std::array<double, n>& y, double at) {
  if (at <= x.front()) return y.front();
  for (std::size_t k = 1; k < n; ++k)
    if (at <= x[k]) return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
  return y.back();
}

constexpr std::array<double, 7> aspect{0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0};  // H / W

/// ASHRAE CR3-6, 90 degrees.
double mitre_coefficient(double height_over_width) {
  return interpolate(aspect, std::array{1.3, 1.3, 1.2, 1.2, 1.1, 1.1, 0.98}, height_over_width);
}

/// ASHRAE CR3-1, 90 degrees; logarithms interpolated over r/W, where the coefficient falls steeply.
double rounded_coefficient(double radius_over_width, double height_over_width) {
  constexpr std::array<double, 5> r{0.5, 0.75, 1.0, 1.5, 2.0};
  constexpr std::array<std::array<double, 7>, 5> table{{{1.53, 1.38, 1.29, 1.18, 1.06, 1.00, 1.00},
                                                        {0.57, 0.52, 0.48, 0.44, 0.40, 0.39, 0.39},
                                                        {0.27, 0.25, 0.23, 0.21, 0.19, 0.18, 0.18},
                                                        {0.22, 0.20, 0.19, 0.17, 0.15, 0.14, 0.14},
                                                        {0.20, 0.18, 0.16, 0.15, 0.14, 0.13, 0.13}}};
  std::array<double, 5> column{};
  for (std::size_t k = 0; k < r.size(); ++k) column[k] = std::log(interpolate(aspect, table[k], height_over_width));
  return std::exp(interpolate(r, column, radius_over_width));
}

/// Idelchik, diagram 6-4 (height over width 0.25 and 1), as a factor on the elbow of equal widths.
double width_change_factor(double width_ratio, double height_over_width) {
  constexpr std::array<double, 7> ratio{0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 2.0};
  const double flat = interpolate(ratio, std::array{1.76, 1.43, 1.24, 1.14, 1.09, 1.06, 1.06}, width_ratio) / 1.24;
  const double square = interpolate(ratio, std::array{1.70, 1.36, 1.15, 1.02, 0.95, 0.90, 0.84}, width_ratio) / 1.15;
  return interpolate(std::array{0.25, 1.0}, std::array{flat, square}, height_over_width);
}

double reynolds_factor(bool rounded, double reynolds) {
  return std::max(1.0, rounded ? std::pow(reynolds / 2e5, -0.231) : std::pow(reynolds / 1.4e5, -0.128));
}

/// A rectangular section with the flow in it.
struct Channel {
  double width, height;  // [m]
  double velocity;       // [m/s] section mean
  double density, viscosity;

  double hydraulic_diameter() const { return 2.0 * width * height / (width + height); }
  double head() const { return 0.5 * density * velocity * velocity; }
  double reynolds() const { return density * velocity * hydraulic_diameter() / viscosity; }
  double friction(double length) const {
    return 0.3164 * std::pow(reynolds(), -0.25) * length / hydraulic_diameter() * head();
  }
};

double borda_carnot(const Channel& a, const Channel& b) {
  return 0.5 * a.density * (a.velocity - b.velocity) * (a.velocity - b.velocity);
}

double bend_loss(const Channel& a, const Channel& b, double inner_radius) {
  if (inner_radius == 0.0) {
    const double shape = a.height / a.width;
    return mitre_coefficient(shape) * reynolds_factor(false, a.reynolds()) *
           width_change_factor(b.width / a.width, shape) * a.head();
  }
  const Channel& narrow = a.width < b.width ? a : b;
  const double bend = rounded_coefficient(inner_radius / narrow.width + 0.5, narrow.height / narrow.width) *
                      reynolds_factor(true, narrow.reynolds()) * narrow.head();
  return bend + (b.width > a.width ? borda_carnot(a, b) : 0.0);
}

}  // namespace

PressureEstimate estimate_pressure(const std::string& kind, const Parameters& parameters, double flow_rate,
                                   double density, double viscosity) {
  if (kind != "l-bend" && kind != "omega-bend")
    throw std::invalid_argument("a pressure estimate is known for l-bend and omega-bend, not for '" + kind + "'");
  if (!(flow_rate > 0.0 && density > 0.0 && viscosity > 0.0))
    throw std::invalid_argument("a pressure estimate needs flow rate, density and viscosity greater than 0");
  const Parameters p = resolve_parameters(kind, parameters);
  const auto number = [&p](const char* name) { return std::get<double>(p.at(name)); };
  const auto& lengths = std::get<std::vector<double>>(p.at("leg_lengths"));
  const auto& widths = std::get<std::vector<double>>(p.at("leg_widths"));
  const auto channel = [&](double width, double height) {
    return Channel{width, height, flow_rate / (width * height), density, viscosity};
  };
  const Channel inlet = channel(number("inlet_width"), number("inlet_height"));
  const Channel lip = channel(number("inlet_width"), number("lip_height"));
  const bool has_lip = number("lip_height") > number("inlet_height");

  PressureEstimate estimate;
  auto& losses = estimate.losses;
  losses.push_back({"friction of the inlet", inlet.friction(number("inlet_length"))});
  if (has_lip) losses.push_back({"lip", borda_carnot(inlet, lip)});
  Channel leg = channel(widths[0], number("duct_height"));
  losses.push_back({"step", borda_carnot(lip, leg)});
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    losses.push_back({"friction of leg " + std::to_string(i + 1), leg.friction(lengths[i])});
    if (i + 1 == lengths.size()) break;
    const Channel next = channel(widths[i + 1], number("duct_height"));
    losses.push_back({"bend " + std::to_string(i + 1), bend_loss(leg, next, number("bend_inner_radius"))});
    leg = next;
  }
  estimate.inlet_head = inlet.head();
  estimate.outlet_head = leg.head();
  estimate.total_to_static_drop = estimate.outlet_head;
  for (const PressureLoss& loss : losses) estimate.total_to_static_drop += loss.loss;
  estimate.static_drop = estimate.total_to_static_drop - estimate.inlet_head;
  return estimate;
}

}  // namespace puffin::cases
