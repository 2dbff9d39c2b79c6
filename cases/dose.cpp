#include "cases/dose.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "cases/dose_stack.hpp"

namespace puffin::cases {
namespace {

using Vec3 = Eigen::Vector3d;

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

void check(const DoseSpec& s) {
  const auto refuse = [](const std::string& why) { throw std::invalid_argument("dose: " + why); };
  if (s.parcel < 1) refuse("a parcel holds at least 1 carrier, not " + std::to_string(s.parcel));
  if (s.carriers < 1) refuse("the number of carriers is " + std::to_string(s.carriers) + "; it must be at least 1");
  if (s.carriers % s.parcel != 0)
    refuse(std::to_string(s.carriers) + " carriers are no whole number of parcels of " + std::to_string(s.parcel));
  if (!(s.diameter > 0.0 && std::isfinite(s.diameter))) refuse("the diameter must be greater than 0");
  if (!(s.density > 0.0 && std::isfinite(s.density))) refuse("the density must be greater than 0");
  if (!(s.gap >= 0.0 && std::isfinite(s.gap))) refuse("the gap must not be negative: spheres would overlap");
  if (!(s.jitter >= 0.0 && std::isfinite(s.jitter))) refuse("the jitter must not be negative");
  if (!s.sizes.empty() && static_cast<std::int64_t>(s.sizes.size()) != s.carriers / s.parcel)
    refuse(std::to_string(s.sizes.size()) + " sizes for " + std::to_string(s.carriers / s.parcel) + " parcels");
  for (const double size : s.sizes)
    if (!(size > 0.0) || size > s.diameter * (1.0 + 1e-9)) refuse("a size must lie between 0 and the largest diameter");
  if (!s.floor.allFinite()) refuse("the floor's centre must be finite");
  if (s.shape == DoseShape::cylinder && !(s.floor_diameter > 0.0 && std::isfinite(s.floor_diameter)))
    refuse("a cylinder needs a floor with a diameter greater than 0");
  if (s.extent_of) {
    const auto [carriers, parcel] = *s.extent_of;
    if (s.shape != DoseShape::cube) refuse("extent_of goes with shape = cube");
    if (carriers < 1 || parcel < 1 || carriers % parcel != 0)
      refuse("extent_of must be [carriers, parcel], both at least 1 and the first a multiple of the second");
  }
}

/// Offsets each site by up to `amplitude` along each axis. The mapping is our own: the standard leaves that of
/// std::uniform_real_distribution to the library.
void jitter(double amplitude, std::uint64_t seed, const Eigen::Matrix3d& axes, std::vector<Vec3>& sites) {
  std::mt19937_64 generator(seed);
  const auto draw = [&generator] { return std::ldexp(static_cast<double>(generator() >> 11), -52) - 1.0; };
  for (Vec3& site : sites) {
    Vec3 offset;
    for (int axis = 0; axis < 3; ++axis) offset[axis] = amplitude * draw();
    site += axes * offset;
  }
}

/// The numbers of a comma-separated row; empty if a field is no finite number.
std::vector<double> numbers_of(const std::string& row) {
  std::vector<double> numbers;
  std::istringstream fields(row);
  for (std::string field; std::getline(fields, field, ',');) {
    const std::size_t first = field.find_first_not_of(" \t\r"), last = field.find_last_not_of(" \t\r");
    if (first == std::string::npos) return {};
    double number = 0.0;
    const char* const end = field.data() + last + 1;
    const auto [stop, error] = std::from_chars(field.data() + first, end, number);
    if (error != std::errc{} || stop != end || !std::isfinite(number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

/// Rows x, y, z[, diameter]; empty lines, lines that begin with '#' and one header line are skipped.
void read_file(const DoseSpec& spec, double default_diameter, Dose& dose) {
  std::error_code error;
  const bool regular = std::filesystem::is_regular_file(spec.file, error);  // a pipe would be waited for
  std::ifstream in(regular ? spec.file : std::string());
  if (!in || !regular) throw std::invalid_argument("dose: cannot read " + spec.file + " as a table of positions");
  std::string line;
  bool header_allowed = true;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const bool may_be_header = std::exchange(header_allowed, false);
    if (may_be_header && std::isalpha(static_cast<unsigned char>(line[first])) != 0) continue;
    const std::vector<double> row = numbers_of(line);
    if (row.size() < 3 || row.size() > 4 || (row.size() == 4 && row[3] <= 0.0))
      throw std::invalid_argument("dose: " + spec.file + ":" + std::to_string(number) +
                                  ": expected x,y,z or x,y,z,diameter, numbers in metres");
    dose.positions.emplace_back(row[0], row[1], row[2]);
    const std::size_t at = dose.radius.size();
    const double drawn = at < spec.sizes.size() ? parcel_diameter(spec.sizes[at], spec.parcel) : default_diameter;
    dose.radius.push_back(0.5 * (row.size() == 4 ? row[3] : drawn));
  }
  const auto expected = static_cast<std::size_t>(spec.carriers / spec.parcel);
  if (dose.positions.size() != expected)
    throw std::invalid_argument("dose: " + spec.file + " has " + std::to_string(dose.positions.size()) +
                                " positions, but carriers over parcel is " + std::to_string(expected));
}

void require_in_fluid(const DoseSpec& spec, const Dose& dose, const std::function<bool(const Vec3&)>& inside,
                      const std::function<double(const Vec3&)>& clearance) {
  std::size_t misfits = 0;
  Vec3 first = Vec3::Zero();
  for (std::size_t i = 0; i < dose.positions.size(); ++i) {
    const Vec3& p = dose.positions[i];
    if (inside(p) && clearance(p) >= dose.radius[i] * (1.0 - 1e-9)) continue;
    if (misfits++ == 0) first = p;
  }
  if (misfits == 0) return;
  throw std::invalid_argument("dose: " + std::to_string(misfits) + " of " + std::to_string(dose.positions.size()) +
                              " spheres are not wholly in the fluid, the first at (" + text("%.4g", first.x() * 1e3) +
                              ", " + text("%.4g", first.y() * 1e3) + ", " + text("%.4g", first.z() * 1e3) + ") mm; " +
                              (spec.shape == DoseShape::file
                                   ? "check " + spec.file + " and its unit (metres)"
                                   : "the stack is " + text("%.3g", dose.height * 1e3) +
                                         " mm high: use fewer carriers, a smaller gap, or another place ('at')"));
}

}  // namespace

double parcel_diameter(double carrier_diameter, std::int64_t parcel) {
  return carrier_diameter * std::cbrt(static_cast<double>(parcel));
}

Eigen::Matrix3d axes_on_floor(const Vec3& up) {
  const Vec3 z = up.normalized(), near = std::abs(z.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 x = (near - near.dot(z) * z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

std::array<std::int64_t, 3> nearest_box(std::int64_t count) {
  const auto side = static_cast<std::int64_t>(std::ceil(std::cbrt(static_cast<double>(count)) - 1e-9));
  std::array<std::int64_t, 3> exact{}, holding{side, side, side};
  for (std::int64_t z = 1; z <= side; ++z)
    for (std::int64_t y = z; 2 * y <= 3 * z; ++y) {
      const std::int64_t x = std::max(y, (count + y * z - 1) / (y * z));  // the shortest that holds them
      if (2 * x > 3 * z) continue;
      if (x * y * z == count && (exact[0] == 0 || x * exact[2] < exact[0] * z)) exact = {x, y, z};
      if (x * y * z < holding[0] * holding[1] * holding[2]) holding = {x, y, z};
    }
  return exact[0] != 0 ? exact : holding;
}

Dose place_dose(const DoseSpec& spec, const std::function<bool(const Vec3&)>& inside,
                const std::function<double(const Vec3&)>& clearance) {
  check(spec);
  const double d = parcel_diameter(spec.diameter, spec.parcel);
  Dose dose;
  std::string shape = "positions from " + spec.file;
  if (spec.shape == DoseShape::file) {
    read_file(spec, d, dose);
  } else {
    Stack stack = spec.shape == DoseShape::cylinder ? cylinder_stack(spec) : cube_stack(spec);
    jitter(std::min(spec.jitter * d, stack.free_play), spec.seed, spec.axes, stack.sites);
    dose.positions = std::move(stack.sites);
    dose.radius.assign(dose.positions.size(), 0.5 * d);
    for (std::size_t i = 0; i < spec.sizes.size(); ++i)
      dose.radius[i] = 0.5 * parcel_diameter(spec.sizes[i], spec.parcel);
    dose.layers = stack.layers;
    double cubes = 0.0;  // of the parcels' diameters
    for (const double r : dose.radius) cubes += 8.0 * r * r * r;
    dose.bulk_density = spec.density * std::numbers::pi / 6.0 * cubes / stack.volume;
    shape = stack.shape;
  }
  const Vec3 up = spec.axes.col(2);
  double bottom = dose.layers > 0 ? up.dot(spec.floor) : std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < dose.positions.size(); ++i) {
    if (dose.layers == 0) bottom = std::min(bottom, up.dot(dose.positions[i]) - dose.radius[i]);
    top = std::max(top, up.dot(dose.positions[i]) + dose.radius[i]);
  }
  dose.height = top - bottom;
  require_in_fluid(spec, dose, inside, clearance);
  dose.description = std::to_string(dose.positions.size()) +
                     (spec.parcel > 1 ? " parcels of " + std::to_string(spec.parcel) + " carriers, " : " carriers, ") +
                     (spec.sizes.empty() ? text("%.4g um each: ", d * 1e6) : text("up to %.4g um: ", d * 1e6)) + shape +
                     text(", %.3g mm high", dose.height * 1e3) +
                     (dose.layers > 0 ? text(", bulk density %.0f kg/m^3", dose.bulk_density) : "");
  return dose;
}

}  // namespace puffin::cases
