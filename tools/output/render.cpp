#include "tools/output/render.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/picture/views.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

/// The entries of a series at the stored moment nearest to the wanted one; absent: the last moment.
std::vector<SeriesEntry> nearest(const fs::path& pvd, std::optional<double> time) {
  const std::vector<SeriesEntry> all = read_pvd(pvd);
  if (all.empty()) throw OutputError(pvd.string() + " lists no output yet");
  double best = all.back().time;
  for (const auto& entry : all) {
    if (time && std::abs(entry.time - *time) < std::abs(best - *time)) best = entry.time;
  }
  std::vector<SeriesEntry> chosen;
  for (const auto& entry : all) {
    if (entry.time == best) chosen.push_back(entry);
  }
  return chosen;
}

std::string name_of_run(const fs::path& run) {
  if (fs::exists(run / "summary.json")) return read_summary(run / "summary.json").name;
  if (fs::exists(run / "status.json")) return read_status(run / "status.json").name;
  return {};
}

WallFrame walls_of(const fs::path& run, std::optional<double> time, double* moment = nullptr) {
  const SeriesEntry entry = nearest(run / "vtk/walls.pvd", time).front();
  if (moment) *moment = entry.time;
  return read_wall_frame(run / "vtk" / entry.file);
}

/// The first region of that moment that holds velocities.
FieldFrame field_of(const fs::path& run, std::optional<double> time, double& moment) {
  for (const auto& entry : nearest(run / "vtk/fields.pvd", time)) {
    moment = entry.time;
    FieldFrame frame = read_field_frame(run / "vtk" / entry.file);
    if (!frame.velocity.empty()) return frame;
  }
  throw OutputError(run.string() + " holds fields without velocity; add \"velocity\" to `what` in [output] fields");
}

}  // namespace

View parse_view(const std::string& name) {
  for (const View view : {View::geometry, View::carriers, View::slice, View::wall_map}) {
    if (name == name_of(view)) return view;
  }
  throw std::invalid_argument("there is no view '" + name + "'; choose carriers, wall-map, slice or geometry");
}

const char* name_of(View view) {
  switch (view) {
    case View::geometry:
      return "geometry";
    case View::carriers:
      return "carriers";
    case View::slice:
      return "slice";
    case View::wall_map:
      return "wall-map";
  }
  return "";
}

bool can_render(const fs::path& run, View view) {
  const auto stored = [&](const char* pvd) { return fs::exists(run / pvd) && !read_pvd(run / pvd).empty(); };
  if (!stored("vtk/walls.pvd")) return false;
  if (view == View::carriers) return stored("vtk/carriers.pvd");
  if (view == View::slice) return stored("vtk/fields.pvd");
  return true;
}

void render(const fs::path& run, View view, std::optional<double> time, const fs::path& png,
            const RenderOptions& options) {
  Caption caption{name_of_run(run), {}};
  double moment = 0.0;
  const auto picture = [&]() -> Canvas {
    switch (view) {
      case View::carriers: {
        const SeriesEntry entry = nearest(run / "vtk/carriers.pvd", time).front();
        const CarrierFrame carriers = read_carrier_frame(run / "vtk" / entry.file);
        caption.time = entry.time;
        return carriers_picture(walls_of(run, {}), carriers, caption, options.value_max.value_or(speed_scale(carriers)),
                                options.width, options.height);
      }
      case View::slice: {
        const FieldFrame field = field_of(run, time, moment);
        caption.time = moment;
        const auto thinnest = std::min_element(field.size.begin(), field.size.end()) - field.size.begin();
        const int axis = options.slice_axis.value_or(static_cast<int>(thinnest));
        const double middle = field.origin[axis] + 0.5 * field.dx * (field.size[axis] - 1);
        return slice_picture(field, walls_of(run, {}), axis, options.slice_at.value_or(middle), caption,
                             options.value_max, options.width, options.height);
      }
      case View::wall_map: {
        const WallFrame walls = walls_of(run, time, &moment);
        caption.time = moment;
        return wall_map_picture(walls, options.wall_quantity, caption, options.width, options.height);
      }
      case View::geometry:
        break;
    }
    return geometry_picture(walls_of(run, {}), caption, options.width, options.height);
  };
  try {
    write_whole(png, picture().png());
  } catch (const std::invalid_argument& error) {
    throw OutputError(run.string() + ": " + error.what());
  }
}

}  // namespace puffin::output
