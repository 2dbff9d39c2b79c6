#pragma once
// Pictures of a run from its own files (vtk/*.pvd), painted on the processor: no display, no graphics driver.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/output/output_error.hpp"
#include "tools/output/picture/framing.hpp"

namespace puffin::output {

/// What is asked for is not among what the run holds. The text names what it holds; the program ends with exit code 2.
class NotStored : public OutputError {
 public:
  using OutputError::OutputError;
};

enum class View { geometry, carriers, slice, streamlines, wall_map };

/// "geometry", "carriers", "slice", "streamlines", "wall-map". Throws std::invalid_argument naming the views.
View parse_view(const std::string& name);
const char* name_of(View view);

struct RenderOptions {
  int width = 1600, height = 1000;  // [pixel]
  Aim aim;                          // where the eye stands; not of the slice
  std::optional<int> slice_axis;    // 0, 1, 2: the normal is x, y, z; absent: across the thinnest extent
  std::optional<double> slice_at;   // position along the normal [m]; absent: the middle
  std::string quantity;  // slice: speed, pressure, fines, fines_NAME; wall map: fines, fines_NAME, hits, energy; "":
                         // the first that is named here
  std::optional<double> value_max;  // upper end of the colour scale in the quantity's unit; absent: from the frame
};

/// Paints one view at the stored moment nearest to `time` [s] (absent: the last) and writes a PNG.
/// Streamlines need a stored region "all" or a box: of the first one of those. Slices take the first region with the
/// quantity and the plane. Throws OutputError if the run has no such data or the picture cannot be written, NotStored
/// if it has others: another quantity, or a plane elsewhere.
void render(const std::filesystem::path& run, View view, std::optional<double> time, const std::filesystem::path& png,
            const RenderOptions& options = RenderOptions());

/// The stored moments [s] that a view can show, in order; of slices and streamlines those with velocities.
std::vector<double> moments_of(const std::filesystem::path& run, View view);

/// Whether the run holds what the view needs.
bool can_render(const std::filesystem::path& run, View view);

}  // namespace puffin::output
