#include "tools/output/picture/canvas.hpp"

#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_map>

namespace puffin::output {
namespace {

constexpr char plain_font[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr char bold_font[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";

/// Opacity of every pixel of a text, rows from the top.
struct Stamp {
  int width = 0, height = 0;
  std::vector<float> opacity;
  float at(int x, int y) const { return opacity[static_cast<std::size_t>(y) * width + x]; }
};

/// One piece of text as VTK's FreeType draws it, in DejaVu or else in VTK's built-in font. ASCII only: this version of
/// VTK takes text byte by byte.
Stamp stamp_of(const std::string& text, int size, bool bold) {
  Stamp stamp;
  if (text.empty()) return stamp;
  vtkNew<vtkTextProperty> property;
  static const bool has_font = std::filesystem::exists(plain_font) && std::filesystem::exists(bold_font);
  if (has_font) {
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(bold ? bold_font : plain_font);
  } else {
    property->SetFontFamilyToArial();
    property->SetBold(bold ? 1 : 0);
  }
  property->SetFontSize(size);
  property->SetColor(0, 0, 0);
  vtkNew<vtkImageData> image;
  int dims[2] = {0, 0};
  vtkFreeTypeTools* tools = vtkFreeTypeTools::GetInstance();
  tools->ScaleToPowerTwoOff();
  if (!tools->RenderString(property, text, 72, image, dims)) return stamp;
  int extent[3];
  image->GetDimensions(extent);
  stamp.width = std::min(dims[0], extent[0]);
  stamp.height = std::min(dims[1], extent[1]);
  const int components = image->GetNumberOfScalarComponents();
  const auto* bytes = static_cast<const unsigned char*>(image->GetScalarPointer());
  for (int row = stamp.height - 1; row >= 0; --row) {
    for (int x = 0; x < stamp.width; ++x) {
      const std::size_t at = (static_cast<std::size_t>(row) * extent[0] + x) * components + (components - 1);
      stamp.opacity.push_back(static_cast<float>(bytes[at]) / 255.0f);
    }
  }
  return stamp;
}

/// b to the right of a, its top at row `drop` of the whole.
Stamp joined(const Stamp& a, const Stamp& b, int drop) {
  if (b.width == 0) return a;
  Stamp whole;
  whole.width = a.width + b.width;
  whole.height = std::max(a.height, b.height + drop);
  whole.opacity.assign(static_cast<std::size_t>(whole.width) * whole.height, 0.0f);
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) whole.opacity[static_cast<std::size_t>(y) * whole.width + x] = a.at(x, y);
  }
  for (int y = 0; y < b.height; ++y) {
    for (int x = 0; x < b.width; ++x) {
      whole.opacity[static_cast<std::size_t>(y + drop) * whole.width + a.width + x] = b.at(x, y);
    }
  }
  return whole;
}

Stamp turned(const Stamp& a) {
  Stamp b;
  b.width = a.height, b.height = a.width;
  for (int y = 0; y < b.height; ++y) {
    for (int x = 0; x < b.width; ++x) b.opacity.push_back(a.at(a.width - 1 - y, x));
  }
  return b;
}

/// The whole text; what follows a '^' (one sign, or several in braces) is raised and smaller.
Stamp stamp_of(const std::string& text, const TextStyle& style) {
  Stamp whole;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t mark = std::min(text.find('^', begin), text.size());
    whole = joined(whole, stamp_of(text.substr(begin, mark - begin), style.size, style.bold), 0);
    if (mark + 1 >= text.size()) break;
    const bool braces = text[mark + 1] == '{';
    const std::size_t from = mark + (braces ? 2 : 1);
    const std::size_t length = braces ? std::min(text.find('}', from), text.size()) - from : 1;
    whole = joined(whole, stamp_of(text.substr(from, length), style.size * 2 / 3, style.bold), 0);
    begin = from + length + (braces ? 1 : 0);
  }
  return style.upright ? turned(whole) : whole;
}

}  // namespace

void Canvas::blend(int x, int y, const Colour& colour, float opacity) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  std::uint8_t* p = &pixels_[3u * (static_cast<std::size_t>(y) * width_ + x)];
  const float part[3] = {colour.r, colour.g, colour.b};
  for (int c = 0; c < 3; ++c) {
    const float mixed = (1.0f - opacity) * p[c] + opacity * 255.0f * part[c];
    p[c] = static_cast<std::uint8_t>(std::clamp(std::lround(mixed), 0l, 255l));
  }
}

void Canvas::fill(const Box& box, const Colour& colour, float opacity) {
  for (int y = static_cast<int>(std::lround(box.y)); y < std::lround(box.y + box.height); ++y) {
    for (int x = static_cast<int>(std::lround(box.x)); x < std::lround(box.x + box.width); ++x)
      blend(x, y, colour, opacity);
  }
}

void Canvas::line(double x0, double y0, double x1, double y1, const Colour& colour, double width) {
  stroke({{x0, y0, x1, y1}}, colour, width);
}

void Canvas::stroke(const std::vector<Segment>& segments, const Colour& colour, double width) {
  std::unordered_map<std::int64_t, float> cover;  // of the pixels touched
  const double reach = 0.5 * width + 1;
  for (const auto& s : segments) {
    const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, length2 = dx * dx + dy * dy;
    const int left = std::max(0, static_cast<int>(std::floor(std::min(s.x0, s.x1) - reach)));
    const int top = std::max(0, static_cast<int>(std::floor(std::min(s.y0, s.y1) - reach)));
    for (int y = top; y <= std::min(height_ - 1.0, std::max(s.y0, s.y1) + reach); ++y) {
      for (int x = left; x <= std::min(width_ - 1.0, std::max(s.x0, s.x1) + reach); ++x) {
        const double px = x + 0.5 - s.x0, py = y + 0.5 - s.y0;
        const double t = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
        const double distance = std::hypot(px - t * dx, py - t * dy);
        const auto here = static_cast<float>(std::clamp(0.5 * width + 0.5 - distance, 0.0, 1.0));
        if (here <= 0) continue;
        float& most = cover[static_cast<std::int64_t>(y) * width_ + x];
        most = std::max(most, here);
      }
    }
  }
  for (const auto& [at, opacity] : cover)
    blend(static_cast<int>(at % width_), static_cast<int>(at / width_), colour, opacity);
}

void Canvas::frame(const Box& b, const Colour& colour, double width) {
  const double right = b.x + b.width, bottom = b.y + b.height;
  stroke({{b.x, b.y, right, b.y}, {right, b.y, right, bottom}, {right, bottom, b.x, bottom}, {b.x, bottom, b.x, b.y}},
         colour, width);
}

double Canvas::text(double x, double y, const std::string& text, const TextStyle& style) {
  const Stamp stamp = stamp_of(text, style);
  const double shift = style.align == Align::left ? 0.0 : style.align == Align::centre ? 0.5 : 1.0;
  const int left = static_cast<int>(std::lround(style.upright ? x - 0.5 * stamp.width : x - shift * stamp.width));
  const int top =
      static_cast<int>(std::lround(style.upright ? y - (1 - shift) * stamp.height : y - 0.5 * stamp.height));
  const auto draw = [&](int ox, int oy, const Colour& colour, float strength) {
    for (int row = 0; row < stamp.height; ++row) {
      for (int column = 0; column < stamp.width; ++column) {
        const float opacity = stamp.at(column, row);
        if (opacity > 0) blend(left + column + ox, top + row + oy, colour, strength * opacity);
      }
    }
  };
  for (int oy = -2; style.halo && oy <= 2; ++oy) {
    for (int ox = -2; ox <= 2; ++ox) draw(ox, oy, white, 0.5f);
  }
  draw(0, 0, style.colour, 1.0f);
  return style.upright ? stamp.height : stamp.width;
}

std::string Canvas::png() const {
  vtkNew<vtkImageData> image;
  image->SetDimensions(width_, height_, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < height_; ++y) {
    auto* row = static_cast<unsigned char*>(image->GetScalarPointer(0, height_ - 1 - y, 0));
    std::copy_n(pixel(0, y), 3 * width_, row);
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->SetCompressionLevel(7);
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

}  // namespace puffin::output
