// Measures walls; a program, not a test: `measure_walls channel|gap key=value ...` prints one line of CSV.
//
// channel  laminar plane channel along x, turned by `angle` degrees, parabolic inlet, pressure outlet: displacement of
//          the walls in cells, positive outwards, from the flow rate and the pressure gradient.
// gap      plane sudden contraction and expansion at nu = 1e-4 with the default eddy viscosity, `height` cells high and
//          `below` cells above the floor: pressure lost to the gap and through it over rho/2 u_gap^2 of the true gap.
// Results: docs/results/walls/, docs/decisions/0007-walls.md.

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>

#include "lbm/air.hpp"
#include "lbm/geometry/voxelize.hpp"

using namespace puffin::lbm;
using geometry::Vec3;

namespace {

std::map<std::string, std::string> given;
double number(const std::string& key, double otherwise) {
  return given.contains(key) ? std::stod(given.at(key)) : otherwise;
}
std::string word(const std::string& key, const std::string& otherwise) {
  return given.contains(key) ? given.at(key) : otherwise;
}

/// Blocks between the given planes, one block deep along z; solids inlet (x-min), outlet (x-max), wall, back and front.
template <class Filled>
geometry::TriangleMesh blocks(const std::vector<double>& x, const std::vector<double>& y, double depth,
                              const Eigen::Matrix3d& turn, const Filled& filled) {
  geometry::TriangleMesh mesh;
  mesh.solids = {"inlet", "outlet", "wall", "back", "front"};
  std::map<std::array<int, 3>, int> known;
  const auto vertex = [&](int i, int j, int k) {
    const auto [at, fresh] = known.emplace(std::array{i, j, k}, static_cast<int>(mesh.vertices.size()));
    if (fresh) mesh.vertices.push_back(turn * Vec3(x[i], y[j], k * depth));
    return at->second;
  };
  const auto quad = [&](int a, int b, int c, int d, int solid) {
    for (const auto& t : {std::array{a, b, c}, std::array{a, c, d}}) {
      mesh.triangles.push_back(t);
      mesh.solid.push_back(solid);
    }
  };
  const int nx = static_cast<int>(x.size()) - 1, ny = static_cast<int>(y.size()) - 1;
  const auto in = [&](int i, int j) { return i >= 0 && j >= 0 && i < nx && j < ny && filled(i, j); };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      if (!in(i, j)) continue;
      int v[8];
      for (int n = 0; n < 8; ++n) v[n] = vertex(i + (n & 1), j + (n >> 1 & 1), n >> 2);
      if (!in(i - 1, j)) quad(v[0], v[4], v[6], v[2], i == 0 ? 0 : 2);
      if (!in(i + 1, j)) quad(v[1], v[3], v[7], v[5], i + 1 == nx ? 1 : 2);
      if (!in(i, j - 1)) quad(v[0], v[1], v[5], v[4], 2);
      if (!in(i, j + 1)) quad(v[2], v[6], v[7], v[3], 2);
      quad(v[0], v[2], v[3], v[1], 3);
      quad(v[4], v[5], v[7], v[6], 4);
    }
  return mesh;
}

/// Flow and mean pressure around a section: weighted with a cosine window of eight cells.
struct Section {
  double flow = 0.0, pressure = 0.0;
};
Section section(const Air& air, const Vec3& along, double at) {
  constexpr double half = 4.0;
  Section s;
  double weights = 0.0;
  for (const Run& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const double d = air.rows.centre(run.first + n).dot(along) - at;
      if (std::abs(d) >= half) continue;
      const double w = 0.5 * (1.0 + std::cos(std::numbers::pi * d / half)) / half;
      const auto m = moments_at(air, run.first + n);
      s.flow += w * (1.0 + m.density_excess) * Vec3(m.ux, m.uy, m.uz).dot(along);
      if (!air.is_fluid(run.first + n)) continue;
      s.pressure += w * m.density_excess / 3.0;
      weights += w;
    }
  s.pressure /= weights;
  return s;
}

/// Mean over eight batches and the half width of its 95 % interval.
std::pair<double, double> mean_of(const std::vector<double>& values) {
  constexpr int batches = 8;
  std::vector<double> batch(batches, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k)
    batch[k * batches / values.size()] += values[k] * batches / static_cast<double>(values.size());
  double mean = 0.0, spread = 0.0;
  for (const double b : batch) mean += b / batches;
  for (const double b : batch) spread += (b - mean) * (b - mean) / (batches - 1);
  return {mean, 2.36 * std::sqrt(spread / batches)};  // Student's t, 7 degrees of freedom
}

}  // namespace

int main(int count, char** arguments) {
  const std::string scene = count > 1 ? arguments[1] : "";
  if (scene != "channel" && scene != "gap") return std::puts("measure_walls channel|gap key=value ..."), 2;
  for (int n = 2; n < count; ++n) {
    const std::string a = arguments[n];
    given[a.substr(0, a.find('='))] = a.substr(a.find('=') + 1);
  }
  const bool channel = scene == "channel";
  const double angle = number("angle", 0.0) * std::numbers::pi / 180.0, height = number("height", 10.0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 along = turn.col(0), across = turn.col(1);
  const double below = number("below", 10.0), wide = channel ? height : 30.0, depth = channel ? 4.0 : 1.0;
  const std::vector<double> x = channel ? std::vector{0.0, 40.0} : std::vector{0.0, 50.0, 80.0, 150.0};
  const std::vector<double> y = channel ? std::vector{0.0, height} : std::vector{0.0, below, below + height, wide};
  const auto mesh = std::make_shared<geometry::TriangleMesh>(
      blocks(x, y, depth, turn, [&](int i, int j) { return channel || i != 1 || j == 1; }));

  LinkGeometry surface;
  surface.mesh = mesh.get();
  surface.patch_of_triangle = mesh->solid;
  Boundary inlet{"inlet", BoundaryKind::velocity_inlet, {}, true};
  inlet.profile = [=](const Vec3& at) -> Vec3 {
    const double s = at.dot(across) / wide;
    return (channel ? 6.0 * s * (1.0 - s) : std::clamp(8.0 * std::min(s, 1.0 - s), 0.0, 1.0)) * along;
  };
  surface.boundaries = {inlet,
                        {"outlet", BoundaryKind::pressure_outlet, {}},
                        {"wall", BoundaryKind::wall, {}},
                        {"back", BoundaryKind::periodic, {}},
                        {"front", BoundaryKind::periodic, {}}};
  const std::map<std::string, WallScheme> schemes{{"bouzidi", WallScheme::bouzidi},
                                                  {"halfway", WallScheme::halfway},
                                                  {"ibm", WallScheme::ibm},
                                                  {"psm", WallScheme::psm}};
  AirOptions options;
  options.wall = schemes.at(word("wall", "bouzidi"));
  options.wall_model = number("wall_model", 0) > 0;
  options.markers.retraction = number("retraction", options.markers.retraction);
  if (channel) options.smagorinsky = 0.0;
  if (!channel) options.sponge_length = 20.0;
  Air air =
      make_air(geometry::voxelize(geometry::TriangleTree(mesh), 1.0, {{false, false, true}, {}, {}}), surface, options);

  const double tau = channel ? number("tau", 0.6) : 0.5 + 3.0 * number("nu", 1e-4), nu = (tau - 0.5) / 3.0;
  const double speed = channel ? 0.02 : 0.15 * height / wide;
  const double at[3] = {channel ? 12.0 : 25.0, channel ? 28.0 : 72.5, channel ? 28.0 : 118.5};
  const int steps = static_cast<int>(number("steps", channel ? 8.0 * height * height / nu / 9.87 + 6000.0 : 16000.0));
  Drive drive;
  drive.speed.assign(5, 0.0);
  drive.density_excess.assign(5, 0.0);
  std::vector<double> flow[3], first, second;
  for (int t = 0; t < steps; ++t) {
    drive.speed[0] = speed * std::min(1.0, (t + 1) / 1000.0);
    const KernelReport report = collide_and_stream({.tau0 = tau}, drive, air);
    apply_links(drive, air);
    if (report.bad) return std::printf("diverged at step %d\n", t), 1;
    if (t < (channel ? steps / 2 : steps / 3) || t % 25 != 0) continue;
    Section s[3];
    for (int k = 0; k < 3; ++k) flow[k].push_back((s[k] = section(air, along, at[k])).flow);
    first.push_back(s[0].pressure - s[1].pressure);
    second.push_back(s[0].pressure - s[2].pressure);
  }
  const double rate = mean_of(flow[0]).first / depth, kept = mean_of(flow[1]).first / mean_of(flow[0]).first;
  const auto [drop, error] = mean_of(first);
  std::printf("%s,%s,%g,%g,%g,%g,", scene.c_str(), word("wall", "bouzidi").c_str(), tau, number("angle", 0.0), height,
              options.markers.retraction);
  if (channel) {
    const double acts = std::cbrt(12.0 * nu * rate * (at[1] - at[0]) / drop);
    std::printf("%.4f,%.5f\n", 0.5 * (acts - height), kept);
  } else {
    const double head = 0.5 * std::pow(rate / height, 2);
    const auto [through, error2] = mean_of(second);
    std::printf("%g,%.3f,%.3f,%.3f,%.3f,%.5f,%lld\n", below, drop / head, error / head, through / head, error2 / head,
                kept, static_cast<long long>(air.limited));
  }
  return 0;
}
