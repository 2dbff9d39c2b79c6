#include "tools/output/render.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/picture/views.hpp"
#include "tools/output/picture/wall_shape.hpp"
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

/// The moment nearest to the wanted one of the first region that holds velocities in three dimensions.
FieldFrame field_for_lines(const fs::path& run, std::optional<double> time, double& moment) {
  const Regions regions = regions_of(run);
  if (regions.empty()) throw OutputError((run / "vtk/fields.pvd").string() + " lists no output yet");
  for (const auto& [part, entries] : regions) {
    const SeriesEntry& entry = nearest(entries, time);
    FieldFrame frame = read_field_frame(run / "vtk" / entry.file);
    moment = entry.time;
    if (serves(frame, true)) return frame;
  }
  throw OutputError(
      run.string() +
      " holds no three-dimensional fields with velocity; add \"velocity\" to `what` in [output] fields and "
      "region = \"all\"");
}

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void refuse_quantity(const std::string& quantity, const std::string& whose,
                                  const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  throw NotStored(whose + " hold no quantity '" + quantity + "'; they hold " + list);
}

/// Extent along an axis [m], and whether a plane lies in it.
struct Reach {
  double low = 0.0, high = 0.0;
  bool holds(double at) const {
    const double rounding = 1e-9 * (high - low);
    return at >= low - rounding && at <= high + rounding;
  }
};

Reach reach_of(const FieldFrame& field, int axis) {
  const double low = field.origin[axis] - 0.5 * field.dx;
  return {low, low + field.size[axis] * field.dx};
}

[[noreturn]] void refuse_plane(int axis, double at, const std::string& what, const Reach& reach) {
  const std::string name(1, "xyz"[axis]);
  throw NotStored("the plane " + name + formatted(" = %.6g mm", at * 1e3) + " lies outside " + what + ", from" +
                  formatted(" %.6g", reach.low * 1e3) + formatted(" to %.6g mm", reach.high * 1e3) + " along " + name);
}

/// The moment nearest to the wanted one of the first region that holds the quantity, and the plane if there is one.
FieldFrame field_for_slice(const fs::path& run, std::optional<double> time, const std::string& quantity,
                           const RenderOptions& options, double& moment) {
  const Regions regions = regions_of(run);
  if (regions.empty()) throw OutputError((run / "vtk/fields.pvd").string() + " lists no output yet");
  std::vector<std::string> stored;
  std::optional<Reach> elsewhere;
  for (const auto& [part, entries] : regions) {
    const SeriesEntry& entry = nearest(entries, time);
    FieldFrame frame = read_field_frame(run / "vtk" / entry.file);
    const std::vector<std::string> names = slice_quantities(frame);
    for (const std::string& name : names)
      if (!among(stored, name)) stored.push_back(name);
    if (!among(names, quantity)) continue;
    moment = entry.time;
    if (!options.slice_axis || !options.slice_at) return frame;
    const Reach reach = reach_of(frame, *options.slice_axis);
    if (reach.holds(*options.slice_at)) return frame;
    elsewhere = elsewhere.value_or(reach);
  }
  if (elsewhere) refuse_plane(*options.slice_axis, *options.slice_at, "the stored fields with " + quantity, *elsewhere);
  if (stored.empty())
    throw OutputError(run.string() +
                      " holds no fields that can be painted; add \"velocity\" to `what` in [output] fields");
  refuse_quantity(quantity, "the stored fields", stored);
}

Canvas slice_of(const fs::path& run, std::optional<double> time, const RenderOptions& options, Caption& caption) {
  const WallFrame walls = walls_of(run, {});
  if (options.slice_axis && options.slice_at) {
    const Extent extent = extent_of(walls);
    const Reach device{extent.low[*options.slice_axis], extent.high[*options.slice_axis]};
    if (!device.holds(*options.slice_at)) refuse_plane(*options.slice_axis, *options.slice_at, "the device", device);
  }
  const std::string quantity = options.quantity.empty() ? "speed" : options.quantity;
  double moment = 0.0;
  const FieldFrame field = field_for_slice(run, time, quantity, options, moment);
  caption.time = moment;
  const auto thinnest = std::min_element(field.size.begin(), field.size.end()) - field.size.begin();
  const int axis = options.slice_axis.value_or(static_cast<int>(thinnest));
  const double middle = field.origin[axis] + 0.5 * field.dx * (field.size[axis] - 1);
  return slice_picture(field, walls, quantity, axis, options.slice_at.value_or(middle), caption, options.value_max,
                       options.width, options.height);
}

Canvas wall_map_of(const fs::path& run, std::optional<double> time, const RenderOptions& options, Caption& caption) {
  double moment = 0.0;
  const WallFrame walls = walls_of(run, time, &moment);
  caption.time = moment;
  const std::string quantity = options.quantity.empty() ? "fines" : options.quantity;
  const std::vector<std::string> names = wall_quantities(walls);
  if (!names.empty() && !among(names, quantity)) refuse_quantity(quantity, "the stored walls", names);
  return wall_map_picture(walls, quantity, caption, options.aim, options.width, options.height);
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
      case View::slice:
        return slice_of(run, time, options, caption);
      case View::streamlines: {
        const FieldFrame field = field_for_lines(run, time, moment);
        caption.time = moment;
        return streamlines_picture(field, walls_of(run, {}), caption, options.value_max, options.aim, options.width,
                                   options.height);
      }
      case View::wall_map:
        return wall_map_of(run, time, options, caption);
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
