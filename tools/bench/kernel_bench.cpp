#include "tools/bench/kernel_bench.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include "cases/generators/generators.hpp"
#include "lbm/air.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/voxelize.hpp"
#include "tools/bench/machine.hpp"
#include "tools/bench/streams.hpp"

namespace puffin::bench {

namespace {

using Clock = std::chrono::steady_clock;
namespace geometry = lbm::geometry;
double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

const std::map<std::string, lbm::Law> laws{{"rr3", lbm::Law::rr3},
                                           {"bgk", lbm::Law::bgk},
                                           {"trt", lbm::Law::trt},
                                           {"central-moments", lbm::Law::central_moments}};

lbm::AirOptions options_of(const KernelSetting& s) {
  lbm::AirOptions options;
  options.law = laws.at(s.collision);
  options.wall = s.wall == "halfway" ? lbm::WallScheme::halfway : lbm::WallScheme::bouzidi;
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

}  // namespace

KernelRow measure_kernel(const KernelSetting& setting, double seconds, int repeats) {
  const auto begin = Clock::now();
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, setting.threads);
  lbm::Air air = setting.scene == "box" ? make_box(setting) : make_l_bend(setting);
  KernelRow row;
  row.setting = setting;
  row.cells = static_cast<std::int64_t>(air.rows.active_cells());
  lbm::CollisionConstants constants;
  constants.tau0 = 0.5003;
  lbm::Drive drive;
  drive.speed.assign(air.boundaries.size(), 0.0);
  drive.density_excess.assign(air.boundaries.size(), 0.0);
  for (std::size_t b = 0; b < air.boundaries.size(); ++b)
    if (air.boundaries[b].kind == lbm::BoundaryKind::velocity_inlet) drive.speed[b] = 0.05;
  const auto cells = static_cast<double>(air.rows.active_cells());
  const std::size_t bytes = setting.precision == "double" ? 8 : 4;
  BoundStream bound_stream(air.rows.active_cells(), bytes);
  CopyStream copy_stream(static_cast<std::size_t>(19.0 * cells) * bytes);
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
    lbm::collide_and_stream(constants, drive, air);
    const double bare = seconds_since(start);
    lbm::apply_links(drive, air);
    return bare;
  };
  for (int warm = 0; warm < 4; ++warm) whole_step();
  // What is compared is measured in turn, so that what disturbs one disturbs the other; medians over the turns.
  std::vector<double> complete, bare, bound, fraction, bare_fraction, copy, bound_over_copy;
  const ForeignLoad load;
  for (int r = 0; r < repeats; ++r) {
    bound.push_back(bound_stream.updates_per_second(seconds));
    complete.push_back(rate(whole_step) * cells);
    bare.push_back(rate(bare_step) * cells);
    copy.push_back(copy_stream.bandwidth(seconds));
    fraction.push_back(complete.back() / bound.back());
    bare_fraction.push_back(bare.back() / bound.back());
    bound_over_copy.push_back(bound.back() * 38.0 * static_cast<double>(bytes) / copy.back());
  }
  row.foreign_load = load.share();
  row.mlups = 1e-6 * median(complete);
  row.mlups_bare = 1e-6 * median(bare);
  row.bound_mlups = 1e-6 * median(bound);
  row.copy_bandwidth = median(copy);
  row.fraction_of_bound = median(fraction);
  row.bare_fraction_of_bound = median(bare_fraction);
  row.bound_over_copy = median(bound_over_copy);
  row.seconds = seconds_since(begin);
  return row;
}

std::vector<KernelRow> kernel_benchmark(bool quick, std::vector<double> sizes,
                                        const std::function<void(const KernelRow&)>& row_done) {
  const int all = oneapi::tbb::info::default_concurrency();
  std::vector<int> threads{1};
  if (all > 1) threads.push_back(2);
  if (all > 2) threads.push_back(all);
  std::vector<KernelRow> rows;
  const auto add = [&](const KernelSetting& s) {
    rows.push_back(measure_kernel(s, quick ? 0.06 : 0.15, quick ? 9 : 11));
    row_done(rows.back());
  };
  if (sizes.empty()) sizes = quick ? std::vector<double>{2.1e5} : std::vector<double>{2.1e5, 1e6, 4e6, 16e6};
  for (const double cells : sizes)
    for (const int t : threads) {
      for (const char* scene : {"box", "l-bend"})
        for (const char* collision : {"rr3", "bgk", "trt", "central-moments"})
          for (const char* precision : {"float", "double"}) {
            if (quick && (std::string(precision) == "double" || std::string(collision) != "rr3")) continue;
            add({scene, cells, t, collision, precision, "bouzidi"});
          }
      add({"box", cells, t, "rr3", "float", "none"});
      if (!quick) add({"l-bend", cells, t, "rr3", "float", "halfway"});
    }
  return rows;
}

}  // namespace puffin::bench
