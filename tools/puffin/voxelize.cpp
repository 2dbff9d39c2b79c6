// puffin voxelize FILE.stl --dx LENGTH: voxels as .vti and a report on the quality of the surface and of the voxels.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>

#include "cases/spelling.hpp"
#include "lbm/geometry/stl.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/vtk_series.hpp"
#include "tools/puffin/arguments.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/surface_report.hpp"

namespace puffin::tools {
namespace {

namespace geometry = lbm::geometry;

struct VoxelizeArguments {
  std::string file, dx, unit = "mm", out, largest_hole;
  std::vector<std::string> openings{"inlet", "outlet"};  // by name alone: nothing else says so in an STL file
  bool repair = false, json = false;
};

void write_voxels(const std::filesystem::path& folder, const geometry::Voxels& voxels) {
  output::FieldFrame frame;
  frame.origin = {voxels.origin.x(), voxels.origin.y(), voxels.origin.z()};
  frame.dx = voxels.dx;
  frame.size = voxels.size;
  frame.fluid.assign(static_cast<std::size_t>(frame.cells()), 0);
  for (std::size_t row = 0; row < voxels.rows(); ++row)
    for (const geometry::FluidRun& run : voxels.row(row)) {
      const auto begin = frame.fluid.begin() + static_cast<std::ptrdiff_t>(row) * voxels.size[0];
      std::fill(begin + run.begin, begin + run.end, 1);
    }
  output::write_vti(folder / "voxels.vti", frame);
}

double unit_of(const std::string& name) { return cases::parse_quantity("1 " + name, cases::unit::length); }

/// Cells and what they lose, into the findings.
geometry::Voxels make_voxels(const geometry::TriangleMesh& mesh, const geometry::Patches& patches,
                             const std::vector<std::string>& openings, SurfaceFindings& f) {
  geometry::VoxelizeOptions options;
  if (!openings.empty())
    for (const int patch : patches.of_triangle)
      options.openings.push_back(std::find(openings.begin(), openings.end(), patches.names[patch]) != openings.end());
  const geometry::TriangleTree tree(std::shared_ptr<const geometry::TriangleMesh>(std::shared_ptr<void>(), &mesh));
  geometry::Pockets dropped;
  geometry::Voxels voxels;
  try {
    voxels = geometry::voxelize(tree, f.dx, options, &dropped);
  } catch (const std::invalid_argument& e) {
    throw ResourceError(e.what());
  }
  f.report = geometry::voxel_report(tree, voxels, patches, openings, dropped);
  f.convergence = geometry::convergence(tree, voxels);
  return voxels;
}

int voxelize(const VoxelizeArguments& a) {
  const auto begin = std::chrono::steady_clock::now();
  SurfaceFindings f{.file = a.file, .dx = positive_quantity(a.dx, cases::unit::length, "--dx")};
  geometry::RepairOptions mending;
  if (!a.largest_hole.empty())
    mending.largest_hole = positive_quantity(a.largest_hole, cases::unit::length, "--largest-hole");
  const double unit = unit_of(a.unit);
  geometry::TriangleMesh mesh = geometry::read_stl(a.file, unit);
  f.weld_tolerance = geometry::weld_tolerance(mesh);
  if (a.repair) f.repairs = geometry::repair(mesh, mending);
  f.defects = geometry::check_surface(mesh);
  const bool sound = f.fatal().empty();
  const geometry::Patches patches = geometry::assign_patches(mesh, {});
  const std::vector<std::string> usual = VoxelizeArguments{}.openings;
  for (const std::string& name : a.openings)
    if (patches.find(name) < 0 && std::find(usual.begin(), usual.end(), name) == usual.end())
      throw UsageError("--opening: there is no solid '" + name + "'; there are " + cases::join(patches.names));
  std::vector<std::string> openings;
  for (const std::string& name : patches.names)
    if (std::find(a.openings.begin(), a.openings.end(), name) != a.openings.end()) openings.push_back(name);
  geometry::Voxels voxels;
  if (sound) try {
      voxels = make_voxels(mesh, patches, openings, f);
    } catch (const geometry::GeometryError& e) {
      f.failure = e.what();
    }
  f.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!a.out.empty()) {
    std::filesystem::create_directories(a.out);
    const std::filesystem::path folder(a.out);
    if (f.report) write_voxels(folder, voxels);
    if (!f.repairs.empty())
      geometry::write_stl((folder / "repaired.stl").string(), mesh, mesh.solids.size() == 1, unit);
    write_picture(f, mesh, patches, openings, folder / "report.png");
    output::write_whole(folder / "report.json",
                        to_json(f).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
  std::string fatal = f.fatal();
  if (!sound && !a.repair) fatal += "\n--repair mends what can be mended without guessing";
  if (a.json) {
    nlohmann::json j = to_json(f);
    if (!fatal.empty()) {
      j["exit_code"] = static_cast<int>(geometry_invalid);
      j["problems"] = {{{"message", fatal}}};
    }
    print(j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print_findings(f);
  }
  if (fatal.empty()) return ok;
  if (!a.json) log_error(fatal);
  return geometry_invalid;
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
            app.add_option("--opening", a->openings, "solids that are openings; the rest is wall")
                ->type_name("NAME")
                ->expected(1)
                ->take_all()
                ->capture_default_str();
            app.add_flag("--repair", a->repair, "weld, remove, turn and close what can be mended without guessing");
            app.add_option(
                   "--largest-hole", a->largest_hole,
                   "--repair leaves holes with a longer rim open; default a twentieth of the diagonal, or one facet")
                ->type_name("LENGTH");
            app.add_option("--out", a->out, "folder for voxels.vti, report.json, report.png and repaired.stl")
                ->type_name("DIR");
            app.add_flag("--json", a->json, "one JSON object on stdout");
            return [a] { return puffin::tools::voxelize(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
