#include "tools/output/render.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/picture/views.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

/// The entry nearest to the wanted moment; absent: the last one. There must be one.
const SeriesEntry& nearest(const std::vector<SeriesEntry>& entries, std::optional<double> time) {
  if (!time) return entries.back();
  return *std::min_element(entries.begin(), entries.end(), [&](const SeriesEntry& a, const SeriesEntry& b) {
    return std::abs(a.time - *time) < std::abs(b.time - *time);
  });
}

SeriesEntry nearest(const fs::path& pvd, std::optional<double> time) {
  const std::vector<SeriesEntry> entries = read_pvd(pvd);
  if (entries.empty()) throw OutputError(pvd.string() + " lists no output yet");
  return nearest(entries, time);
}

std::string name_of_run(const fs::path& run) {
  if (fs::exists(run / "summary.json")) return read_summary(run / "summary.json").name;
  if (fs::exists(run / "status.json")) return read_status(run / "status.json").name;
  return {};
}

WallFrame walls_of(const fs::path& run, std::optional<double> time, double* moment = nullptr) {
  const SeriesEntry entry = nearest(run / "vtk/walls.pvd", time);
  if (moment) *moment = entry.time;
  return read_wall_frame(run / "vtk" / entry.file);
}

/// The moment nearest to the wanted one of the first region that holds velocities: regions may have intervals of their
/// own, and the first is the widest in the shipped cases.
FieldFrame field_of(const fs::path& run, std::optional<double> time, double& moment) {
  const fs::path pvd = run / "vtk/fields.pvd";
  std::map<int, std::vector<SeriesEntry>> regions;
  for (const auto& entry : read_pvd(pvd)) regions[entry.part].push_back(entry);
  if (regions.empty()) throw OutputError(pvd.string() + " lists no output yet");
  for (const auto& [part, entries] : regions) {
    const SeriesEntry& entry = nearest(entries, time);
    FieldFrame frame = read_field_frame(run / "vtk" / entry.file);
    moment = entry.time;
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
        const SeriesEntry entry = nearest(run / "vtk/carriers.pvd", time);
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
