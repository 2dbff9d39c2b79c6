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

const std::vector<double>& values_of(const WallFrame& walls, const std::string& quantity) {
  if (quantity == "fines" && !walls.fines.empty()) return walls.fines;
  if (quantity == "hits" && !walls.hits.empty()) return walls.hits;
  if (quantity == "energy" && !walls.energy.empty()) return walls.energy;
  for (const auto& [name, map] : walls.further_fines)
    if (quantity == "fines_" + name && !map.empty()) return map;
  throw std::invalid_argument("this wall map holds no " + quantity);
}

}  // namespace

std::vector<std::string> wall_quantities(const WallFrame& walls) {
  std::vector<std::string> names;
  if (!walls.fines.empty()) names.emplace_back("fines");
  for (const auto& [name, map] : walls.further_fines) names.push_back("fines_" + name);
  if (!walls.hits.empty()) names.emplace_back("hits");
  if (!walls.energy.empty()) names.emplace_back("energy");
  return names;
}

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

Canvas wall_map_picture(const WallFrame& walls, const std::string& quantity, const Caption& caption, const Aim& aim,
                        int width, int height) {
  const bool hits = quantity == "hits", energy = quantity == "energy";
  const std::vector<double>& values = values_of(walls, quantity);
  // Hits and energies are sums of a triangle; over its area they can be compared between small and large ones.
  std::vector<double> per_area(values.size());
  double largest = 0;
  for (std::size_t t = 0; t < values.size(); ++t) {
    const auto& [a, b, c] = walls.triangles[t];
    const Vec3 p = point_of(walls.vertices[a]), q = point_of(walls.vertices[b]), r = point_of(walls.vertices[c]);
    const double area = 0.5 * (q - p).cross(r - p).norm();
    per_area[t] = !hits && !energy ? values[t] : area > 0 ? values[t] / area : 0.0;
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
  std::string title = hits     ? "Impacts of carriers on the walls"
                      : energy ? "Energy of the impacts on the walls"
                               : "Fines on the walls";
  if (quantity.starts_with("fines_")) title.append(", ").append(quantity, 6);
  const std::string unit = hits     ? "impacts per area [1/m^2]"
                           : energy ? "energy per area [J/m^2]"
                                    : "fines per area [1/m^2]";
  draw_title(canvas, title, subtitle(caption, "grey: none"));
  draw_colour_bar(canvas, colour_bar_place(width, height), scale, unit);
  draw_scale_bar(canvas, 60, height - 45, pixels_a_metre);
  return canvas;
}

}  // namespace puffin::output
