#include "cases/format/phrases.hpp"

#include <array>
#include <stdexcept>

#include "cases/units.hpp"

namespace puffin::cases::format {
namespace {

std::string without_spaces(std::string_view text) {
  std::string s;
  for (const char c : text)
    if (c != ' ' && c != '\t') s += c;
  return s;
}

std::string quoted(std::string_view s) { return "'" + std::string(s) + "'"; }

/// The lengths in "[a,b,[c]]": brackets only group.
std::vector<double> lengths(std::string_view text) {
  std::vector<double> values;
  std::string word;
  const auto flush = [&] {
    if (!word.empty()) values.push_back(parse_quantity(word, unit::length));
    word.clear();
  };
  for (const char c : text) {
    if (c == ',' || c == '[' || c == ']')
      flush();
    else
      word += c;
  }
  flush();
  return values;
}

std::string bracketed(const std::vector<double>& values) {
  std::string s = "[";
  for (std::size_t i = 0; i < values.size(); ++i) s += (i ? "," : "") + shortest(values[i]);
  return s + "]";
}

}  // namespace

int parse_axis(std::string_view text) {
  if (text == "x" || text == "y" || text == "z") return text[0] - 'x';
  throw std::invalid_argument(quoted(text) + " is no axis; give x, y or z");
}

std::string_view axis_name(int axis) { return std::array{"x", "y", "z"}.at(axis); }

std::string canonical_selection(std::string_view text) {
  if (text.starts_with("solid:") && text.size() > 6) return std::string(text);
  const std::string s = without_spaces(text);
  if (s.starts_with("plane:")) {
    const std::string_view face = std::string_view(s).substr(6);
    if (face.size() == 5 && face[0] >= 'x' && face[0] <= 'z' && (face.ends_with("-min") || face.ends_with("-max")))
      return s;
    throw std::invalid_argument(quoted(face) + " is no face; give x-min, x-max, y-min, y-max, z-min or z-max");
  }
  if (s.starts_with("near:")) {
    const std::vector<double> point = lengths(std::string_view(s).substr(5));
    if (point.size() == 3) return "near:" + bracketed(point);
    throw std::invalid_argument("near: needs a point, like \"near:[0.01, 0, 0.002]\"");
  }
  throw std::invalid_argument(quoted(text) + R"( selects nothing; give "solid:NAME", "plane:x-min" or "near:[x,y,z]")");
}

Region parse_region(std::string_view text) {
  const std::string s = without_spaces(text);
  if (s == "all") return RegionAll{};
  if (s.starts_with("slice:")) {
    const std::string_view rest = std::string_view(s).substr(6);
    if (const std::size_t equals = rest.find('='); equals != std::string_view::npos)
      return RegionSlice{parse_axis(rest.substr(0, equals)), parse_quantity(rest.substr(equals + 1), unit::length)};
    throw std::invalid_argument("a slice needs its place, like \"slice:z=2.2mm\"");
  }
  if (s.starts_with("box:")) {
    const std::vector<double> v = lengths(std::string_view(s).substr(4));
    if (v.size() != 6)
      throw std::invalid_argument("a box needs its two corners, like \"box:[x0,y0,z0,x1,y1,z1]\"; got " +
                                  std::to_string(v.size()) + " numbers");
    const RegionBox box{Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5])};
    if (!(box.min.array() < box.max.array()).all())
      throw std::invalid_argument("the box's first corner must lie below its second in x, y and z");
    return box;
  }
  throw std::invalid_argument(quoted(text) +
                              R"( is no region; give "all", "slice:z=2.2mm" or "box:[x0,y0,z0,x1,y1,z1]")");
}

std::string format_region(const Region& region) {
  if (const auto* slice = std::get_if<RegionSlice>(&region))
    return "slice:" + std::string(axis_name(slice->axis)) + "=" + shortest(slice->at);
  if (const auto* box = std::get_if<RegionBox>(&region))
    return "box:" + bracketed({box->min.x(), box->min.y(), box->min.z(), box->max.x(), box->max.y(), box->max.z()});
  return "all";
}

}  // namespace puffin::cases::format
