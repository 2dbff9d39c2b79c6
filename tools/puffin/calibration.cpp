#include "tools/puffin/calibration.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <chrono>
#include <vector>

#include "cases/build.hpp"
#include "cases/generators/generators.hpp"
#include "lbm/air.hpp"

namespace puffin::tools {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

lbm::geometry::Voxels full_box(int n) {
  lbm::geometry::Voxels v;
  v.dx = 1.0;
  v.size = {n, n, n};
  v.fill([](int, int, int) { return true; });
  v.origin = lbm::geometry::Vec3(0.5, 0.5, 0.5);
  return v;
}

}  // namespace

Calibration calibrate(const cases::Numerics& n) {
  const int threads = n.threads > 0 ? n.threads : oneapi::tbb::info::default_concurrency();
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  constexpr int edge = 64;
  const lbm::geometry::TriangleMesh mesh =
      cases::generate("box", {{"x", double(edge)}, {"y", double(edge)}, {"z", double(edge)}});
  lbm::LinkGeometry surface;
  surface.mesh = &mesh;
  surface.patch_of_triangle = mesh.solid;
  for (std::size_t s = 0; s < mesh.solids.size(); ++s) {
    lbm::Boundary face;
    face.patch = mesh.solids[s];
    face.kind = lbm::BoundaryKind::periodic;
    surface.boundaries.push_back(face);
  }
  lbm::AirOptions options;
  options.law = cases::law_of(n.collision);
  options.double_precision = n.precision == cases::Precision::float64;
  options.smagorinsky = n.les == cases::Les::none ? 0.0 : n.smagorinsky_constant;
  options.eddy = n.les == cases::Les::vreman ? lbm::Eddy::vreman : lbm::Eddy::smagorinsky;
  options.hrr_sigma = n.hrr_sigma;
  lbm::Air air = lbm::make_air(full_box(edge), surface, options);
  lbm::CollisionConstants constants;
  constants.tau0 = 0.505;
  lbm::Drive drive;
  drive.speed.assign(surface.boundaries.size(), 0.0);
  drive.density_excess.assign(surface.boundaries.size(), 0.0);
  int steps = 0;
  Clock::time_point begin = Clock::now();
  for (bool warm = false; !warm || seconds_since(begin) < 0.8; ++steps) {
    lbm::advance_air(constants, drive, air);
    if (!warm && seconds_since(begin) > 0.2) {  // caches, pages and clock speed have settled
      warm = true;
      steps = 0;
      begin = Clock::now();
    }
  }
  return {static_cast<double>(steps) * edge * edge * edge / seconds_since(begin), threads};
}

double memory_bandwidth() {
  constexpr std::size_t n = std::size_t{1} << 24;  // three arrays of 128 MB
  std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  double best = 0.0;
  for (int repeat = 0; repeat < 4; ++repeat) {
    const Clock::time_point begin = Clock::now();
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, n), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) a[i] = b[i] + 0.5 * c[i];
    });
    best = std::max(best, 3.0 * sizeof(double) * n / seconds_since(begin));
  }
  return best;
}

}  // namespace puffin::tools
