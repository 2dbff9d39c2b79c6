#pragma once
// What makes a picture readable: title, colour bar, scale bar, legend.

#include <string>
#include <vector>

#include "tools/output/picture/canvas.hpp"

namespace puffin::output {

/// A colour scale from low to high, linear or logarithmic, with viridis.
struct ColourScale {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
  /// 0..1 along the scale, clamped.
  float position(double value) const;
  Colour colour(double value) const { return viridis(position(value)); }
  /// Values to be marked: round numbers, or whole powers of ten.
  std::vector<double> ticks() const;
};

/// The smallest of 1, 2, 2.5, 5, 10 times a power of ten that is at least `value`; 1 for values that are not positive.
double round_up(double value);
/// The same with finer steps: the end of a colour scale that wastes little of it.
double scale_end(double value);
/// A short decimal text of a round number: "0.25", "12", "1e-9".
std::string short_number(double value);

void draw_title(Canvas& canvas, const std::string& title, const std::string& subtitle);
/// An upright bar with ticks and the quantity beside it.
void draw_colour_bar(Canvas& canvas, const Box& bar, const ColourScale& scale, const std::string& quantity);
/// A bar of a round number of millimetres; scale in pixel per metre.
void draw_scale_bar(Canvas& canvas, double x, double y, double scale);

struct LegendItem {
  Colour colour;
  std::string text, note;
};
void draw_legend(Canvas& canvas, double x, double y, const std::vector<LegendItem>& items);

}  // namespace puffin::output
