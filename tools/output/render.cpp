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

using Regions = std::map<int, std::vector<SeriesEntry>>;  // regions may have intervals of their own

Regions regions_of(const fs::path& run) {
  Regions regions;
  for (const auto& entry : read_pvd(run / "vtk/fields.pvd")) regions[entry.part].push_back(entry);
  return regions;
}

bool serves(const FieldFrame& frame, bool lines) {
  return !frame.velocity.empty() && (!lines || *std::min_element(frame.size.begin(), frame.size.end()) > 1);
}

/// The moment nearest to the wanted one of the first region that holds velocities, for lines in three dimensions.
FieldFrame field_of(const fs::path& run, std::optional<double> time, bool lines, double& moment) {
  const Regions regions = regions_of(run);
  if (regions.empty()) throw OutputError((run / "vtk/fields.pvd").string() + " lists no output yet");
  for (const auto& [part, entries] : regions) {
    const SeriesEntry& entry = nearest(entries, time);
    FieldFrame frame = read_field_frame(run / "vtk" / entry.file);
    moment = entry.time;
    if (serves(frame, lines)) return frame;
  }
  throw OutputError(run.string() + " holds no " + (lines ? "three-dimensional " : "") +
                    "fields with velocity; add \"velocity\" to `what` in [output] fields" +
                    (lines ? " and region = \"all\"" : ""));
}

}  // namespace

View parse_view(const std::string& name) {
  for (const View view : {View::geometry, View::carriers, View::slice, View::streamlines, View::wall_map}) {
    if (name == name_of(view)) return view;
  }
  throw std::invalid_argument("there is no view '" + name +
                              "'; choose carriers, wall-map, slice, streamlines or geometry");
}

const char* name_of(View view) {
  switch (view) {
    case View::geometry:
      return "geometry";
    case View::carriers:
      return "carriers";
    case View::slice:
      return "slice";
    case View::streamlines:
      return "streamlines";
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
  if (view == View::streamlines) return !moments_of(run, view).empty();
  return true;
}

std::vector<double> moments_of(const fs::path& run, View view) {
  std::vector<double> times;
  const auto add = [&](const std::vector<SeriesEntry>& entries) {
    for (const auto& entry : entries) times.push_back(entry.time);
  };
  if (view == View::carriers && fs::exists(run / "vtk/carriers.pvd")) add(read_pvd(run / "vtk/carriers.pvd"));
  if (view == View::wall_map || view == View::geometry) add(read_pvd(run / "vtk/walls.pvd"));
  if ((view == View::slice || view == View::streamlines) && fs::exists(run / "vtk/fields.pvd"))
    for (const auto& [part, entries] : regions_of(run))
      if (times.empty() && serves(read_field_frame(run / "vtk" / entries.front().file), view == View::streamlines))
        add(entries);
  return times;
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
                                options.aim, options.width, options.height);
      }
      case View::slice: {
        const FieldFrame field = field_of(run, time, false, moment);
        caption.time = moment;
        const auto thinnest = std::min_element(field.size.begin(), field.size.end()) - field.size.begin();
        const int axis = options.slice_axis.value_or(static_cast<int>(thinnest));
        const double middle = field.origin[axis] + 0.5 * field.dx * (field.size[axis] - 1);
        return slice_picture(field, walls_of(run, {}), axis, options.slice_at.value_or(middle), caption,
                             options.value_max, options.width, options.height);
      }
      case View::streamlines: {
        const FieldFrame field = field_of(run, time, true, moment);
        caption.time = moment;
        return streamlines_picture(field, walls_of(run, {}), caption, options.value_max, options.aim, options.width,
                                   options.height);
      }
      case View::wall_map: {
        const WallFrame walls = walls_of(run, time, &moment);
        caption.time = moment;
        return wall_map_picture(walls, options.wall_quantity, caption, options.aim, options.width, options.height);
      }
      case View::geometry:
        break;
    }
    return geometry_picture(walls_of(run, {}), caption, options.aim, options.width, options.height);
  };
  try {
    write_whole(png, picture().png());
  } catch (const std::invalid_argument& error) {
    throw OutputError(run.string() + ": " + error.what());
  }
}

}  // namespace puffin::output
