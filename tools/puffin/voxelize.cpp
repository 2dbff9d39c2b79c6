// puffin voxelize FILE.stl --dx LENGTH: voxels as .vti and a report on the quality of the surface and of the voxels.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lbm/geometry/repair.hpp"
#include "lbm/geometry/stl.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/voxel_report.hpp"
#include "tools/output/vtk_series.hpp"
#include "tools/puffin/arguments.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

namespace geometry = lbm::geometry;
using nlohmann::json;

struct VoxelizeArguments {
  std::string file, dx, unit = "mm", out;
  bool repair = false, json = false;
};

json place(const geometry::Vec3& p) { return {p.x(), p.y(), p.z()}; }

json places(const std::vector<geometry::Vec3>& points) {
  json list = json::array();
  for (const geometry::Vec3& p : points) list.push_back(place(p));
  return list;
}

/// Infinity has no place in JSON.
json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json to_json(const geometry::VoxelReport& r, const std::vector<geometry::Defect>& defects,
             const std::vector<geometry::Repair>& repairs, double seconds) {
  json j{
      {"cells_fluid", r.cells_fluid},
      {"cells_active", r.cells_fluid},
      {"volume_stl", r.volume_stl},
      {"volume_voxels", r.volume_voxels},
      {"area_stl", r.area_stl},
      {"narrowest_gap", finite(r.narrowest_gap)},
      {"narrowest_gap_cells", finite(r.narrowest_gap_cells)},
      {"thinnest_wall", finite(r.thinnest_wall)},
      {"recommended_dx", finite(r.recommended_dx)},
      {"pockets_dropped", {{"count", r.pockets.count}, {"cells", r.pockets.cells}, {"where", places(r.pockets.where)}}},
      {"seconds", seconds},
      {"patches", json::array()},
      {"defects", json::array()},
      {"repaired", json::array()}};
  for (const geometry::PatchReport& p : r.patches)
    j["patches"].push_back({{"name", p.name}, {"area", p.area}, {"triangles", p.triangles}, {"opening", p.opening}});
  for (const geometry::Defect& d : defects)
    j["defects"].push_back(
        {{"kind", d.kind}, {"count", d.count}, {"where", places(d.where)}, {"message", d.message}, {"fatal", d.fatal}});
  for (const geometry::Repair& f : repairs)
    j["repaired"].push_back({{"what", f.what}, {"count", f.count}, {"where", places(f.where)}, {"message", f.message}});
  return j;
}

void print_report(const geometry::VoxelReport& r, double dx, const std::vector<geometry::Defect>& defects,
                  const std::vector<geometry::Repair>& repairs) {
  print("cells      " + std::to_string(r.cells_fluid) + " of " + as_length(dx));
  print("volume     " + as_volume(r.volume_stl) + " (voxels " + as_volume(r.volume_voxels) + ", " +
        four_digits(100.0 * (r.volume_voxels / r.volume_stl - 1.0)) + " %)");
  if (std::isfinite(r.narrowest_gap))
    print("narrowest  " + as_length(r.narrowest_gap) + ", " + four_digits(r.narrowest_gap_cells) + " cells; " +
          as_length(r.recommended_dx) + " gives " + four_digits(geometry::VoxelReport::cells_across));
  for (const geometry::PatchReport& p : r.patches)
    print("patch      " + p.name + ": " + four_digits(p.area * 1e6) + " mm^2, " + std::to_string(p.triangles) +
          " triangles" + (p.opening ? ", opening" : ""));
  if (r.pockets.count > 0)
    print("dropped    " + std::to_string(r.pockets.count) + " pockets, " + std::to_string(r.pockets.cells) + " cells");
  for (const geometry::Repair& f : repairs) print("repaired   " + f.message);
  for (const geometry::Defect& d : defects) print("defect     " + d.kind + ": " + d.message);
}

void write_voxels(const std::filesystem::path& folder, const geometry::Voxels& voxels) {
  std::filesystem::create_directories(folder);
  output::FieldFrame frame;
  frame.origin = {voxels.origin.x(), voxels.origin.y(), voxels.origin.z()};
  frame.dx = voxels.dx;
  frame.size = voxels.size;
  frame.fluid = voxels.fluid;
  output::write_vti(folder / "voxels.vti", frame);
}

double unit_of(const std::string& name) { return cases::parse_quantity("1 " + name, cases::unit::length); }

int voxelize(const VoxelizeArguments& a) {
  const auto begin = std::chrono::steady_clock::now();
  const double dx = positive_quantity(a.dx, cases::unit::length, "--dx");
  geometry::TriangleMesh mesh = geometry::read_stl(a.file, unit_of(a.unit));
  std::vector<geometry::Repair> repairs;
  if (a.repair) repairs = geometry::repair(mesh);
  const std::vector<geometry::Defect> defects = geometry::check_surface(mesh);
  std::string fatal;
  for (const geometry::Defect& d : defects)
    if (d.fatal) fatal += (fatal.empty() ? "" : "\n") + a.file + ": " + d.kind + ": " + d.message;
  if (!fatal.empty()) throw geometry::GeometryError(fatal + (a.repair ? "" : "\n--repair mends what can be mended"));
  const geometry::Patches patches = geometry::assign_patches(mesh, {});
  std::vector<std::string> openings;  // by name alone: nothing else says so in an STL file
  for (const std::string& name : patches.names)
    if (name == "inlet" || name == "outlet") openings.push_back(name);
  geometry::VoxelizeOptions options;
  if (!openings.empty())
    for (const int patch : patches.of_triangle)
      options.openings.push_back(patches.names[patch] == "inlet" || patches.names[patch] == "outlet");
  const geometry::TriangleTree tree(mesh);
  geometry::Pockets dropped;
  geometry::Voxels voxels;
  try {
    voxels = geometry::voxelize(tree, dx, options, &dropped);
  } catch (const std::invalid_argument& e) {
    throw ResourceError(e.what());
  }
  const geometry::VoxelReport report = geometry::voxel_report(tree, voxels, patches, openings, dropped);
  if (!a.out.empty()) write_voxels(a.out, voxels);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (a.json)
    print(to_json(report, defects, repairs, seconds).dump(2));
  else
    print_report(report, dx, defects, repairs);
  return ok;
}

}  // namespace

namespace commands {
Command voxelize() {
  return {"voxelize", "voxels of a closed STL surface, and what is wrong with it", [](CLI::App& app) -> Action {
            auto a = std::make_shared<VoxelizeArguments>();
            app.add_option("file", a->file, "the surface")->required()->type_name("FILE.stl");
            app.add_option("--dx", a->dx, "edge of a cell, like 0.2mm")->required()->type_name("LENGTH");
            app.add_option("--unit", a->unit, "unit of the file")
                ->check(CLI::IsMember({"m", "cm", "mm", "um"}))
                ->capture_default_str();
            app.add_flag("--repair", a->repair, "weld, turn and close what can be mended without guessing");
            app.add_option("--out", a->out, "folder for voxels.vti")->type_name("DIR");
            app.add_flag("--json", a->json, "one JSON object on stdout");
            return [a] { return puffin::tools::voxelize(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
