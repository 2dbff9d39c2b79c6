#include "tools/output/picture/framing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace puffin::output {
namespace {

/// The patch with half its size around it, and as much above it as the air there needs to be seen, inside the device.
Extent around(const WallFrame& walls, const std::string& patch) {
  const Extent whole = extent_of(walls);
  Extent close{whole.high, whole.low};
  bool found = false;
  std::string names;
  for (const auto& p : walls.patches) names += (names.empty() ? "" : ", ") + p.name;
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    if (walls.patches[walls.patch[t]].name != patch) continue;
    found = true;
    for (const int corner : walls.triangles[t]) {
      close.low = close.low.cwiseMin(point_of(walls.vertices[corner]));
      close.high = close.high.cwiseMax(point_of(walls.vertices[corner]));
    }
  }
  if (!found) throw std::invalid_argument("there is no patch '" + patch + "' to close up on; there are " + names);
  const double margin = 0.8 * (close.high - close.low).maxCoeff();
  close.low = (close.low - Vec3::Constant(margin)).cwiseMax(whole.low);
  close.high = (close.high + Vec3::Constant(margin)).cwiseMin(whole.high);
  return close;
}

}  // namespace

double elevation_for(const Extent& extent, const Box& view) {
  const auto scale = [&](double elevation) {
    return Camera::looking(usual_azimuth, elevation, extent.low, extent.high, view).scale;
  };
  double best = 30;
  for (double elevation = 30; elevation <= 50; elevation += 2) {
    if (scale(elevation) > 0.97 * scale(30)) best = elevation;
  }
  return best;
}

Camera camera_for(const WallFrame& walls, const Aim& aim, const Box& view) {
  const Extent extent = aim.focus.empty() ? extent_of(walls) : around(walls, aim.focus);
  return Camera::looking(aim.azimuth.value_or(usual_azimuth), aim.elevation.value_or(elevation_for(extent, view)),
                         extent.low, extent.high, view);
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string subtitle(const Caption& caption, const std::string& more) {
  std::string text = caption.name;
  if (caption.time) text += (text.empty() ? "" : "   ") + formatted("t = %.1f ms", *caption.time * 1e3);
  if (!more.empty()) text += (text.empty() ? "" : "   ") + more;
  return text;
}

Box stage(int width, int height, double right_column) {
  return {50, 130, width - 100 - right_column, height - 130 - 90.0};
}

Box colour_bar_place(int width, int height) { return {width - 120.0, 150, 28, height - 270.0}; }

void add_glass(const WallFrame& walls, float wall_opacity, Scene& scene) {
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    const auto& [a, b, c] = walls.triangles[t];
    if (walls.patches[walls.patch[t]].opening) continue;
    scene.triangles.push_back(
        {point_of(walls.vertices[a]), point_of(walls.vertices[b]), point_of(walls.vertices[c]), glass, wall_opacity});
  }
  for (const auto& edge : outline_of(walls, soft_ink, 1.6f, 0.75f)) scene.edges.push_back(edge);
}

float speed_of(const std::array<float, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace puffin::output
