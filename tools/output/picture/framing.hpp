#pragma once
// Where the eye stands and what a picture of the device has around it: shared by all views.

#include <optional>
#include <string>

#include "tools/output/frames.hpp"
#include "tools/output/picture/scene.hpp"
#include "tools/output/picture/wall_shape.hpp"

namespace puffin::output {

struct Caption {
  std::string name;            // of the case
  std::optional<double> time;  // [s]
};

/// Where the eye stands. Absent angles: from the front, right and above, as high as shows the device largest.
struct Aim {
  std::optional<double> azimuth, elevation;  // [degree], from the x axis towards y, and upwards
  std::string focus;                         // a patch: the picture closes up on it; "" the whole device
};

/// A picture's own numbers as text: formatted("%.1f ms", t).
std::string formatted(const char* format, double value);
/// Name, moment and more, for the line below the title.
std::string subtitle(const Caption& caption, const std::string& more = {});

/// The part of the picture that the scene may use, with room for the title above and a column at the right.
Box stage(int width, int height, double right_column);
Box colour_bar_place(int width, int height);

/// The camera for a device. Throws std::invalid_argument if there is no patch `focus`.
Camera camera_for(const WallFrame& walls, const Aim& aim, const Box& view);
/// The steepest view from above that still shows the device as large as the flattest one does: slender devices are seen
/// better from higher up.
double elevation_for(const Extent& extent, const Box& view);
constexpr double usual_azimuth = -62;  // [degree] from the front; x runs to the right

/// Clear walls without the openings, and the creases.
void add_glass(const WallFrame& walls, float wall_opacity, Scene& scene);

float speed_of(const std::array<float, 3>& v);

}  // namespace puffin::output
