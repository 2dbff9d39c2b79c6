#include "tools/output/picture/decorations.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <span>

namespace puffin::output {

float ColourScale::position(double value) const {
  if (logarithmic) {
    if (value <= 0) return 0.0f;
    return static_cast<float>(std::clamp(std::log(value / low) / std::log(high / low), 0.0, 1.0));
  }
  return static_cast<float>(std::clamp((value - low) / (high - low), 0.0, 1.0));
}

std::vector<double> ColourScale::ticks() const {
  std::vector<double> out;
  if (logarithmic) {
    for (int e = static_cast<int>(std::ceil(std::log10(low) - 1e-9)); e <= std::log10(high) + 1e-9; ++e)
      out.push_back(std::pow(10.0, e));
    return out;
  }
  const double step = round_up((high - low) / 6);
  for (int i = static_cast<int>(std::ceil(low / step - 1e-9)); i * step <= high + 1e-9 * step; ++i)
    out.push_back(i * step);
  return out;
}

namespace {

double next_of(double value, std::span<const double> factors) {
  if (!(value > 0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : factors) {
    if (factor * power >= value * (1 - 1e-12)) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace

double round_up(double value) { return next_of(value, std::array{1.0, 2.0, 2.5, 5.0}); }
double scale_end(double value) {
  return next_of(value, std::array{1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0});
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", std::abs(value) < 1e-300 ? 0.0 : value);
  return text;
}

void draw_title(Canvas& canvas, const std::string& title, const std::string& subtitle) {
  canvas.text(48, 48, title, {.size = 34, .bold = true});
  canvas.text(48, 92, subtitle, {.size = 23, .colour = soft_ink});
}

void draw_colour_bar(Canvas& canvas, const Box& bar, const ColourScale& scale, const std::string& quantity) {
  for (int row = 0; row < static_cast<int>(bar.height); ++row) {
    const float t = 1.0f - (static_cast<float>(row) + 0.5f) / static_cast<float>(bar.height);
    canvas.fill({bar.x, bar.y + row, bar.width, 1}, viridis(t));
  }
  canvas.frame(bar, soft_ink, 1.0);
  for (const double tick : scale.ticks()) {
    const double y = bar.y + bar.height * (1.0 - scale.position(tick));
    const double x = bar.x + bar.width;
    canvas.line(x, y, x + 7, y, soft_ink, 1.5);
    if (scale.logarithmic) {
      canvas.text(x + 13, y, "10^{" + short_number(std::round(std::log10(tick))) + "}", {.size = 22});
    } else {
      canvas.text(x + 13, y, short_number(tick), {.size = 22});
    }
  }
  canvas.text(bar.x - 20, bar.y + 0.5 * bar.height, quantity, {.size = 23, .align = Align::centre, .upright = true});
}

void draw_scale_bar(Canvas& canvas, double x, double y, double scale) {
  double length = round_up(130.0 / scale * 1e3) * 1e-3;  // about 130 pixels or more
  const double pixels = length * scale;
  canvas.line(x, y, x + pixels, y, ink, 3);
  canvas.line(x, y - 7, x, y + 7, ink, 3);
  canvas.line(x + pixels, y - 7, x + pixels, y + 7, ink, 3);
  canvas.text(x + 0.5 * pixels, y - 20, short_number(length * 1e3) + " mm", {.size = 22, .align = Align::centre});
}

void draw_legend(Canvas& canvas, double x, double y, const std::vector<LegendItem>& items) {
  for (const auto& item : items) {
    canvas.fill({x, y - 12, 24, 24}, item.colour);
    canvas.text(x + 36, y, item.text, {.size = 23, .bold = true});
    canvas.text(x + 36, y + 28, item.note, {.size = 19, .colour = soft_ink});
    y += 70;
  }
}

}  // namespace puffin::output
