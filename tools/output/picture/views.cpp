#include "tools/output/picture/views.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tools/output/picture/decorations.hpp"
#include "tools/output/picture/scene.hpp"
#include "tools/output/picture/wall_shape.hpp"

namespace puffin::output {
namespace {

/// The name on the patch, or above it with a line to it if the patch is too small on the picture.
void draw_patch_name(const WallFrame& walls, int patch, const Camera& camera, const Vec3& middle, Canvas& canvas) {
  double left = 1e9, right = -1e9, top = 1e9;
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    if (walls.patch[t] != patch) continue;
    for (const int corner : walls.triangles[t]) {
      const Vec3 p = camera.project(point_of(walls.vertices[corner]));
      left = std::min(left, p.x()), right = std::max(right, p.x()), top = std::min(top, p.y());
    }
  }
  const std::string& name = walls.patches[patch].name;
  double y = middle.y();
  if (right - left < 15.0 * static_cast<double>(name.size()) + 30) {
    y = std::max(top - 70, 150.0);
    canvas.line(middle.x(), middle.y(), middle.x(), y + 18, soft_ink, 1.5);
  }
  canvas.text(std::max(middle.x(), 60.0), y, name, {.size = 25, .bold = true, .align = Align::centre, .halo = true});
}

/// The walls as `aim` says; without it from above and from below, the two views side by side or one above the other,
/// whichever shows them larger. Returns the scale [pixel/m].
double paint_walls(const Scene& scene, const WallFrame& walls, const Aim& aim, const Box& whole, Canvas& canvas) {
  if (aim.azimuth || aim.elevation || !aim.focus.empty()) {
    const Camera camera = camera_for(walls, aim, whole);
    paint(scene, camera, whole, canvas);
    return camera.scale;
  }
  const Extent extent = extent_of(walls);
  Box first = whole, second = whole;
  first.height = second.height = 0.5 * whole.height - 10, second.y += 0.5 * whole.height + 10;
  Box left = whole, right = whole;
  left.width = right.width = 0.5 * whole.width - 10, right.x += 0.5 * whole.width + 10;
  if (camera_for(walls, {}, left).scale > camera_for(walls, {}, first).scale) first = left, second = right;
  const double elevation = elevation_for(extent, first);
  const Camera above = camera_for(walls, {}, first), below = camera_for(walls, {{}, -elevation, {}}, second);
  paint(scene, above, first, canvas);
  paint(scene, below, second, canvas);
  const auto label = [&](const Camera& camera, const Box& box, const char* text) {
    double top = box.y + box.height;  // of the drawing
    for (const auto& vertex : walls.vertices) top = std::min(top, camera.project(point_of(vertex)).y());
    canvas.text(box.x + 0.5 * box.width, std::max(top - 30, box.y + 10), text,
                {.size = 22, .colour = soft_ink, .align = Align::centre});
  };
  label(above, first, "from above");
  label(below, second, "from below");
  return above.scale;
}

}  // namespace

double speed_scale(const CarrierFrame& carriers) {
  float fastest = 0;
  for (const auto& v : carriers.velocity) fastest = std::max(fastest, speed_of(v));
  return scale_end(fastest);
}

Canvas geometry_picture(const WallFrame& walls, const Caption& caption, const Aim& aim, int width, int height,
                        const std::vector<PictureMarks>& marks) {
  Canvas canvas(width, height);
  const Extent extent = extent_of(walls);
  const std::vector<PatchMeasure> measures = measures_of(walls);
  std::vector<Colour> colours;
  std::vector<LegendItem> legend;
  int next = 0;
  for (std::size_t p = 0; p < walls.patches.size(); ++p) {
    colours.push_back(walls.patches[p].name == "wall" ? glass : distinct(next++));
    legend.push_back({colours[p], walls.patches[p].name,
                      formatted("%.2f mm^2", measures[p].area * 1e6) + (walls.patches[p].opening ? ", opening" : "")});
  }
  Scene scene;
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    const auto& [a, b, c] = walls.triangles[t];
    const bool plain = walls.patches[walls.patch[t]].name == "wall";
    scene.triangles.push_back({point_of(walls.vertices[a]), point_of(walls.vertices[b]), point_of(walls.vertices[c]),
                               colours[walls.patch[t]], plain ? 0.13f : 0.55f});
  }
  scene.edges = outline_of(walls, ink, 1.8f, 0.8f);
  scene.smallest_radius = 6.0;
  for (const PictureMarks& m : marks) {
    const Colour colour = distinct(next++);
    legend.push_back({colour, m.name, std::to_string(m.count)});
    for (const auto& at : m.at) scene.spheres.push_back({point_of(at), 0.0, colour});
  }
  const Box view = stage(width, height, 300);
  const Camera camera = camera_for(walls, aim, view);
  paint(scene, camera, view, canvas);

  const Vec3 size = (extent.high - extent.low) * 1e3;
  draw_title(canvas, "Geometry",
             subtitle(caption, formatted("%.2f x ", size.x()) + formatted("%.2f x ", size.y()) +
                                   formatted("%.2f mm,  volume ", size.z()) +
                                   formatted("%.1f mm^3,  ", volume_of(walls) * 1e9) +
                                   std::to_string(walls.triangles.size()) + " triangles"));
  for (std::size_t p = 0; p < walls.patches.size(); ++p) {
    if (walls.patches[p].name == "wall" || measures[p].area <= 0) continue;
    draw_patch_name(walls, static_cast<int>(p), camera, camera.project(measures[p].middle), canvas);
  }
  draw_legend(canvas, width - 300, 170, legend);
  draw_scale_bar(canvas, 60, height - 45, camera.scale);
  return canvas;
}

Canvas carriers_picture(const WallFrame& walls, const CarrierFrame& carriers, const Caption& caption, double speed_max,
                        const Aim& aim, int width, int height) {
  Canvas canvas(width, height);
  Scene scene;
  scene.smallest_radius = 2.0;
  add_glass(walls, 0.07f, scene);
  const ColourScale scale{0.0, speed_max, false};
  for (std::size_t i = 0; i < carriers.position.size(); ++i) {
    scene.spheres.push_back(
        {point_of(carriers.position[i]), 0.5 * carriers.diameter[i], scale.colour(speed_of(carriers.velocity[i]))});
  }
  const Box view = stage(width, height, 150);
  const Camera camera = camera_for(walls, aim, view);
  paint(scene, camera, view, canvas);
  draw_title(canvas, "Carriers",
             subtitle(caption, std::to_string(carriers.position.size()) + " tracked bodies in the device"));
  draw_colour_bar(canvas, colour_bar_place(width, height), scale, "speed of the carriers [m/s]");
  draw_scale_bar(canvas, 60, height - 45, camera.scale);
  return canvas;
}

Canvas slice_picture(const FieldFrame& field, const WallFrame& walls, int axis, double at, const Caption& caption,
                     std::optional<double> speed_max, int width, int height) {
  if (field.velocity.empty()) throw std::invalid_argument("this output holds no velocity");
  const int across = axis == 0 ? 1 : 0, upward = axis == 2 ? 1 : 2;  // axes of the picture
  const int nx = field.size[across], ny = field.size[upward];
  const int layer =
      std::clamp(static_cast<int>(std::lround((at - field.origin[axis]) / field.dx)), 0, field.size[axis] - 1);
  std::vector<float> speed(static_cast<std::size_t>(nx) * ny, -1.0f);  // -1: not fluid
  float fastest = 0;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      std::array<std::int64_t, 3> cell{};
      cell[axis] = layer, cell[across] = i, cell[upward] = j;
      const std::int64_t index = cell[0] + field.size[0] * (cell[1] + field.size[1] * cell[2]);
      if (!field.fluid[index]) continue;
      const float value =
          speed_of({field.velocity[3 * index], field.velocity[3 * index + 1], field.velocity[3 * index + 2]});
      speed[static_cast<std::size_t>(j) * nx + i] = value;
      fastest = std::max(fastest, value);
    }
  }
  Canvas canvas(width, height);
  const ColourScale scale{0.0, speed_max.value_or(scale_end(fastest)), false};
  const Box view = stage(width, height, 150);
  const double zoom = std::min(view.width / (nx * field.dx), view.height / (ny * field.dx));  // [pixel/m]
  const double x0 = view.x + 0.5 * (view.width - zoom * nx * field.dx);
  const double y0 = view.y + 0.5 * (view.height + zoom * ny * field.dx);
  const double low_x = field.origin[across] - 0.5 * field.dx, low_y = field.origin[upward] - 0.5 * field.dx;
  // Smooth between the cells; cells that are not fluid do not count. A pixel belongs to the cell it lies in.
  for (int py = static_cast<int>(y0 - zoom * ny * field.dx); py < y0; ++py) {
    for (int px = static_cast<int>(x0); px < x0 + zoom * nx * field.dx; ++px) {
      const double u = (px + 0.5 - x0) / (zoom * field.dx), v = (y0 - py - 0.5) / (zoom * field.dx);  // in cells
      const int ci = static_cast<int>(std::floor(u)), cj = static_cast<int>(std::floor(v));
      if (ci < 0 || cj < 0 || ci >= nx || cj >= ny || speed[static_cast<std::size_t>(cj) * nx + ci] < 0) continue;
      const int i = static_cast<int>(std::floor(u - 0.5)), j = static_cast<int>(std::floor(v - 0.5));
      double sum = 0, weights = 0;
      for (int corner = 0; corner < 4; ++corner) {
        const int a = i + (corner & 1), b = j + (corner >> 1);
        if (a < 0 || b < 0 || a >= nx || b >= ny || speed[static_cast<std::size_t>(b) * nx + a] < 0) continue;
        const double weight = (1 - std::abs(u - 0.5 - a)) * (1 - std::abs(v - 0.5 - b));
        sum += weight * speed[static_cast<std::size_t>(b) * nx + a];
        weights += weight;
      }
      if (weights > 0) canvas.blend(px, py, scale.colour(sum / weights), 1.0f);
    }
  }
  const double place = field.origin[axis] + layer * field.dx;
  std::vector<Canvas::Segment> outline;
  for (const auto& [a, b] : cut_of(walls, axis, place)) {
    outline.push_back({x0 + zoom * (a[across] - low_x), y0 - zoom * (a[upward] - low_y),
                       x0 + zoom * (b[across] - low_x), y0 - zoom * (b[upward] - low_y)});
  }
  canvas.stroke(outline, ink, 2.0);
  const std::string plane = std::string(1, "xyz"[axis]) + formatted(" = %.3g mm", place * 1e3);
  draw_title(canvas, "Speed of the air at " + plane, subtitle(caption));
  draw_colour_bar(canvas, colour_bar_place(width, height), scale, "speed of the air [m/s]");
  draw_scale_bar(canvas, 60, height - 45, zoom);
  return canvas;
}

Canvas wall_map_picture(const WallFrame& walls, const std::string& quantity, const Caption& caption, const Aim& aim,
                        int width, int height) {
  const bool hits = quantity == "hits", energy = quantity == "energy";
  if (!hits && !energy && quantity != "fines")
    throw std::invalid_argument("no wall quantity '" + quantity + "'; there are fines, hits and energy");
  const std::vector<double>& values = hits ? walls.hits : energy ? walls.energy : walls.fines;
  if (values.empty()) throw std::invalid_argument("this wall map holds no " + quantity);
  // Hits and energies are sums of a triangle; over its area they can be compared between small and large ones.
  std::vector<double> per_area(values.size());
  double largest = 0;
  for (std::size_t t = 0; t < values.size(); ++t) {
    const auto& [a, b, c] = walls.triangles[t];
    const Vec3 p = point_of(walls.vertices[a]), q = point_of(walls.vertices[b]), r = point_of(walls.vertices[c]);
    const double area = 0.5 * (q - p).cross(r - p).norm();
    per_area[t] = quantity == "fines" ? values[t] : area > 0 ? values[t] / area : 0.0;
    largest = std::max(largest, per_area[t]);
  }
  const double highest = largest > 0 ? std::pow(10.0, std::ceil(std::log10(largest) - 1e-9)) : 1.0;
  const ColourScale scale{highest * 1e-4, highest, true};
  Scene scene;
  for (std::size_t t = 0; t < values.size(); ++t) {
    const auto& [a, b, c] = walls.triangles[t];
    const bool opening = walls.patches[walls.patch[t]].opening;
    const Colour colour = per_area[t] > 0 ? scale.colour(per_area[t]) : Colour{0.86f, 0.87f, 0.88f};
    scene.triangles.push_back({point_of(walls.vertices[a]), point_of(walls.vertices[b]), point_of(walls.vertices[c]),
                               opening ? glass : colour, opening ? 0.15f : 1.0f});
  }
  scene.edges = outline_of(walls, ink, 1.4f, 0.6f);
  Canvas canvas(width, height);
  const Box whole = stage(width, height, 170);
  const double pixels_a_metre = paint_walls(scene, walls, aim, whole, canvas);
  const std::string title = hits     ? "Impacts of carriers on the walls"
                            : energy ? "Energy of the impacts on the walls"
                                     : "Fines on the walls";
  const std::string unit = hits     ? "impacts per area [1/m^2]"
                           : energy ? "energy per area [J/m^2]"
                                    : "fines per area [1/m^2]";
  draw_title(canvas, title, subtitle(caption, "grey: none"));
  draw_colour_bar(canvas, colour_bar_place(width, height), scale, unit);
  draw_scale_bar(canvas, 60, height - 45, pixels_a_metre);
  return canvas;
}

}  // namespace puffin::output
