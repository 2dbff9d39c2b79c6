// A slice through the air: speed, pressure or the fines of a scalar on one layer of cells.

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tools/output/picture/decorations.hpp"
#include "tools/output/picture/views.hpp"

namespace puffin::output {
namespace {

constexpr float no_fluid = std::numeric_limits<float>::quiet_NaN();

/// What is painted: the value of a cell, and how it is called.
struct Quantity {
  std::string title, label;
  bool logarithmic = false;
  const std::vector<float>* values = nullptr;  // per cell; absent: the speed, from the velocity
};

Quantity quantity_of(const FieldFrame& field, const std::string& name) {
  if (name == "speed" && !field.velocity.empty()) return {"Speed of the air", "speed of the air [m/s]", false, nullptr};
  if (name == "pressure" && !field.pressure.empty())
    return {"Pressure of the air", "gauge pressure [Pa]", false, &field.pressure};
  for (const NamedArray& scalar : field.fines)
    if (name == "fines_" + scalar.name || (name == "fines" && &scalar == &field.fines.front()))
      return {"Fines in the air, " + scalar.name + ",", "fines per volume [1/m^3]", true, &scalar.values};
  throw std::invalid_argument("this output holds no " + name);
}

/// One layer of cells as the picture shows it: rows from below.
struct Layer {
  int nx = 0, ny = 0;
  std::vector<float> values;  // `no_fluid` where there is none, or no number
  bool fluid(int i, int j) const { return i >= 0 && j >= 0 && i < nx && j < ny && !std::isnan(at(i, j)); }
  float at(int i, int j) const { return values[static_cast<std::size_t>(j) * nx + i]; }
};

Layer layer_of(const FieldFrame& field, const Quantity& quantity, int axis, int number, int across, int upward) {
  Layer layer{field.size[across], field.size[upward], {}};
  layer.values.assign(static_cast<std::size_t>(layer.nx) * layer.ny, no_fluid);
  for (int j = 0; j < layer.ny; ++j) {
    for (int i = 0; i < layer.nx; ++i) {
      std::array<std::int64_t, 3> cell{};
      cell[axis] = number, cell[across] = i, cell[upward] = j;
      const std::int64_t index = cell[0] + field.size[0] * (cell[1] + field.size[1] * cell[2]);
      if (!field.fluid[index]) continue;
      const auto velocity = [&](int c) { return field.velocity[3 * index + c]; };
      const float value =
          quantity.values ? (*quantity.values)[index] : speed_of({velocity(0), velocity(1), velocity(2)});
      if (std::isfinite(value)) layer.values[static_cast<std::size_t>(j) * layer.nx + i] = value;
    }
  }
  return layer;
}

/// From 0, or from the lowest value where it is below. Fines: four powers of ten, as they thin out without end.
ColourScale scale_of(const Layer& layer, bool logarithmic, std::optional<double> maximum) {
  double low = 0.0, high = 0.0;
  for (const float value : layer.values)
    if (!std::isnan(value)) low = std::min<double>(low, value), high = std::max<double>(high, value);
  if (logarithmic) {
    const double whole = high > 0.0 ? std::pow(10.0, std::ceil(std::log10(high) - 1e-9)) : 1.0;
    return {maximum.value_or(whole) * 1e-4, maximum.value_or(whole), true};
  }
  const double bottom = low < 0.0 ? -scale_end(-low) : 0.0;
  return {bottom, maximum.value_or(high > 0.0 || bottom == 0.0 ? scale_end(high) : 0.0), false};
}

}  // namespace

std::vector<std::string> slice_quantities(const FieldFrame& field) {
  std::vector<std::string> names;
  if (!field.velocity.empty()) names.emplace_back("speed");
  if (!field.pressure.empty()) names.emplace_back("pressure");
  if (!field.fines.empty()) names.emplace_back("fines");
  for (const NamedArray& scalar : field.fines) names.push_back("fines_" + scalar.name);
  return names;
}

Canvas slice_picture(const FieldFrame& field, const WallFrame& walls, const std::string& quantity, int axis, double at,
                     const Caption& caption, std::optional<double> maximum, int width, int height) {
  const Quantity painted = quantity_of(field, quantity);
  const int across = axis == 0 ? 1 : 0, upward = axis == 2 ? 1 : 2;  // axes of the picture
  const int number =
      std::clamp(static_cast<int>(std::lround((at - field.origin[axis]) / field.dx)), 0, field.size[axis] - 1);
  const Layer layer = layer_of(field, painted, axis, number, across, upward);
  const ColourScale scale = scale_of(layer, painted.logarithmic, maximum);
  Canvas canvas(width, height);
  const Box view = stage(width, height, 150);
  const int nx = layer.nx, ny = layer.ny;
  const double zoom = std::min(view.width / (nx * field.dx), view.height / (ny * field.dx));  // [pixel/m]
  const double x0 = view.x + 0.5 * (view.width - zoom * nx * field.dx);
  const double y0 = view.y + 0.5 * (view.height + zoom * ny * field.dx);
  const double low_x = field.origin[across] - 0.5 * field.dx, low_y = field.origin[upward] - 0.5 * field.dx;
  // Smooth between the cells; cells that are not fluid do not count. A pixel belongs to the cell it lies in.
  for (int py = static_cast<int>(y0 - zoom * ny * field.dx); py < y0; ++py) {
    for (int px = static_cast<int>(x0); px < x0 + zoom * nx * field.dx; ++px) {
      const double u = (px + 0.5 - x0) / (zoom * field.dx), v = (y0 - py - 0.5) / (zoom * field.dx);  // in cells
      if (!layer.fluid(static_cast<int>(std::floor(u)), static_cast<int>(std::floor(v)))) continue;
      const int i = static_cast<int>(std::floor(u - 0.5)), j = static_cast<int>(std::floor(v - 0.5));
      double sum = 0, weights = 0;
      for (int corner = 0; corner < 4; ++corner) {
        const int a = i + (corner & 1), b = j + (corner >> 1);
        if (!layer.fluid(a, b)) continue;
        const double weight = (1 - std::abs(u - 0.5 - a)) * (1 - std::abs(v - 0.5 - b));
        sum += weight * layer.at(a, b);
        weights += weight;
      }
      if (weights > 0) canvas.blend(px, py, scale.colour(sum / weights), 1.0f);
    }
  }
  const double place = field.origin[axis] + number * field.dx;
  std::vector<Canvas::Segment> outline;
  for (const auto& [a, b] : cut_of(walls, axis, place)) {
    outline.push_back({x0 + zoom * (a[across] - low_x), y0 - zoom * (a[upward] - low_y),
                       x0 + zoom * (b[across] - low_x), y0 - zoom * (b[upward] - low_y)});
  }
  canvas.stroke(outline, ink, 2.0);
  const std::string plane = std::string(1, "xyz"[axis]) + formatted(" = %.3g mm", place * 1e3);
  const bool none = painted.logarithmic &&
                    std::none_of(layer.values.begin(), layer.values.end(), [](float value) { return value > 0.0F; });
  draw_title(canvas, painted.title + " at " + plane, subtitle(caption, none ? "none on this plane" : ""));
  draw_colour_bar(canvas, colour_bar_place(width, height), scale, painted.label);
  draw_scale_bar(canvas, 60, height - 45, zoom);
  return canvas;
}

}  // namespace puffin::output
