#pragma once
// The pictures of a run: the device, the carriers in it, a slice through the air, what landed on the walls.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tools/output/frames.hpp"
#include "tools/output/picture/canvas.hpp"

namespace puffin::output {

struct Caption {
  std::string name;            // of the case
  std::optional<double> time;  // [s]
};

/// Places to be pointed at: each as a dot, the name with its number in the legend.
struct PictureMarks {
  std::string name;
  std::size_t count = 0;                  // of what there is; `at` may hold fewer
  std::vector<std::array<double, 3>> at;  // [m]
};

/// Clear walls with every patch in its colour, names, areas, the outer measures and a scale bar; and marks.
Canvas geometry_picture(const WallFrame& walls, const Caption& caption, int width, int height,
                        const std::vector<PictureMarks>& marks = {});

/// Clear walls and the carriers as spheres coloured by speed; `speed_max` [m/s] ends the scale.
Canvas carriers_picture(const WallFrame& walls, const CarrierFrame& carriers, const Caption& caption, double speed_max,
                        int width, int height);

/// Speed of the air on the layer of cells nearest to `at` [m] along `axis` (0 x, 1 y, 2 z), with the walls' outline.
/// Throws std::invalid_argument if the frame has no velocity.
Canvas slice_picture(const FieldFrame& field, const WallFrame& walls, int axis, double at, const Caption& caption,
                     std::optional<double> speed_max, int width, int height);

/// A wall quantity ("fines", "hits" or "energy") on the triangles, from above and from below, logarithmic.
/// Throws std::invalid_argument if the frame has no such array.
Canvas wall_map_picture(const WallFrame& walls, const std::string& quantity, const Caption& caption, int width,
                        int height);

/// The largest speed in a frame [m/s], rounded up for a scale.
double speed_scale(const CarrierFrame& carriers);

}  // namespace puffin::output
