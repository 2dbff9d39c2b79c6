#include "tools/puffin/surface_report.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "tools/output/output_error.hpp"
#include "tools/output/picture/views.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

namespace geometry = lbm::geometry;
using nlohmann::json;

json place(const geometry::Vec3& p) { return {p.x(), p.y(), p.z()}; }

json places(const std::vector<geometry::Vec3>& points) {
  json list = json::array();
  for (const geometry::Vec3& p : points) list.push_back(place(p));
  return list;
}

/// Infinity has no place in JSON.
json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json optional(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

void add_report(const geometry::VoxelReport& r, json& j) {
  j["cells_fluid"] = j["cells_active"] = r.cells_fluid;
  j["volume_stl"] = r.volume_stl;
  j["volume_voxels"] = r.volume_voxels;
  j["volume_error"] = r.volume_voxels / r.volume_stl - 1.0;
  j["area_stl"] = r.area_stl;
  j["area_openings"] = r.area_openings;
  j["narrowest_gap"] = finite(r.narrowest_gap);
  j["narrowest_gap_cells"] = finite(r.narrowest_gap_cells);
  j["narrowest_gap_at"] = std::isfinite(r.narrowest_gap) ? place(r.narrowest_gap_at) : json(nullptr);
  j["thinnest_wall"] = finite(r.thinnest_wall);
  j["thinnest_wall_at"] = std::isfinite(r.thinnest_wall) ? place(r.thinnest_wall_at) : json(nullptr);
  j["recommended_dx"] = finite(r.recommended_dx);
  j["pockets_dropped"] = {{"count", r.pockets.count}, {"cells", r.pockets.cells}, {"where", places(r.pockets.where)}};
  j["thin_walls_lost"] = {{"count", r.hidden.thin}, {"where", places(r.hidden.thin_where)}};
  j["buried_faces"] = {{"count", r.hidden.buried}, {"where", places(r.hidden.buried_where)}};
  for (const geometry::PatchReport& p : r.patches)
    j["patches"].push_back({{"name", p.name}, {"area", p.area}, {"triangles", p.triangles}, {"opening", p.opening}});
}

}  // namespace

std::string SurfaceFindings::fatal() const {
  std::string text;
  for (const geometry::Defect& d : defects)
    if (d.fatal) text += (text.empty() ? "" : "\n") + file + ": " + d.kind + ": " + d.message;
  if (report) try {
      geometry::refuse_buried(report->hidden);
    } catch (const geometry::GeometryError& e) {
      text += (text.empty() ? "" : "\n") + file + ": " + e.what();
    }
  return text;
}

json to_json(const SurfaceFindings& f) {
  json j{{"ok", f.fatal().empty()},
         {"dx", f.dx},
         {"weld_tolerance", f.weld_tolerance},
         {"seconds", f.seconds},
         {"patches", json::array()},
         {"defects", json::array()},
         {"repaired", json::array()}};
  for (const char* key : {"cells_fluid", "cells_active", "volume_stl", "volume_voxels", "volume_error", "area_stl",
                          "area_openings", "narrowest_gap", "narrowest_gap_cells", "narrowest_gap_at", "thinnest_wall",
                          "thinnest_wall_at", "recommended_dx", "pockets_dropped", "thin_walls_lost", "buried_faces"})
    j[key] = nullptr;
  if (f.report) add_report(*f.report, j);
  json& c = j["convergence"] = nullptr;
  if (f.convergence)
    c = {{"dx", f.convergence->dx},
         {"volume_error", f.convergence->volume_error},
         {"surface_error", f.convergence->surface_error},
         {"volume_order", optional(f.convergence->volume_order)},
         {"surface_order", optional(f.convergence->surface_order)}};
  for (const geometry::Defect& d : f.defects)
    j["defects"].push_back(
        {{"kind", d.kind}, {"count", d.count}, {"where", places(d.where)}, {"message", d.message}, {"fatal", d.fatal}});
  for (const geometry::Repair& r : f.repairs)
    j["repaired"].push_back({{"what", r.what}, {"count", r.count}, {"where", places(r.where)}, {"message", r.message}});
  return j;
}

void print_findings(const SurfaceFindings& f) {
  for (const geometry::Repair& r : f.repairs) print("repaired   " + r.message);
  for (const geometry::Defect& d : f.defects)
    print("defect     " + d.kind + (d.count > 1 ? " (" + std::to_string(d.count) + ")" : "") + ": " + d.message);
  if (!f.report) return;
  const geometry::VoxelReport& r = *f.report;
  print("cells      " + std::to_string(r.cells_fluid) + " of " + as_length(f.dx));
  print("volume     " + as_volume(r.volume_stl) + " (voxels " + as_volume(r.volume_voxels) + ", " +
        four_digits(100.0 * (r.volume_voxels / r.volume_stl - 1.0)) + " %)");
  if (f.convergence) {
    const geometry::Convergence& c = *f.convergence;
    const auto order = [](const std::optional<double>& o) { return o ? ", order " + four_digits(*o) : ""; };
    print("surface    " + as_length(c.surface_error[0]) + " from the faces of the cells on average" +
          order(c.surface_order) + "; volume" + (c.volume_order ? order(c.volume_order) : ", fits the cells"));
  }
  if (std::isfinite(r.narrowest_gap))
    print("narrowest  " + as_length(r.narrowest_gap) + ", " + four_digits(r.narrowest_gap_cells) + " cells, at " +
          geometry::place_text(r.narrowest_gap_at) + "; " + as_length(r.recommended_dx) + " gives " +
          four_digits(geometry::VoxelReport::cells_across));
  for (const geometry::PatchReport& p : r.patches)
    print("patch      " + p.name + ": " + four_digits(p.area * 1e6) + " mm^2, " + std::to_string(p.triangles) +
          " triangles" + (p.opening ? ", opening" : ""));
  if (r.pockets.count > 0)
    print("dropped    " + std::to_string(r.pockets.count) + " pockets, " + std::to_string(r.pockets.cells) +
          " cells, the largest at " + geometry::place_text(r.pockets.where[0]));
  if (r.hidden.thin > 0)
    print("thin walls " + std::to_string(r.hidden.thin) + " pairs of cells with a wall between them, the first at " +
          geometry::place_text(r.hidden.thin_where[0]) + "; a smaller dx gives the wall cells of its own");
  print("welded     corners nearer than " + as_length(f.weld_tolerance));
}

void write_picture(const SurfaceFindings& f, const geometry::TriangleMesh& mesh, const geometry::Patches& patches,
                   const std::vector<std::string>& openings, const std::filesystem::path& png) {
  output::WallFrame walls;
  for (const geometry::Vec3& v : mesh.vertices) walls.vertices.push_back({v.x(), v.y(), v.z()});
  walls.triangles = mesh.triangles;
  walls.patch.assign(patches.of_triangle.begin(), patches.of_triangle.end());
  for (const std::string& name : patches.names)
    walls.patches.push_back({name, std::find(openings.begin(), openings.end(), name) != openings.end()});
  std::vector<output::PictureMarks> marks;
  const auto mark = [&](const std::string& name, std::size_t count, const std::vector<geometry::Vec3>& where) {
    output::PictureMarks m{name, count, {}};
    for (const geometry::Vec3& p : where) m.at.push_back({p.x(), p.y(), p.z()});
    if (!m.at.empty()) marks.push_back(std::move(m));
  };
  for (const geometry::Defect& d : f.defects) mark(d.kind, d.count, d.where);
  for (const geometry::Repair& r : f.repairs) mark(r.what, r.count, r.where);
  std::string text = "unusable as it is";
  if (f.report) {
    const geometry::VoxelReport& r = *f.report;
    mark("pockets cut off", r.pockets.count, r.pockets.where);
    mark("thin walls lost", r.hidden.thin, r.hidden.thin_where);
    mark("buried faces", r.hidden.buried, r.hidden.buried_where);
    text = std::to_string(r.cells_fluid) + " cells of " + as_length(f.dx) + ",  volume " +
           four_digits(100.0 * (r.volume_voxels / r.volume_stl - 1.0)) + " %";
    if (std::isfinite(r.narrowest_gap)) {
      mark("narrowest gap", 1, {r.narrowest_gap_at});
      text += ",  narrowest gap " + as_length(r.narrowest_gap) + " = " + four_digits(r.narrowest_gap_cells) + " cells";
    }
  }
  const output::Canvas canvas = output::geometry_picture(walls, {text, {}}, {}, 1600, 1000, marks);
  std::ofstream out(png, std::ios::binary);
  const std::string bytes = canvas.png();
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw output::OutputError(png.string() + ": cannot be written");
}

}  // namespace puffin::tools
