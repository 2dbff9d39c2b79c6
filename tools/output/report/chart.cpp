#include "tools/output/report/chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tools/output/picture/decorations.hpp"
#include "tools/output/report/html.hpp"
#include "tools/output/report/svg.hpp"

namespace puffin::output {

using namespace svg;

namespace {

constexpr double full_width = 760, left = 78, right = 22, bottom = 54;
/// One axis: from a round number to a round number.
struct Axis {
  double low = 0.0, high = 1.0, step = 1.0;
  Axis(double from, double to) {
    if (!(to > from)) to = from + 1;
    step = round_up((to - from) / 6);
    low = step * std::floor(from / step + 1e-9);
    high = step * std::ceil(to / step - 1e-9);
  }
  std::vector<double> ticks() const {
    std::vector<double> out;
    for (int i = 0; low + i * step <= high + 1e-9 * step; ++i) out.push_back(low + i * step);
    return out;
  }
};

/// Of every stretch of points the lowest and the highest, so that peaks survive the thinning.
std::vector<std::size_t> thinned(const Curve& curve) {
  std::vector<std::size_t> kept;
  const std::size_t n = std::min(curve.x.size(), curve.y.size()), stretch = std::max<std::size_t>(1, n / 300);
  for (std::size_t begin = 0; begin < n; begin += stretch) {
    std::size_t lowest = begin, highest = begin;
    for (std::size_t i = begin; i < std::min(n, begin + stretch); ++i) {
      if (curve.y[i] < curve.y[lowest]) lowest = i;
      if (curve.y[i] > curve.y[highest]) highest = i;
    }
    kept.push_back(std::min(lowest, highest));
    if (lowest != highest) kept.push_back(std::max(lowest, highest));
  }
  if (n > 0 && kept.back() != n - 1) kept.push_back(n - 1);
  return kept;
}

/// "pressure drop [Pa] over time [ms]: static, total to static"
std::string spoken(std::string what, const std::vector<std::string>& names) {
  for (std::size_t n = 0; n < names.size(); ++n) what += (n == 0 ? ": " : ", ") + names[n];
  return what;
}

}  // namespace

std::string line_chart(const LineChart& chart) {
  std::vector<std::string> names;
  for (const Curve& curve : chart.curves) names.push_back(curve.name);
  const double width = chart.width, more = legend_growth(names, left, width - right);
  const double height = 330 + more, top = 46 + more;
  double x0 = std::numeric_limits<double>::infinity(), x1 = -x0, y0 = 0.0, y1 = chart.y_at_least;
  for (const auto& curve : chart.curves) {
    for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
      if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
      x0 = std::min(x0, curve.x[i]), x1 = std::max(x1, curve.x[i]);
      y0 = std::min(y0, curve.y[i]), y1 = std::max(y1, curve.y[i]);
    }
  }
  if (!(x0 <= x1)) x0 = 0, x1 = 1;
  Axis x(x0, x1);
  x.low = x0, x.high = std::max(x1, x0 + 1e-300);
  const Axis y(y0, y1);
  const auto px = [&](double v) { return left + (width - left - right) * (v - x.low) / (x.high - x.low); };
  const auto py = [&](double v) { return height - bottom - (height - top - bottom) * (v - y.low) / (y.high - y.low); };

  std::string svg = open(width, height, spoken(chart.y_label + " over " + chart.x_label, names));
  for (const double tick : y.ticks()) {
    svg += line_at(left, py(tick), width - right, py(tick), grid_colour);
    svg += text_at(left - 8, py(tick) + 4.5, short_number(tick), "end", soft_colour);
  }
  for (double tick = x.step * std::ceil(x.low / x.step - 1e-9); tick <= x.high + 1e-9 * x.step; tick += x.step) {
    svg += line_at(px(tick), height - bottom, px(tick), height - bottom + 5, soft_colour);
    svg += text_at(px(tick), height - bottom + 20, short_number(tick), "middle", soft_colour);
  }
  svg += line_at(left, py(0), width - right, py(0), soft_colour);
  double last_end = 0.0;  // of the label before (in the order of time), which the next must not touch
  for (const auto& marker : chart.markers) {
    if (marker.x < x.low || marker.x > x.high) continue;
    svg += line_at(px(marker.x), top, px(marker.x), height - bottom, soft_colour, " stroke-dasharray=\"4 4\"");
    const bool near_end = px(marker.x) > width - 150;
    const double size = 6.5 * static_cast<double>(marker.text.size());  // of a label in letters of 12
    const double from = px(marker.x) + (near_end ? -5 - size : 5);
    const bool below = from < last_end;
    last_end = from + size;
    svg += text_at(px(marker.x) + (near_end ? -5 : 5), below ? top + 10 : top - 5, escaped(marker.text),
                   near_end ? "end" : "start", soft_colour, " font-size=\"12\"");
  }
  for (std::size_t c = 0; c < chart.curves.size(); ++c) {
    const Curve& curve = chart.curves[c];
    std::string points;
    for (const std::size_t i : thinned(curve)) {
      if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
      points += coordinate(px(curve.x[i])) + "," + coordinate(py(curve.y[i])) + " ";
    }
    svg += "<polyline fill=\"none\" stroke=\"" + hex(distinct(static_cast<int>(c))) +
           "\" stroke-width=\"2\" stroke-linejoin=\"round\" points=\"" + points + "\"/>\n";
  }
  svg += legend(names, left, 20, width - right);
  svg += text_at(0.5 * (left + width - right), height - 10, escaped(chart.x_label), "middle");
  svg += text_at(0, 0, escaped(chart.y_label), "middle", text_colour,
                 " transform=\"translate(18 " + coordinate(0.5 * (top + height - bottom)) + ") rotate(-90)\"");
  return svg + "</svg>\n";
}

std::string bar_chart(const BarChart& chart) {
  constexpr double width = full_width, bar = 18, gap = 16, label = 190, end = 90;
  std::vector<std::string> series;
  double largest = 0.0, rows = 0.0;
  for (const auto& group : chart.groups) {
    rows += gap;
    for (const auto& one : group.bars) {
      if (std::find(series.begin(), series.end(), one.series) == series.end()) series.push_back(one.series);
      largest = std::max({largest, one.value, one.high.value_or(0.0)});
      rows += bar;
    }
  }
  const bool named = series.size() > 1;
  const double first = named ? 38 + legend_growth(series, label, width - right) : 8, total = first + rows + 46;
  const Axis axis(0.0, largest > 0 ? largest : 1.0);
  const auto px = [&](double v) { return label + (width - label - end) * v / axis.high; };
  std::string svg = open(width, total, spoken(chart.value_label, series));
  for (const double tick : axis.ticks()) {
    svg += line_at(px(tick), first, px(tick), first + rows, grid_colour);
    svg += text_at(px(tick), first + rows + 17, short_number(tick), "middle", soft_colour);
  }
  double y = first;
  for (const auto& group : chart.groups) {
    y += gap;
    svg +=
        text_at(label - 10, y + 0.5 * bar * static_cast<double>(group.bars.size()) + 4.5, escaped(group.name), "end");
    for (const auto& one : group.bars) {
      const auto index = std::find(series.begin(), series.end(), one.series) - series.begin();
      svg += "<rect x=\"" + coordinate(label) + "\" y=\"" + coordinate(y + 1.5) + "\" width=\"" +
             coordinate(std::max(1.0, px(one.value) - label)) + "\" height=\"" + coordinate(bar - 3) +
             "\" rx=\"2\" fill=\"" + hex(distinct(static_cast<int>(index))) + "\"/>";
      double text_x = px(one.value);
      if (one.low && one.high) {
        const double middle = y + 0.5 * bar;
        svg += line_at(px(*one.low), middle, px(*one.high), middle, text_colour, " stroke-width=\"1.6\"");
        for (const double v : {*one.low, *one.high}) {
          svg += line_at(px(v), middle - 5, px(v), middle + 5, text_colour, " stroke-width=\"1.6\"");
        }
        text_x = std::max(text_x, px(*one.high));
      }
      char number[32];
      std::snprintf(number, sizeof number, "%.*g", chart.digits, one.value);
      svg += text_at(text_x + 7, y + 0.5 * bar + 4.5, number, "start", soft_colour, " font-size=\"12\"");
      y += bar;
    }
    svg += "\n";
  }
  svg += line_at(label, first, label, first + rows, soft_colour);
  if (named) svg += legend(series, label, 20, width - right);
  svg += text_at(0.5 * (label + width - end), total - 6, escaped(chart.value_label), "middle");
  return svg + "</svg>\n";
}

}  // namespace puffin::output
