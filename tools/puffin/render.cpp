// puffin render

#include "tools/output/render.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/spelling.hpp"
#include "cases/units.hpp"
#include "tools/puffin/arguments.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

struct RenderArguments {
  std::filesystem::path run, out;
  std::string view = "carriers", at, plane, quantity, maximum, focus;
  std::optional<double> azimuth, elevation;
  std::vector<int> size{1600, 1000};
};

double quantity(const std::string& text, const cases::Unit& unit, const char* option) try {
  return cases::parse_quantity(text, unit);
} catch (const cases::UnitError& e) {
  throw UsageError(std::string(option) + ": " + e.what());
}

/// "z" or "z=2.2mm".
void set_plane(const std::string& text, output::RenderOptions& options) {
  const std::size_t axis = std::string("xyz").find(text.substr(0, 1));
  if (axis == std::string::npos || (text.size() > 1 && text[1] != '='))
    throw UsageError("--plane " + text + ": write an axis and a place, for example z=2.2mm");
  options.slice_axis = static_cast<int>(axis);
  if (text.size() > 1) options.slice_at = quantity(text.substr(2), cases::unit::length, "--plane");
}

/// Nothing that is asked for is left out in silence: an option that says nothing to the view is refused.
void check_options(const RenderArguments& given) {
  const auto only_of = [&](bool asked, const char* option, std::vector<std::string> views) {
    if (asked && std::find(views.begin(), views.end(), given.view) == views.end())
      throw UsageError(std::string(option) + " does nothing in the view " + given.view + "; it belongs to " +
                       cases::join(views));
  };
  only_of(!given.quantity.empty(), "--quantity", {"slice", "wall-map"});
  only_of(!given.maximum.empty(), "--max", {"slice", "carriers", "streamlines"});
  only_of(!given.plane.empty(), "--plane", {"slice"});
  only_of(!given.at.empty(), "--at", {"carriers", "slice", "streamlines", "wall-map", "geometry"});
  const std::vector<std::string> solid{"carriers", "wall-map", "streamlines", "geometry"};
  only_of(given.azimuth.has_value(), "--azimuth", solid);
  only_of(given.elevation.has_value(), "--elevation", solid);
  only_of(!given.focus.empty(), "--focus", solid);
}

/// In which `--max` is given.
const cases::Unit& unit_of(const RenderArguments& given) {
  if (given.quantity == "pressure") return cases::unit::pressure;
  return given.quantity.starts_with("fines") ? cases::unit::number_density : cases::unit::velocity;
}

int render_command(const RenderArguments& given) {
  if (given.out.extension() != ".png")
    throw UsageError("--out " + given.out.string() + ": the picture is a PNG; give a name that ends in .png");
  check_options(given);
  output::RenderOptions options;
  options.quantity = given.quantity;
  options.aim = {given.azimuth, given.elevation, given.focus};
  options.width = given.size[0], options.height = given.size[1];
  if (!given.plane.empty()) set_plane(given.plane, options);
  if (!given.maximum.empty()) options.value_max = positive_quantity(given.maximum, unit_of(given), "--max");
  std::optional<double> time;
  if (!given.at.empty()) time = quantity(given.at, cases::unit::time, "--at");
  output::render(given.run, output::parse_view(given.view), time, given.out, options);
  print(given.out.string());
  return 0;
}

}  // namespace

namespace commands {
Command render() {
  return {"render", "a picture of a run; no display needed", [](CLI::App& app) -> Action {
            auto given = std::make_shared<RenderArguments>();
            app.add_option("run", given->run, "the folder of a run")->required()->type_name("RUNDIR");
            app.add_option("--view", given->view, "carriers, wall-map, slice, streamlines or geometry")
                ->check(CLI::IsMember({"carriers", "wall-map", "slice", "streamlines", "geometry"}))
                ->capture_default_str();
            app.add_option("--at", given->at, "the stored moment nearest to this; default the last")->type_name("TIME");
            app.add_option("--plane", given->plane, "of the slice: an axis and a place, z=2.2mm; default the middle")
                ->type_name("AXIS[=LENGTH]");
            app.add_option("--quantity", given->quantity,
                           "of the slice: speed (usual), pressure, fines (of the first scalar), fines_NAME; "
                           "of the wall map: fines (usual), fines_NAME of a further scalar, hits, energy")
                ->type_name("NAME");
            app.add_option("--max", given->maximum,
                           "upper end of the colour scale, to compare pictures: "
                           "a speed; for a slice, a value in the unit of its quantity")
                ->type_name("VALUE");
            app.add_option("--azimuth", given->azimuth, "where the eye stands: degrees from the x axis towards y");
            app.add_option("--elevation", given->elevation, "and degrees upwards; -90 from below")
                ->check(CLI::Range(-90.0, 90.0));
            app.add_option("--focus", given->focus, "close up on this patch, for example pocket")->type_name("PATCH");
            app.add_option("--size", given->size, "width and height in pixels")
                ->expected(2)
                ->check(CLI::Range(400, 8000))
                ->capture_default_str();
            app.add_option("--out", given->out, "the picture")->required()->type_name("FILE.png");
            return [given] { return render_command(*given); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
