#pragma once
// What charts are drawn with: lines, texts, colours and a legend as SVG text. Coordinates in pixels, y downwards.

#include <string>
#include <vector>

#include "tools/output/picture/colour.hpp"

namespace puffin::output::svg {

inline constexpr char text_colour[] = "#21262d", soft_colour[] = "#5f6873", grid_colour[] = "#e3e6ea";

/// "#rrggbb".
std::string hex(const Colour& c);
/// One decimal: a tenth of a pixel.
std::string coordinate(double value);
/// anchor: start | middle | end; more: further attributes, with a space in front.
std::string text_at(double x, double y, const std::string& text, const std::string& anchor,
                    const std::string& colour = text_colour, const std::string& more = {});
std::string line_at(double x0, double y0, double x1, double y1, const std::string& colour,
                    const std::string& more = {});
/// The opening tag of a drawing of that size; `label`: what it shows, for those who cannot see it.
std::string open(double width, double height, const std::string& label);
/// A drawing as a file of its own: with its name space and a white ground.
std::string standalone(const std::string& svg);
/// Colour swatches with names from (x, y) on, in as many rows as they need to end before `right`; a name that is longer
/// than a row is squeezed into it.
std::string legend(const std::vector<std::string>& names, double x, double y, double right);
/// By how much its further rows move down what is below.
double legend_growth(const std::vector<std::string>& names, double x, double right);

}  // namespace puffin::output::svg
