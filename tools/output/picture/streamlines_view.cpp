// Streamlines of the air in the device, coloured by speed.

#include <algorithm>
#include <cmath>

#include "tools/output/picture/decorations.hpp"
#include "tools/output/picture/streamlines.hpp"
#include "tools/output/picture/views.hpp"

namespace puffin::output {

Canvas streamlines_picture(const FieldFrame& field, const WallFrame& walls, const Caption& caption,
                           std::optional<double> speed_max, const Aim& aim, int width, int height) {
  const Box view = stage(width, height, 150);
  const Camera camera = camera_for(walls, aim, view);
  // Lines some 20 pixels apart on the picture (a close-up looks through many layers of them: 60), but no closer than
  // the cells can tell.
  const double pixels = (aim.focus.empty() ? 20.0 : 60.0) * width / 1600;
  const std::vector<Streamline> lines = even_streamlines(field, std::max(1.5 * field.dx, pixels / camera.scale));
  const ColourScale scale{0.0, speed_max.value_or(speed_scale(field)), false};
  Scene scene;
  add_glass(walls, 0.05f, scene);
  for (const Streamline& line : lines)
    for (std::size_t n = 1; n < line.size(); ++n)
      scene.edges.push_back(
          {line[n - 1].place, line[n].place, scale.colour(0.5 * (line[n - 1].speed + line[n].speed)), 2.0f, 0.999f});
  Canvas canvas(width, height);
  paint(scene, camera, view, canvas);
  draw_title(canvas, aim.focus.empty() ? "Streamlines" : "Streamlines at the " + aim.focus,
             subtitle(caption, lines.empty() ? "the air rests" : ""));
  draw_colour_bar(canvas, colour_bar_place(width, height), scale, "speed of the air [m/s]");
  draw_scale_bar(canvas, 60, height - 45, camera.scale);
  return canvas;
}

double speed_scale(const FieldFrame& field) {
  std::vector<float> speeds;
  for (std::size_t n = 0; n < field.fluid.size() && 3 * n + 2 < field.velocity.size(); ++n)
    if (field.fluid[n]) {
      const float speed = speed_of({field.velocity[3 * n], field.velocity[3 * n + 1], field.velocity[3 * n + 2]});
      if (std::isfinite(speed)) speeds.push_back(speed);  // of a run that diverged
    }
  if (speeds.empty()) return 1.0;
  const auto nearly_all = speeds.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), nearly_all, speeds.end());
  return scale_end(*nearly_all);
}

}  // namespace puffin::output
