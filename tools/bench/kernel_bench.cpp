#include "tools/bench/kernel_bench.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "cases/generators/generators.hpp"
#include "lbm/air.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/voxelize.hpp"
#include "tools/bench/machine.hpp"
#include "tools/bench/median.hpp"
#include "tools/bench/streams.hpp"

namespace puffin::bench {

namespace {

using Clock = std::chrono::steady_clock;
namespace geometry = lbm::geometry;
double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

const std::map<std::string, lbm::Law> laws{{"rr3", lbm::Law::rr3},
                                           {"bgk", lbm::Law::bgk},
                                           {"trt", lbm::Law::trt},
                                           {"hrr", lbm::Law::hrr},
                                           {"central-moments", lbm::Law::central_moments}};

/// "none": a periodic box, which has no walls.
const std::map<std::string, lbm::WallScheme> walls{{"none", lbm::WallScheme::halfway},
                                                   {"halfway", lbm::WallScheme::halfway},
                                                   {"bouzidi", lbm::WallScheme::bouzidi},
                                                   {"psm", lbm::WallScheme::psm},
                                                   {"ibm", lbm::WallScheme::ibm}};

/// Walls that compute cells beyond the fluid, or act on whole cells within the collision.
bool beyond_links(const KernelSetting& s) { return s.wall == "psm" || s.wall == "ibm"; }

lbm::AirOptions options_of(const KernelSetting& s) {
  lbm::AirOptions options;
  options.law = laws.at(s.collision);
  options.wall = walls.at(s.wall);
  options.double_precision = s.precision == "double";
  return options;
}

/// A cube of `edge` cells: a closed cavity, or periodic in all directions.
lbm::Air make_box(const KernelSetting& s) {
  const double edge = std::round(std::cbrt(s.cells));
  auto mesh =
      std::make_shared<const geometry::TriangleMesh>(cases::generate("box", {{"x", edge}, {"y", edge}, {"z", edge}}));
  lbm::LinkGeometry surface;
  surface.mesh = mesh.get();
  surface.patch_of_triangle = mesh->solid;
  const auto kind = s.wall == "none" ? lbm::BoundaryKind::periodic : lbm::BoundaryKind::wall;
  for (const std::string& name : mesh->solids) surface.boundaries.push_back({name, kind, {}});
  return lbm::make_air(geometry::voxelize(geometry::TriangleTree(mesh), 1.0), surface, options_of(s));
}

lbm::Air make_l_bend(const KernelSetting& s) {
  auto mesh = std::make_shared<const geometry::TriangleMesh>(cases::generate("l-bend", {}));
  lbm::LinkGeometry surface;
  surface.mesh = mesh.get();
  surface.patch_of_triangle = mesh->solid;
  geometry::VoxelizeOptions options;
  for (const std::string& name : mesh->solids) {
    lbm::Boundary b{name, lbm::BoundaryKind::wall, {}};
    if (name == "inlet") {
      b.kind = lbm::BoundaryKind::velocity_inlet;
      b.profile = [](const geometry::Vec3&) { return geometry::Vec3(1.0, 0.0, 0.0); };
    } else if (name == "outlet") {
      b.kind = lbm::BoundaryKind::pressure_outlet;
    }
    surface.boundaries.push_back(b);
  }
  for (const int solid : mesh->solid)
    options.openings.push_back(surface.boundaries[solid].kind == lbm::BoundaryKind::wall ? 0 : 1);
  const double dx = std::cbrt(geometry::enclosed_volume(*mesh) / s.cells);
  return lbm::make_air(geometry::voxelize(geometry::TriangleTree(mesh), dx, options), surface, options_of(s));
}

lbm::Air make_scene(const KernelSetting& s) { return s.scene == "box" ? make_box(s) : make_l_bend(s); }

/// The same fluid with walls that are links alone, whose collision and streaming are the bare kernel.
std::optional<lbm::Air> make_bare(KernelSetting s) {
  if (!beyond_links(s)) return std::nullopt;
  s.wall = "halfway";
  return make_scene(s);
}

lbm::Drive drive_of(const lbm::Air& air) {
  lbm::Drive drive;
  drive.speed.assign(air.boundaries.size(), 0.0);
  drive.density_excess.assign(air.boundaries.size(), 0.0);
  for (std::size_t b = 0; b < air.boundaries.size(); ++b)
    if (air.boundaries[b].kind == lbm::BoundaryKind::velocity_inlet) drive.speed[b] = 0.05;
  return drive;
}

}  // namespace

KernelRow measure_kernel(const KernelSetting& setting, double seconds, int repeats) {
  if (!laws.contains(setting.collision) || !walls.contains(setting.wall))
    throw std::invalid_argument("bench kernel: no collision '" + setting.collision + "' or wall '" + setting.wall +
                                "'");
  const auto begin = Clock::now();
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, setting.threads);
  lbm::Air air = make_scene(setting);
  std::optional<lbm::Air> twin = make_bare(setting);
  lbm::Air& links_alone = twin ? *twin : air;
  KernelRow row;
  row.setting = setting;
  row.cells = static_cast<std::int64_t>(air.fluid_cells);
  row.cells_active = static_cast<std::int64_t>(air.rows.active_cells());
  lbm::CollisionConstants constants;
  constants.tau0 = 0.5003;
  const lbm::Drive drive = drive_of(air);
  const auto active = static_cast<double>(air.rows.active_cells()), cells = static_cast<double>(air.fluid_cells);
  const std::size_t bytes = setting.precision == "double" ? 8 : 4;
  BoundStream bound_stream(air.rows.active_cells(), bytes);
  CopyStream copy_stream(static_cast<std::size_t>(19.0 * active) * bytes);
  // Steps per second of `step`, which returns the seconds of the part that counts.
  const auto rate = [&](const auto& step) {
    double counted = 0.0;
    int steps = 0;
    const auto start = Clock::now();
    do {
      counted += step();
      ++steps;
    } while (seconds_since(start) < seconds);
    return steps / counted;
  };
  const auto whole_step = [&] {
    const auto start = Clock::now();
    lbm::advance_air(constants, drive, air);
    return seconds_since(start);
  };
  const auto bare_step = [&] {
    const auto start = Clock::now();
    lbm::collide_and_stream(constants, drive, links_alone);
    const double bare = seconds_since(start);
    lbm::apply_links(drive, links_alone);
    return bare;
  };
  for (int warm = 0; warm < 4; ++warm) whole_step();
  if (twin)
    for (int warm = 0; warm < 4; ++warm) bare_step();
  // What is compared is measured in turn, so that what disturbs one disturbs the other; medians over the turns.
  std::vector<double> complete, bare, bound, fraction, bare_fraction, added, copy, bound_over_copy;
  const ForeignLoad load;
  for (int r = 0; r < repeats; ++r) {
    bound.push_back(bound_stream.updates_per_second(seconds));
    complete.push_back(rate(whole_step));
    bare.push_back(rate(bare_step) * static_cast<double>(links_alone.fluid_cells));
    copy.push_back(copy_stream.bandwidth(seconds));
    fraction.push_back(complete.back() * cells / bound.back());
    bare_fraction.push_back(bare.back() / bound.back());
    added.push_back(bare.back() / (complete.back() * cells) - 1.0);
    bound_over_copy.push_back(bound.back() * 38.0 * static_cast<double>(bytes) / copy.back());
  }
  row.foreign_load = load.share();
  row.steps_per_second = median(complete);
  row.mlups = 1e-6 * cells * row.steps_per_second;
  row.mlups_bare = 1e-6 * median(bare);
  row.bound_mlups = 1e-6 * median(bound);
  row.copy_bandwidth = median(copy);
  row.fraction_of_bound = median(fraction);
  row.bare_fraction_of_bound = median(bare_fraction);
  row.added = median(added);
  row.bound_over_copy = median(bound_over_copy);
  row.seconds = seconds_since(begin);
  return row;
}

std::vector<KernelSetting> kernel_settings(bool quick, std::vector<double> sizes, const std::vector<int>& threads) {
  constexpr double large = 5e5;  // beyond it walls are compared no more
  if (sizes.empty()) sizes = quick ? std::vector<double>{2.1e5} : std::vector<double>{2.1e5, 1e6, 4e6, 16e6};
  std::vector<KernelSetting> list;
  for (const double cells : sizes)
    for (const int t : threads) {
      for (const char* scene : {"box", "l-bend"})
        for (const char* collision : {"rr3", "bgk", "trt", "central-moments", "hrr"})
          for (const char* precision : {"float", "double"}) {
            const bool usual = std::string(collision) == "rr3" || std::string(scene) == "l-bend";
            if (quick && (std::string(precision) == "double" || !usual)) continue;
            list.push_back({scene, cells, t, collision, precision, "bouzidi"});
          }
      list.push_back({"box", cells, t, "rr3", "float", "none"});
      list.push_back({"l-bend", cells, t, "rr3", "float", "halfway"});
      if (cells > large) continue;
      for (const char* wall : {"psm", "ibm"}) list.push_back({"l-bend", cells, t, "rr3", "float", wall});
    }
  return list;
}

std::vector<KernelRow> kernel_benchmark(bool quick, std::vector<double> sizes,
                                        const std::function<void(const KernelRow&)>& row_done) {
  const int all = oneapi::tbb::info::default_concurrency();
  std::vector<int> threads{1};
  if (all > 1) threads.push_back(2);
  if (all > 2) threads.push_back(all);
  std::vector<KernelRow> rows;
  for (const KernelSetting& s : kernel_settings(quick, std::move(sizes), threads)) {
    rows.push_back(measure_kernel(s, quick ? 0.06 : 0.15, quick ? 9 : 11));
    row_done(rows.back());
  }
  return rows;
}

}  // namespace puffin::bench
