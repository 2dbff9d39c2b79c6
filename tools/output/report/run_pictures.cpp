#include "tools/output/report/run_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "tools/output/csv_file.hpp"
#include "tools/output/link_out.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/picture/views.hpp"
#include "tools/output/report/html.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

constexpr int small_width = 960, small_height = 640;  // [pixel] of pictures that stand side by side

std::string moment(double time) { return "t = " + shortest(std::round(time * 1e4) / 10) + " ms"; }

double nearest(const std::vector<double>& times, double wanted) {
  return *std::min_element(times.begin(), times.end(),
                           [&](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); });
}

/// The stored moments nearest to the wanted ones, each once.
std::vector<double> chosen(const std::vector<double>& times, const std::vector<double>& wanted) {
  std::vector<double> out;
  for (const double w : wanted)
    if (const double t = nearest(times, w); out.empty() || t > out.back()) out.push_back(t);
  return out;
}

/// The patch that holds the dose, by its name.
bool has_patch(const fs::path& run, const std::string& name) {
  const WallFrame walls = read_wall_frame(run / "vtk" / read_pvd(run / "vtk/walls.pvd").front().file);
  return std::any_of(walls.patches.begin(), walls.patches.end(), [&](const WallPatch& p) { return p.name == name; });
}

/// Largest speed of the carriers at some moments, for one scale.
double speed_of_all(const fs::path& run, const std::vector<double>& times) {
  double most = 0.0;
  for (const auto& entry : read_pvd(run / "vtk/carriers.pvd"))
    if (std::find(times.begin(), times.end(), entry.time) != times.end())
      most = std::max(most, speed_scale(read_carrier_frame(run / "vtk" / entry.file)));
  return most;
}

bool newer(const fs::path& file, const fs::path& than) {
  std::error_code error;
  const auto a = fs::last_write_time(file, error);
  if (error) return false;
  const auto b = fs::last_write_time(than, error);
  return !error && a >= b;
}

/// Subject and time of a picture, and what its caption adds.
std::string alt_of(const RunPicture& p) {
  const bool hits = p.options.quantity == "hits";
  std::string text = p.view == View::carriers      ? "Carriers in the device, coloured by speed"
                     : p.view == View::slice       ? "Speed of the air on a plane"
                     : p.view == View::streamlines ? "Streamlines of the air"
                     : hits                        ? "Impacts of carriers on the walls"
                                                   : "Fines on the walls";
  if (p.view == View::geometry) return p.caption;
  if (p.time && p.caption.ends_with(moment(*p.time))) return text + ", " + p.caption;
  text += p.time ? ", " + moment(*p.time) : ", last stored moment";
  return text + ". " + p.caption;
}

}  // namespace

std::string left_out(const std::string& why) { return "<p class=soft>Left out: " + escaped(why) + "</p>\n"; }

std::vector<RunPicture> streamline_pictures(const fs::path& run) {
  const std::vector<double> stored = moments_of(run, View::streamlines);
  if (stored.empty()) return {};
  // At the very start the air rests; shortly after is the first moment of interest, as in the thesis's figure 4.1.
  const double begin = stored.size() > 1 ? stored[1] : stored[0], end = stored.back();
  const std::vector<double> times =
      chosen(stored, {begin, begin + (end - begin) / 3, begin + 2 * (end - begin) / 3, end});
  std::vector<RunPicture> pictures;
  const auto add = [&](const std::string& name, const Aim& aim, const std::string& what) {
    for (std::size_t n = 0; n < times.size(); ++n) {
      RunPicture p{name + std::to_string(n + 1), View::streamlines, times[n], what + moment(times[n]), {}};
      p.options.width = small_width, p.options.height = small_height, p.options.aim = aim;
      pictures.push_back(p);
    }
  };
  add("streamlines-", {}, "");
  if (has_patch(run, "pocket")) add("streamlines-pocket-", {-90.0, 0.0, "pocket"}, "from the side, at the pocket, ");
  return pictures;
}

std::vector<RunPicture> flight_pictures(const fs::path& run, const Summary& summary) {
  const std::vector<double> stored = moments_of(run, View::carriers);
  if (stored.empty() || !summary.carriers) return {};
  const double begin = summary.carriers->first_motion.value_or(stored.front());
  const double end = summary.carriers->last_emitted.value_or(stored.back());
  const std::vector<double> times = chosen(stored, {begin + 0.10 * (end - begin), begin + 0.35 * (end - begin),
                                                    begin + 0.60 * (end - begin), begin + 0.85 * (end - begin)});
  const double scale = speed_of_all(run, times);
  std::vector<RunPicture> pictures;
  for (std::size_t n = 0; n < times.size(); ++n) {
    RunPicture p{"carriers-" + std::to_string(n + 1), View::carriers, times[n], moment(times[n]), {}};
    p.options.width = small_width, p.options.height = small_height, p.options.value_max = scale;
    pictures.push_back(p);
  }
  return pictures;
}

RunPicture retained_picture(const Summary& summary, bool small) {
  RunPicture p{
      small ? "carriers-end-small" : "carriers-end", View::carriers, {}, "What is left in the device at the end.", {}};
  if (summary.carriers)
    p.caption = "At the end: " + std::to_string(summary.carriers->retained) + " of " +
                std::to_string(summary.carriers->count) + " carriers are in the device.";
  if (small) p.options.width = small_width, p.options.height = small_height;
  return p;
}

RunPicture geometry_picture_of_run() {
  return {"geometry",
          View::geometry,
          {},
          "The device with its patches. Parallel projection: the scale bar holds everywhere.",
          {}};
}

RunPicture slice_picture_of_run() {
  return {"slice", View::slice, {}, "Speed on the middle plane at the last stored moment.", {}};
}

RunPicture wall_map_picture_of_run(const std::string& quantity) {
  RunPicture p{quantity == "fines" ? "wall-map" : "wall-" + quantity,
               View::wall_map,
               {},
               "On the triangles of the device's own surface, seen from outside; logarithmic.",
               {}};
  if (quantity == "hits") p.caption = "Impacts of carriers per area.";
  p.options.quantity = quantity;
  return p;
}

std::string embedded(const fs::path& run, const RunPicture& picture, bool kept) {
  const fs::path file = run / "images" / (picture.name + ".png");
  try {
    refuse_link_out(run, file);
    if (!kept || !newer(file, run / "summary.json")) {
      std::error_code error;
      fs::create_directories(file.parent_path(), error);
      render(run, picture.view, picture.time, file, picture.options);
    }
  } catch (const OutputError& error) {
    return left_out(error.what());
  }
  std::ifstream stream(file, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  return figure_png(bytes.str(), picture.caption, alt_of(picture));
}

std::string embedded(const fs::path& run, const std::vector<RunPicture>& pictures, bool kept) {
  std::string out = "<div class=pair>\n";
  for (const RunPicture& p : pictures) out += embedded(run, p, kept);
  return out + "</div>\n";
}

}  // namespace puffin::output
