#include "tools/output/report/svg.hpp"

#include <cmath>
#include <cstdio>

#include "tools/output/report/html.hpp"

namespace puffin::output::svg {
namespace {

constexpr double row_height = 20, swatch = 20, between = 20, letter = 7.6;  // [pixel] of letters of 13

/// Where a name of a legend stands.
struct Place {
  double x;
  int row;
  double length;  // of the name
};

std::vector<Place> legend_places(const std::vector<std::string>& names, double x, double right) {
  std::vector<Place> places;
  double at = x;
  int row = 0;
  for (const std::string& name : names) {
    const double length = letter * static_cast<double>(name.size());
    if (at > x && at + swatch + length > right) at = x, ++row;
    places.push_back({at, row, length});
    at += swatch + length + between;
  }
  return places;
}

}  // namespace

std::string hex(const Colour& c) {
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<int>(std::lround(255 * c.r)),
                static_cast<int>(std::lround(255 * c.g)), static_cast<int>(std::lround(255 * c.b)));
  return text;
}

std::string coordinate(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string text_at(double x, double y, const std::string& text, const std::string& anchor, const std::string& colour,
                    const std::string& more) {
  return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
         colour + "\"" + more + ">" + text + "</text>";
}

std::string line_at(double x0, double y0, double x1, double y1, const std::string& colour, const std::string& more) {
  return "<line x1=\"" + coordinate(x0) + "\" y1=\"" + coordinate(y0) + "\" x2=\"" + coordinate(x1) + "\" y2=\"" +
         coordinate(y1) + "\" stroke=\"" + colour + "\"" + more + "/>";
}

std::string open(double w, double h, const std::string& label) {
  return "<svg viewBox=\"0 0 " + coordinate(w) + " " + coordinate(h) + "\" role=\"img\" aria-label=\"" +
         escaped(label) + "\" font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"13\">\n";
}

std::string standalone(const std::string& svg) {
  const std::size_t end = svg.find('>') + 1;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + svg.substr(5, end - 5) +
         "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>" + svg.substr(end);
}

std::string legend(const std::vector<std::string>& names, double x, double y, double right) {
  std::string out;
  const std::vector<Place> places = legend_places(names, x, right);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double at = places[i].x, line = y + places[i].row * row_height, room = right - at - swatch;
    const bool squeezed = places[i].length > room;
    out += "<rect x=\"" + coordinate(at) + "\" y=\"" + coordinate(line - 10) +
           "\" width=\"14\" height=\"12\" rx=\"2\" fill=\"" + hex(distinct(static_cast<int>(i))) + "\"/>" +
           text_at(at + swatch, line, escaped(names[i]), "start", text_colour,
                   squeezed ? " lengthAdjust=\"spacingAndGlyphs\" textLength=\"" + coordinate(room) + "\"" : "");
  }
  return out;
}

double legend_growth(const std::vector<std::string>& names, double x, double right) {
  return names.empty() ? 0.0 : row_height * legend_places(names, x, right).back().row;
}

}  // namespace puffin::output::svg
