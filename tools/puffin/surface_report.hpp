#pragma once
// What `puffin voxelize` found out about a surface: as JSON, as text, and as a picture.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lbm/geometry/repair.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/voxel_report.hpp"

namespace puffin::tools {

struct SurfaceFindings {
  std::string file;
  double dx = 0.0;              // [m]
  double weld_tolerance = 0.0;  // [m]
  std::vector<lbm::geometry::Repair> repairs{};
  std::vector<lbm::geometry::Defect> defects{};
  // Absent where the surface bounds no volume.
  std::optional<lbm::geometry::VoxelReport> report{};
  std::optional<lbm::geometry::Convergence> convergence{};
  double seconds = 0.0;

  /// Every fatal defect and buried faces, a line each; empty if the surface can be used.
  std::string fatal() const;
};

/// All keys always; null where there is no answer. `ok` tells whether a run would take the surface.
nlohmann::json to_json(const SurfaceFindings& f);

/// Lines for people, on stdout.
void print_findings(const SurfaceFindings& f);

/// The surface with its patches in colours and the places of what was found; writes a PNG.
void write_picture(const SurfaceFindings& f, const lbm::geometry::TriangleMesh& mesh,
                   const lbm::geometry::Patches& patches, const std::vector<std::string>& openings,
                   const std::filesystem::path& png);

}  // namespace puffin::tools
