#pragma once
// A picture of pixels: text, lines, boxes, and the PNG file. Pixel (0,0) is at the upper left; y points down.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/output/picture/colour.hpp"

namespace puffin::output {

struct Box {
  double x = 0, y = 0, width = 0, height = 0;  // [pixel]
};

enum class Align { left, centre, right };

struct TextStyle {
  int size = 24;  // height of the font [pixel]
  bool bold = false;
  Colour colour = ink;
  Align align = Align::left;
  bool upright = false;  // turned by 90 degrees, reading upwards
  bool halo = false;     // a white rim, to be read on any ground
};

class Canvas {
 public:
  Canvas(int width, int height) : width_(width), height_(height), pixels_(3u * width * height, 255) {}

  int width() const { return width_; }
  int height() const { return height_; }

  /// Mixes a colour into one pixel; outside the picture nothing happens.
  void blend(int x, int y, const Colour& colour, float opacity);
  void fill(const Box& box, const Colour& colour, float opacity = 1.0f);
  /// A straight line with smooth edges; ends and width in pixels.
  void line(double x0, double y0, double x1, double y1, const Colour& colour, double width = 1.5);
  /// Many lines as one stroke: where they overlap they are no darker.
  struct Segment {
    double x0, y0, x1, y1;
  };
  void stroke(const std::vector<Segment>& segments, const Colour& colour, double width);
  void frame(const Box& box, const Colour& colour, double width = 1.5);
  /// Text (ASCII; "m^2" and "10^{12}" raise what follows the '^') whose middle line is at y; x is its left, middle or
  /// right end. Returns its length [pixel].
  double text(double x, double y, const std::string& text, const TextStyle& style = {});

  /// The bytes of a PNG file.
  std::string png() const;
  /// Red, green, blue of a pixel, 0..255.
  const std::uint8_t* pixel(int x, int y) const { return &pixels_[3u * (static_cast<std::size_t>(y) * width_ + x)]; }

 private:
  int width_, height_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace puffin::output
