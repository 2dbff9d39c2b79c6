#include "tools/output/report/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/output/picture/decorations.hpp"
#include "tools/output/report/html.hpp"
#include "tools/output/report/svg.hpp"

namespace puffin::output {

using namespace svg;

namespace {

constexpr double width = 860, left = 86, right = 30, bottom = 60;

/// A logarithmic axis in pixels.
class LogAxis {
 public:
  LogAxis(double from, double to, double pixel_low, double pixel_high)
      : low_(std::log10(from) - 0.08), high_(std::log10(to) + 0.08), pixel_low_(pixel_low), pixel_high_(pixel_high) {
    if (high_ - low_ < 0.5) {
      const double middle = 0.5 * (low_ + high_);
      low_ = middle - 0.25;
      high_ = middle + 0.25;
    }
  }
  double pixel(double value) const {
    const double at = value > 0.0 ? std::log10(value) : low_;
    return pixel_low_ + (pixel_high_ - pixel_low_) * (std::clamp(at, low_, high_) - low_) / (high_ - low_);
  }
  std::vector<double> ticks() const {
    std::vector<double> list;
    const bool fine = high_ - low_ < 2.5;
    for (int power = static_cast<int>(std::floor(low_)); power <= static_cast<int>(std::ceil(high_)); ++power)
      for (const double digit : {1.0, 2.0, 5.0}) {
        if (digit > 1.0 && !fine) continue;
        const double value = digit * std::pow(10.0, power);
        if (std::log10(value) >= low_ && std::log10(value) <= high_) list.push_back(value);
      }
    return list;
  }

 private:
  double low_, high_, pixel_low_, pixel_high_;
};

bool drawable(const ScatterPoint& p) { return p.x > 0.0 && p.y > 0.0 && std::isfinite(p.x) && std::isfinite(p.y); }

std::string point_mark(const ScatterPoint& p, const std::string& colour, const LogAxis& x, const LogAxis& y) {
  const double px = x.pixel(p.x), py = y.pixel(p.y);
  std::string out;
  if (p.low && p.high) {
    const double a = y.pixel(*p.low), b = y.pixel(*p.high);
    out += line_at(px, a, px, b, colour, " stroke-opacity=\"0.55\"");
    out += line_at(px - 3, b, px + 3, b, colour, " stroke-opacity=\"0.55\"");
    if (*p.low > 0.0) out += line_at(px - 3, a, px + 3, a, colour, " stroke-opacity=\"0.55\"");
  }
  out += "<circle cx=\"" + coordinate(px) + "\" cy=\"" + coordinate(py) + "\" r=\"4\" fill=\"" + colour + "\"/>";
  if (p.marked)
    out += "<circle cx=\"" + coordinate(px) + "\" cy=\"" + coordinate(py) + "\" r=\"9\" fill=\"none\" stroke=\"" +
           std::string(text_colour) + "\" stroke-width=\"2\"/>";
  return out + "\n";
}

/// Labels to the right of their points, or to the left near the edge; each is pushed down from those above it.
std::string labels(const std::vector<ScatterSeries>& series, const LogAxis& x, const LogAxis& y) {
  struct Label {
    double x, y;
    bool left_of;
    std::string text;
  };
  std::vector<Label> list;
  for (const auto& s : series)
    for (const auto& p : s.points)
      if (drawable(p) && !p.label.empty()) {
        const bool left_of = x.pixel(p.x) + 12 + 6.2 * static_cast<double>(p.label.size()) > width - right;
        list.push_back({x.pixel(p.x) + (left_of ? -9 : 9), y.pixel(p.y) - 7, left_of, p.label});
      }
  std::sort(list.begin(), list.end(), [](const Label& a, const Label& b) { return a.y < b.y; });
  std::string out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double reach = 6.2 * static_cast<double>(std::max(list[i].text.size(), list[k].text.size()));
      if (std::abs(list[i].x - list[k].x) < reach && list[i].y - list[k].y < 13) list[i].y = list[k].y + 13;
    }
    out += text_at(list[i].x, list[i].y, escaped(list[i].text), list[i].left_of ? "end" : "start", soft_colour,
                   " font-size=\"11\"");
  }
  return out;
}

std::string connection(const ScatterSeries& s, const std::string& colour, const LogAxis& x, const LogAxis& y) {
  std::string path;
  double last = 0.0;
  for (const auto& p : s.points) {
    if (!drawable(p)) continue;
    const double px = x.pixel(p.x), py = y.pixel(p.y);
    if (s.steps && !path.empty()) path += coordinate(px) + "," + coordinate(last) + " ";
    path += coordinate(px) + "," + coordinate(py) + " ";
    last = py;
  }
  if (s.steps && !path.empty()) path += coordinate(width - right) + "," + coordinate(last);
  return "<polyline fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"1.6\" stroke-opacity=\"0.8\" points=\"" +
         path + "\"/>\n";
}

}  // namespace

std::string scatter_chart(const ScatterChart& chart) {
  constexpr double far = std::numeric_limits<double>::infinity();
  double x0 = far, x1 = 0.0, y0 = far, y1 = 0.0;
  for (const auto& s : chart.series)
    for (const auto& p : s.points) {
      if (!drawable(p)) continue;
      x0 = std::min(x0, p.x), x1 = std::max(x1, p.x);
      y0 = std::min(y0, p.y), y1 = std::max(y1, std::max(p.y, p.high.value_or(0.0)));
    }
  std::vector<std::string> names;
  for (const ScatterSeries& s : chart.series) names.push_back(s.name);
  const double more = legend_growth(names, left, width - right), height = 520 + more, top = 66 + more;
  if (!(x1 > 0.0)) x0 = y0 = 1.0, x1 = y1 = 10.0;
  const LogAxis x(x0, x1, left, width - right), y(y0, y1, height - bottom, top);
  std::string svg = open(width, height, chart.title + ": " + chart.y_label + " over " + chart.x_label);
  svg += text_at(left, 22, escaped(chart.title), "start", text_colour, " font-size=\"15\" font-weight=\"600\"");
  for (const double tick : y.ticks()) {
    svg += line_at(left, y.pixel(tick), width - right, y.pixel(tick), grid_colour);
    svg += text_at(left - 8, y.pixel(tick) + 4.5, short_number(tick), "end", soft_colour);
  }
  for (const double tick : x.ticks()) {
    svg += line_at(x.pixel(tick), top, x.pixel(tick), height - bottom, grid_colour);
    svg += text_at(x.pixel(tick), height - bottom + 20, short_number(tick), "middle", soft_colour);
  }
  svg += line_at(left, height - bottom, width - right, height - bottom, soft_colour);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const ScatterSeries& s = chart.series[i];
    const std::string colour = hex(distinct(static_cast<int>(i)));
    if (s.joined || s.steps) svg += connection(s, colour, x, y);
    for (const auto& p : s.points)
      if (drawable(p)) svg += point_mark(p, colour, x, y);
  }
  svg += labels(chart.series, x, y);
  svg += legend(names, left, 48, width - right);
  svg += text_at(0.5 * (left + width - right), height - 14, escaped(chart.x_label), "middle");
  svg += text_at(0, 0, escaped(chart.y_label), "middle", text_colour,
                 " transform=\"translate(20 " + coordinate(0.5 * (top + height - bottom)) + ") rotate(-90)\"");
  return svg + "</svg>\n";
}

}  // namespace puffin::output
