#include "cases/dose_stack.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <stdexcept>

namespace puffin::cases {
namespace {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

std::string in_units(double value, double unit, const char* name) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4g %s", value / unit, name);
  return text;
}

/// From the middle outwards; equal distances by angle, so that the order is the same everywhere.
void sort_outwards(std::vector<Vec2>& sites) {
  std::sort(sites.begin(), sites.end(), [](const Vec2& a, const Vec2& b) {
    const double ra = a.squaredNorm(), rb = b.squaredNorm();
    if (std::abs(ra - rb) > 1e-9 * (ra + rb)) return ra < rb;
    return std::pair(a.y(), a.x()) < std::pair(b.y(), b.x());
  });
}

/// Sites of a square lattice within `radius`; offset 0: one in the middle, 0.5: four around it.
std::vector<Vec2> disc(double radius, double pitch, double offset) {
  std::vector<Vec2> sites;
  const int n = static_cast<int>(radius / pitch) + 1;
  for (int j = -n; j <= n; ++j)
    for (int i = -n; i <= n; ++i) {
      const Vec2 site = pitch * Vec2(i + offset, j + offset);
      if (site.norm() <= radius) sites.push_back(site);
    }
  return sites;
}

}  // namespace

Stack cylinder_stack(const DoseSpec& spec) {
  const double d = parcel_diameter(spec.diameter, spec.parcel), pitch = (1.0 + spec.gap) * d;
  Stack stack;
  stack.free_play = 0.5 * spec.gap * d;
  const double offset = std::min(spec.jitter * d, stack.free_play);
  const double reach = 0.5 * spec.floor_diameter - 0.5 * d - std::numbers::sqrt2 * offset;
  std::vector<Vec2> layer;
  if (reach >= 0.0) layer = disc(reach, pitch, 0.0);
  if (std::vector<Vec2> other = reach >= 0.0 ? disc(reach, pitch, 0.5) : layer; other.size() > layer.size())
    layer = std::move(other);
  if (layer.empty())
    throw std::invalid_argument("a sphere of " + in_units(d, 1e-6, "um") + " has no room on a floor of " +
                                in_units(spec.floor_diameter, 1e-3, "mm") + " diameter");
  sort_outwards(layer);
  const std::int64_t count = spec.carriers / spec.parcel;
  for (std::int64_t placed = 0; placed < count; ++placed) {
    const std::size_t site = static_cast<std::size_t>(placed) % layer.size();
    if (site == 0) ++stack.layers;
    stack.sites.push_back(spec.floor +
                          spec.axes * Vec3(layer[site].x(), layer[site].y(), 0.5 * pitch + (stack.layers - 1) * pitch));
  }
  stack.volume = 0.25 * std::numbers::pi * spec.floor_diameter * spec.floor_diameter * stack.layers * pitch;
  stack.shape = "cylinder of " + in_units(spec.floor_diameter, 1e-3, "mm") + ", " + std::to_string(stack.layers) +
                (stack.layers == 1 ? " layer of up to " : " layers of ") + std::to_string(layer.size());
  return stack;
}

Stack cube_stack(const DoseSpec& spec) {
  const double d = parcel_diameter(spec.diameter, spec.parcel);
  const std::int64_t count = spec.carriers / spec.parcel;
  const auto box = nearest_box(count);
  std::array<double, 3> pitch{};
  pitch.fill((1.0 + spec.gap) * d);
  double floor_gap = 0.5 * spec.gap * d;
  if (spec.extent_of) {
    const auto [carriers, parcel] = *spec.extent_of;
    const auto reference = nearest_box(carriers / parcel);
    const double reference_d = parcel_diameter(spec.diameter, parcel);
    floor_gap = 0.5 * spec.gap * reference_d;
    for (int axis = 0; axis < 3; ++axis)
      if (box[axis] > 1)
        pitch[axis] = (1.0 + spec.gap) * reference_d * static_cast<double>(reference[axis] - 1) /
                      static_cast<double>(box[axis] - 1);
  }
  Stack stack;
  stack.free_play = floor_gap;
  for (int axis = 0; axis < 3; ++axis)
    if (box[axis] > 1) stack.free_play = std::min(stack.free_play, 0.5 * (pitch[axis] - d));
  if (stack.free_play < -1e-12 * d)
    throw std::invalid_argument("extent_of makes " + std::to_string(count) + " spheres of " + in_units(d, 1e-6, "um") +
                                " overlap; take the extent of more carriers, or fewer and larger parcels");
  stack.free_play = std::max(0.0, stack.free_play);
  std::vector<Vec2> layer;
  for (std::int64_t j = 0; j < box[1]; ++j)
    for (std::int64_t i = 0; i < box[0]; ++i)
      layer.emplace_back((static_cast<double>(i) - 0.5 * static_cast<double>(box[0] - 1)) * pitch[0],
                         (static_cast<double>(j) - 0.5 * static_cast<double>(box[1] - 1)) * pitch[1]);
  sort_outwards(layer);
  for (std::int64_t placed = 0; placed < count; ++placed) {
    const std::size_t site = static_cast<std::size_t>(placed) % layer.size();
    if (site == 0) ++stack.layers;
    const double height = floor_gap + 0.5 * d + (stack.layers - 1) * pitch[2];
    stack.sites.push_back(spec.floor + spec.axes * Vec3(layer[site].x(), layer[site].y(), height));
  }
  stack.volume = 1.0;
  for (int axis = 0; axis < 3; ++axis) stack.volume *= static_cast<double>(box[axis]) * pitch[axis];
  stack.shape = std::to_string(box[0]) + " x " + std::to_string(box[1]) + " x " + std::to_string(box[2]) + " box";
  return stack;
}

}  // namespace puffin::cases
