#include "cases/units.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

namespace puffin::cases {
namespace {

struct Named {
  std::string_view name;
  double factor;
  Dimension dimension;
  bool prefixable;
};

constexpr double pi = std::numbers::pi;
constexpr std::array named_units{
    Named{"m", 1.0, {0, 1, 0}, true},
    Named{"s", 1.0, {0, 0, 1}, true},
    Named{"g", 1e-3, {1, 0, 0}, true},
    Named{"N", 1.0, {1, 1, -2}, true},
    Named{"Pa", 1.0, {1, -1, -2}, true},
    Named{"J", 1.0, {1, 2, -2}, true},
    Named{"W", 1.0, {1, 2, -3}, true},
    Named{"Hz", 1.0, {0, 0, -1}, true},
    Named{"L", 1e-3, {0, 3, 0}, true},
    Named{"l", 1e-3, {0, 3, 0}, true},
    Named{"bar", 1e5, {1, -1, -2}, true},
    Named{"rad", 1.0, {0, 0, 0, 1}, false},
    Named{"deg", pi / 180.0, {0, 0, 0, 1}, false},
    Named{"rpm", 2.0 * pi / 60.0, {0, 0, -1, 1}, false},
    Named{"min", 60.0, {0, 0, 1}, false},
    Named{"h", 3600.0, {0, 0, 1}, false},
    Named{"lpm", 1e-3 / 60.0, {0, 3, -1}, false},
    Named{"%", 1e-2, {}, false},
    Named{"1", 1.0, {}, false},
};

struct Prefix {
  std::string_view name;
  double factor;
};
constexpr std::array prefixes{Prefix{"n", 1e-9},  Prefix{"u", 1e-6}, Prefix{"\u00b5", 1e-6}, Prefix{"\u03bc", 1e-6},
                              Prefix{"m", 1e-3},  Prefix{"c", 1e-2}, Prefix{"d", 1e-1},      Prefix{"h", 1e2},
                              Prefix{"k", 1e3},   Prefix{"M", 1e6},  Prefix{"G", 1e9},       Prefix{"p", 1e-12},
                              Prefix{"f", 1e-15}, Prefix{"a", 1e-18}};

/// What would be known, for who wrote something else.
std::string known_units() {
  std::string scaled, others;
  for (const Named& u : named_units) {
    if (u.name == "1") continue;
    std::string& list = u.prefixable ? scaled : others;
    list += (list.empty() ? "" : ", ") + std::string(u.name);
  }
  std::string small;
  for (const Prefix& p : prefixes)
    if (p.name.size() == 1) small += (small.empty() ? "" : ", ") + std::string(p.name);  // u stands for the two others
  return scaled + ", also with " + small + " before them; " + others;
}

std::optional<Quantity> find_unit(std::string_view name) {
  for (const Named& u : named_units)
    if (u.name == name) return Quantity{u.factor, u.dimension};
  for (const Prefix& p : prefixes)
    if (name.starts_with(p.name))
      for (const Named& u : named_units)
        if (u.prefixable && u.name == name.substr(p.name.size())) return Quantity{p.factor * u.factor, u.dimension};
  return std::nullopt;
}

Quantity power(Quantity q, int n) {
  return {std::pow(q.value, n), {q.dimension.kg * n, q.dimension.m * n, q.dimension.s * n, q.dimension.rad * n}};
}

Quantity times(const Quantity& a, const Quantity& b) {
  return {a.value * b.value,
          {a.dimension.kg + b.dimension.kg, a.dimension.m + b.dimension.m, a.dimension.s + b.dimension.s,
           a.dimension.rad + b.dimension.rad}};
}

/// expression = factor { (' ' | '*' | '/') factor };  factor = (name | '(' expression ')') [ ['^'] integer ]
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  Quantity parse() {
    const Quantity q = expression(0);
    if (at_ != text_.size()) fail("unexpected '" + std::string(text_.substr(at_, 1)) + "'");
    return q;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw UnitError("cannot read the unit '" + std::string(text_) + "': " + why);
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_spaces() {
    while (peek() == ' ') ++at_;
  }

  Quantity expression(int depth) {
    if (depth > 8) fail("too many brackets");
    skip_spaces();
    Quantity q = factor(depth);
    for (skip_spaces(); peek() != '\0' && peek() != ')'; skip_spaces()) {
      const bool divide = peek() == '/';
      if (divide || peek() == '*') ++at_;
      skip_spaces();
      q = times(q, power(factor(depth), divide ? -1 : 1));
    }
    return q;
  }

  Quantity factor(int depth) {
    Quantity q;
    if (peek() == '(') {
      ++at_;
      q = expression(depth + 1);
      if (peek() != ')') fail("a ')' is missing");
      ++at_;
    } else {
      const std::size_t begin = at_;
      if (peek() == '1')
        ++at_;
      else
        while (peek() != '\0' && std::string_view(" */^()+-0123456789").find(peek()) == std::string_view::npos) ++at_;
      const std::string_view name = text_.substr(begin, at_ - begin);
      if (name.empty()) fail("a unit name is missing");
      const std::optional<Quantity> found = find_unit(name);
      if (!found) fail("'" + std::string(name) + "' is no unit known here; known are " + known_units());
      q = *found;
    }
    return power(q, exponent());
  }

  int exponent() {
    const bool caret = peek() == '^';
    if (caret) ++at_;
    if (!caret && (peek() < '2' || peek() > '9')) return 1;
    int n = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), n);
    if (error != std::errc() || n < -9 || n > 9) fail("a small whole number must follow '^'");
    at_ = end - text_.data();
    return n;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

std::string_view trim(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t')) s.remove_suffix(1);
  return s;
}

/// Splits off the leading number, and leaves its text in `digits`. Throws UnitError.
double take_number(std::string_view& s, std::string_view whole, std::string_view& digits) {
  s = trim(s);
  if (s.starts_with('+')) s.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
  if (error == std::errc::result_out_of_range) throw UnitError("'" + std::string(whole) + "' is out of range");
  if (error != std::errc() || !std::isfinite(value))
    throw UnitError("'" + std::string(whole) + "' does not begin with a number");
  digits = s.substr(0, end - s.data());
  s.remove_prefix(end - s.data());
  s = trim(s);
  return value;
}

/// value times factor, correctly rounded where the factor is a power of ten: "0.234 mm" is the double 0.000234, read
/// from its digits with the exponent moved.
double scaled(double value, std::string_view digits, double factor) {
  const int power = static_cast<int>(std::lround(std::log10(factor)));
  if (std::abs(factor / std::pow(10.0, power) - 1.0) > 1e-12) {
    const double inverse = std::round(1.0 / factor);
    return factor < 1.0 && std::abs(inverse * factor - 1.0) < 1e-12 ? value / inverse : value * factor;
  }
  const std::size_t e = digits.find_first_of("eE");
  int exponent = 0;
  if (e != std::string_view::npos) exponent = std::atoi(std::string(digits.substr(e + 1)).c_str());
  const std::string text = std::string(digits.substr(0, e)) + "e" + std::to_string(exponent + power);
  double moved = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), moved);
  return error == std::errc() ? moved : value * factor;
}

Dimension without_angle(Dimension d) {
  d.rad = 0;
  return d;
}

constexpr std::array known_kinds{unit::number,       unit::length,        unit::time,           unit::velocity,
                                 unit::acceleration, unit::flow_rate,     unit::density,        unit::viscosity,
                                 unit::pressure,     unit::force_density, unit::surface_energy, unit::energy,
                                 unit::rate,         unit::angle,         unit::number_density, unit::angular_velocity};

}  // namespace

std::string describe(const Dimension& d) {
  if (d == Dimension{1, 0, 0}) return "a mass [kg]";
  if (d == Dimension{1, 1, -2}) return "a force [N]";
  if (d == Dimension{0, 2, 0}) return "an area [m^2]";
  if (d == Dimension{0, 3, 0}) return "a volume [m^3]";
  if (d == Dimension{0, 2, -1}) return "a kinematic viscosity or diffusivity [m^2/s]";
  if (d == Dimension{1, 0, -1}) return "a mass flow rate [kg/s]";
  for (const Unit& u : known_kinds)
    if (u.dimension == d) return std::string(u.kind) + (u.symbol.empty() ? "" : " [" + std::string(u.symbol) + "]");
  std::string text;
  const auto append = [&](const char* name, int n) {
    if (n == 0) return;
    if (!text.empty()) text += ' ';
    text += n == 1 ? std::string(name) : name + ("^" + std::to_string(n));
  };
  append("kg", d.kg), append("m", d.m), append("s", d.s), append("rad", d.rad);
  return "[" + text + "]";
}

Quantity parse_quantity(std::string_view text) {
  std::string_view rest = text, digits;
  const double number = take_number(rest, text, digits);
  if (rest.empty()) return {number, {}};
  const Quantity u = UnitParser(rest).parse();
  const double value = scaled(number, digits, u.value);
  if (!std::isfinite(value)) throw UnitError("'" + std::string(text) + "' is out of range");
  return {value, u.dimension};
}

double parse_quantity(std::string_view text, const Unit& expected) {
  std::string_view rest = text, digits;
  const double number = take_number(rest, text, digits);
  if (rest.empty()) return number;
  const Quantity q = parse_quantity(text);
  const bool same =
      q.dimension == expected.dimension || (q.dimension.rad == 0 && q.dimension == without_angle(expected.dimension));
  if (!same) {
    std::string needed = std::string(expected.kind);
    if (!expected.symbol.empty()) needed += " [" + std::string(expected.symbol) + "]";
    throw UnitError("'" + std::string(text) + "' is " + describe(q.dimension) + "; " + needed +
                    " is needed here, like \"" + std::string(expected.example) + "\"");
  }
  return q.value;
}

std::string shortest(double value) {
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

std::string format_quantity(double value, const Unit& u) {
  return u.symbol.empty() ? shortest(value) : shortest(value) + " " + std::string(u.symbol);
}

}  // namespace puffin::cases
