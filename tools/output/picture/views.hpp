#pragma once
// The pictures of a run: the device, the carriers in it, a slice through the air, what landed on the walls.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tools/output/frames.hpp"
#include "tools/output/picture/canvas.hpp"
#include "tools/output/picture/framing.hpp"

namespace puffin::output {

/// Places to be pointed at: each as a dot, the name with its number in the legend.
struct PictureMarks {
  std::string name;
  std::size_t count = 0;                  // of what there is; `at` may hold fewer
  std::vector<std::array<double, 3>> at;  // [m]
};

/// Clear walls with every patch in its colour, names, areas, the outer measures and a scale bar; and marks.
Canvas geometry_picture(const WallFrame& walls, const Caption& caption, const Aim& aim, int width, int height,
                        const std::vector<PictureMarks>& marks = {});

/// Clear walls and the carriers as spheres coloured by speed; `speed_max` [m/s] ends the scale.
Canvas carriers_picture(const WallFrame& walls, const CarrierFrame& carriers, const Caption& caption, double speed_max,
                        const Aim& aim, int width, int height);

/// A quantity of the air (one of `slice_quantities`) on the layer of cells nearest to `at` [m] along `axis` (0 x, 1 y,
/// 2 z), with the walls' outline. Fines are logarithmic. `maximum` ends the scale, in the quantity's own unit.
/// Throws std::invalid_argument if the frame has no such array.
Canvas slice_picture(const FieldFrame& field, const WallFrame& walls, const std::string& quantity, int axis, double at,
                     const Caption& caption, std::optional<double> maximum, int width, int height);

/// Those that a frame holds: speed, pressure, fines (of the first scalar), fines_NAME.
std::vector<std::string> slice_quantities(const FieldFrame& field);

/// Clear walls and streamlines of the air coloured by speed, evenly spread on the picture.
/// Throws std::invalid_argument if the frame has no velocity, or there is no patch to close up on.
Canvas streamlines_picture(const FieldFrame& field, const WallFrame& walls, const Caption& caption,
                           std::optional<double> speed_max, const Aim& aim, int width, int height);

/// A wall quantity (one of `wall_quantities`) on the triangles, logarithmic: from above and from below, or as `aim`
/// says. Throws std::invalid_argument if the frame has no such array.
Canvas wall_map_picture(const WallFrame& walls, const std::string& quantity, const Caption& caption, const Aim& aim,
                        int width, int height);

/// Those that a frame holds: fines (of the first scalar), fines_NAME of a further one, hits, energy.
std::vector<std::string> wall_quantities(const WallFrame& walls);

/// The largest speed in a frame [m/s], rounded up for a scale.
double speed_scale(const CarrierFrame& carriers);
/// The speed that 99.9 % of the cells stay below, rounded up: a few cells at an edge do not darken the rest.
double speed_scale(const FieldFrame& field);

}  // namespace puffin::output
