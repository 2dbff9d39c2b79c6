#pragma once
// Points over two logarithmic axes, with bars of uncertainty: cost against error, time against size.

#include <optional>
#include <string>
#include <vector>

namespace puffin::output {

struct ScatterPoint {
  double x = 0.0, y = 0.0;          // both > 0; others are left out
  std::optional<double> low, high;  // bar in y; a low end at or below 0 reaches the bottom of the chart
  std::string label;                // beside the point; may be empty
  bool marked = false;              // a ring around it
};

struct ScatterSeries {
  std::string name;
  std::vector<ScatterPoint> points;
  bool joined = false;  // by straight lines, in the order of the points
  bool steps = false;   // by stairs: the best y that x or less buys
};

struct ScatterChart {
  std::string title, x_label, y_label;
  std::vector<ScatterSeries> series;
};
/// Axes reach from below the smallest to above the largest value, with ticks at 1, 2, 5 times powers of ten.
std::string scatter_chart(const ScatterChart& chart);

}  // namespace puffin::output
