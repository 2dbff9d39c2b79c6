#include "tools/bench/geometry_bench.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "lbm/geometry/signed_distance.hpp"
#include "lbm/geometry/solid_fraction.hpp"
#include "lbm/geometry/stl.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/voxelize.hpp"
#include "tools/bench/machine.hpp"
#include "tools/bench/vtk_distance.hpp"

namespace puffin::bench {
namespace {

namespace geometry = lbm::geometry;
using geometry::Vec3;

/// Ring 10 mm, tube 3 mm with waves of a tenth along and around it: no facet lies along an axis.
geometry::TriangleMesh wavy_torus(int around, int across) {
  geometry::TriangleMesh mesh;
  mesh.solids = {"wall"};
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2.0 * std::numbers::pi * i / around, b = 2.0 * std::numbers::pi * j / across;
      const double tube = 3e-3 * (1.0 + 0.1 * std::sin(9.0 * a) * std::cos(4.0 * b)), r = 10e-3 + tube * std::cos(b);
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), tube * std::sin(b));
    }
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  mesh.solid.assign(mesh.triangles.size(), 0);
  return mesh;
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

template <class Work>
double seconds_of(Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Points at most `reach` from random places of the surface (`at_corners`: from random corners of triangles), or
/// anywhere in the bounding box.
std::vector<Vec3> random_points(const geometry::TriangleTree& tree, std::size_t count, double reach,
                                bool at_corners = false) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<int> triangle(0, static_cast<int>(tree.mesh().triangles.size()) - 1);
  std::vector<Vec3> points;
  for (std::size_t n = 0; n < count; ++n) {
    const Vec3 share(unit(random), unit(random), unit(random));
    if (reach > 0.0) {
      const int t = triangle(random);
      const Vec3 &a = tree.mesh().corner(t, 0), &b = tree.mesh().corner(t, 1), &c = tree.mesh().corner(t, 2);
      double u = unit(random), v = unit(random);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const Vec3 place = at_corners ? a : Vec3(a + u * (b - a) + v * (c - a));
      points.push_back(place + reach * (2.0 * unit(random) - 1.0) * Vec3(share - Vec3::Constant(0.5)).normalized());
    } else {
      points.push_back(tree.min() + share.cwiseProduct(tree.max() - tree.min()));
    }
  }
  return points;
}

class Measurement {
 public:
  /// 4 across^2 triangles.
  Measurement(int across, bool quick, const std::function<void(const GeometryRow&)>& done)
      : done_(done), queries_(quick ? 100'000 : 1'000'000), compared_(quick ? 5'000 : 20'000) {
    row_.threads = oneapi::tbb::info::default_concurrency();
    mesh_ = wavy_torus(2 * across, across);
    row_.triangles = static_cast<long long>(mesh_.triangles.size());
    dx_ = std::cbrt(geometry::enclosed_volume(mesh_) / (quick ? 1e6 : 1e7));
    file_ = std::filesystem::temp_directory_path() / ("puffin-bench-" + std::to_string(::getpid()) + ".stl");
  }
  ~Measurement() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  Measurement(const Measurement&) = delete;
  Measurement& operator=(const Measurement&) = delete;

  void from_file_to_cells() {
    geometry::write_stl(file_.string(), mesh_, true);
    mesh_ = {};
    timed("read", row_.triangles, [&] { mesh_ = geometry::read_stl(file_.string()); });
    timed("check", row_.triangles, [&] { geometry::check_surface(mesh_); });
    timed("tree", row_.triangles, [&] { build_tree(); });
    geometry::Voxels voxels;
    const double seconds = seconds_of([&] { voxels = geometry::voxelize(*tree_, dx_); });
    report("voxelize", static_cast<long long>(voxels.cells()), seconds);
    std::vector<geometry::CutCell> cut;
    const double cutting = seconds_of([&] { cut = geometry::cut_cells(*tree_, voxels); });
    report("cut-cells", static_cast<long long>(cut.size()), cutting);
  }

  void build_tree() { tree_ = std::make_shared<geometry::TriangleTree>(std::move(mesh_)); }

  void distances() {
    std::unique_ptr<geometry::SignedDistance> distance;
    timed("signed-distance-setup", row_.triangles,
          [&] { distance = std::make_unique<geometry::SignedDistance>(tree_); });
    const VtkDistance vtk(tree_->mesh());
    for (const std::string where : {"band", "box"}) {
      row_.where = where;
      const std::vector<Vec3> points = random_points(*tree_, queries_, where == "band" ? 4.0 * dx_ : 0.0);
      std::vector<double> theirs(compared_);
      const double vtk_seconds = seconds_of([&] {
        for (std::size_t n = 0; n < compared_; ++n) theirs[n] = vtk(points[n]);
      });
      std::vector<double> ours(points.size());
      for (const int threads : {1, oneapi::tbb::info::default_concurrency()}) {
        GeometryRow row = row_;
        row.threads = threads;
        row.vtk_per_second = static_cast<double>(compared_) / vtk_seconds;
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        row.seconds = seconds_of([&] { ours = distance->at(points); });
        for (std::size_t n = 0; n < compared_; ++n) {
          const bool same_side = (ours[n] > 0.0) == (theirs[n] > 0.0);
          row.difference = std::max(row.difference, std::abs(std::abs(ours[n]) - std::abs(theirs[n])) / dx_);
          row.other_side += !same_side && std::abs(ours[n]) > 1e-6 * dx_;
        }
        finish(row, "signed-distance", static_cast<long long>(points.size()));
      }
    }
    row_.where.clear();
  }

  void queries() {
    row_.where = "band";
    const std::vector<Vec3> points = random_points(*tree_, queries_, 4.0 * dx_);
    const auto each = [&](const std::string& what, auto&& ask) {
      timed(what, static_cast<long long>(points.size()), [&] { for_all(points, ask); });
    };
    std::vector<double> answer(points.size());
    each("winding-number", [&](std::size_t n) { answer[n] = tree_->winding_number(points[n]); });
    each("link", [&](std::size_t n) {
      const auto hit = tree_->first_hit(points[n], dx_ * Vec3(n % 3 - 1.0, n / 3 % 3 - 1.0, 1.0), 1.0);
      answer[n] = hit ? hit->t : -1.0;
    });
    contacts(*tree_, false);
    const geometry::TriangleTree device(wavy_torus(100, 50));  // as fine as a device is exported
    contacts(device, false);
    contacts(device, true);  // the worst places: six facets each
    row_.where.clear();
  }

 private:
  /// Carriers of 35 um radius that look 2 um beyond it for walls, at most that far from them, at random places.
  void contacts(const geometry::TriangleTree& tree, bool at_corners) {
    constexpr double reach = 37e-6;
    const std::vector<Vec3> points = random_points(tree, queries_, reach, at_corners);
    std::vector<std::size_t> touches(points.size());
    const double seconds = seconds_of([&] {
      for_all(points, [&](std::size_t n) {
        thread_local std::vector<geometry::Feature> features;
        features.clear();
        tree.near_features(points[n], reach, nullptr, features, geometry::Side::inner);
        touches[n] = features.size();
      });
    });
    GeometryRow row = row_;
    row.where = at_corners ? "corners" : "band";
    row.triangles = static_cast<long long>(tree.mesh().triangles.size());
    row.seconds = seconds;
    finish(row, "contact", static_cast<long long>(points.size()));
  }

  template <class Ask>
  static void for_all(const std::vector<Vec3>& points, Ask&& ask) {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, points.size(), 1024), [&](const auto& r) {
      for (std::size_t n = r.begin(); n < r.end(); ++n) ask(n);
    });
  }

  void finish(GeometryRow row, const std::string& what, long long count) {
    row.what = what;
    row.count = count;
    row.per_second = static_cast<double>(count) / row.seconds;
    if (row.vtk_per_second > 0.0) row.ratio = row.per_second / row.vtk_per_second;
    row.memory = peak_memory();
    row.foreign_load = foreign_.share();
    foreign_ = ForeignLoad();
    done_(row);
  }
  void report(const std::string& what, long long count, double seconds) {
    GeometryRow row = row_;
    row.seconds = seconds;
    finish(row, what, count);
  }
  template <class Work>
  void timed(const std::string& what, long long count, Work&& work) {
    report(what, count, seconds_of(work));
  }

  const std::function<void(const GeometryRow&)>& done_;
  std::size_t queries_, compared_;
  double dx_ = 0.0;
  std::filesystem::path file_;
  geometry::TriangleMesh mesh_;
  std::shared_ptr<const geometry::TriangleTree> tree_;
  GeometryRow row_;
  ForeignLoad foreign_;
};

}  // namespace

void geometry_benchmark(bool quick, const std::function<void(const GeometryRow&)>& done) {
  // The largest first: the peak of the memory is its own.
  Measurement largest(quick ? 160 : 500, quick, done);
  largest.from_file_to_cells();
  largest.queries();
  largest.distances();
  for (const int across : {158, 50}) {
    if (quick && across > 100) continue;
    Measurement smaller(across, quick, done);
    smaller.build_tree();
    smaller.distances();
  }
}

}  // namespace puffin::bench
