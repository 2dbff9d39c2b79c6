#pragma once
// Charts as SVG text, for pages that load nothing.

#include <optional>
#include <string>
#include <vector>

namespace puffin::output {

struct Curve {
  std::string name;
  std::vector<double> x, y;  // points that are not finite are left out
};

struct Marker {
  double x = 0.0;
  std::string text;  // beside an upright line
};

struct LineChart {
  std::string x_label, y_label;
  std::vector<Curve> curves;
  std::vector<Marker> markers;
  double y_at_least = 0.0;  // the y axis reaches this far
  double width = 760.0;     // [pixel]; a narrow chart has larger letters on the page
};
/// Long curves are thinned to about 600 points, extremes kept. The y axis includes 0.
std::string line_chart(const LineChart& chart);

struct Bar {
  std::string series;  // bars of one series share a colour
  double value = 0.0;
  std::optional<double> low, high;  // drawn as a whisker
};

struct BarGroup {
  std::string name;
  std::vector<Bar> bars;
};

struct BarChart {
  std::string value_label;
  std::vector<BarGroup> groups;
  int digits = 3;  // significant, of the numbers beside the bars
};
/// Lying bars, group by group, the number at the end of each. Values are at least 0.
std::string bar_chart(const BarChart& chart);

}  // namespace puffin::output
