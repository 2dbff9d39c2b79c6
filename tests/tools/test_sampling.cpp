// The samplers on fields that are laid into the cells, so that nothing but the reading can be wrong.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

#include "cases/read_case.hpp"
#include "lbm/geometry/stl.hpp"
#include "tools/puffin/sampling.hpp"

namespace puffin::test {
namespace {

using coupling::Vec3;
using lbm::geometry::TriangleMesh;

constexpr double cell = 1e-4;  // [m] edge of the cells of all scenes

std::unique_ptr<cases::Simulation> scene(const std::string& geometry, const std::string& boundaries) {
  return cases::build(cases::parse_case("schema = 1\nname = \"sampled\"\n" + geometry + boundaries + R"toml(
[numerics]
dx = "0.1 mm"
reference_speed = "1 m/s"
precision = "double"
[stop]
time = "1 ms"
)toml",
                                        "sampled.toml"));
}

std::string periodic(const std::string& patch, const std::string& with) {
  return "[[air.boundary]]\npatch = \"" + patch + "\"\ntype = \"periodic\"\nwith = \"" + with + "\"\n";
}

const std::string through = R"toml(
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
profile = "duct"
velocity = "1 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
)toml";

/// velocity [m/s] and pressure [Pa] at the cells' centres.
void lay(const std::function<Vec3(const Vec3&)>& velocity, const std::function<double(const Vec3&)>& pressure,
         cases::Simulation& s) {
  lbm::set_cells(
      [&](const Vec3& x) {
        const Vec3 u = velocity(x) / s.state.scale.speed();
        return lbm::InitialCell{s.state.scale.density_excess_lu(pressure(x)), {u[0], u[1], u[2]}, {}};
      },
      *s.state.air);
}

/// A pipe along x, three cells of it, periodic; its section is a polygon of chords of at most a fifth of a cell.
std::unique_ptr<cases::Simulation> pipe(double radius) {
  return scene("[geometry]\ngenerator = \"pipe\"\n[geometry.pipe]\ndiameter = " + std::to_string(2.0 * radius) +
                   "\nlength = \"0.3 mm\"\nfacet_size = \"0.02 mm\"\n",
               periodic("inlet", "outlet"));
}

double radial(const Vec3& x) { return std::hypot(x[1], x[2]); }

// u = G (R^2 - r^2), 1 m/s on the axis, and a pressure with a slope. What is read between cells follows a parabola
// exactly. On the wall's parabola the wall alone is wrong: its chords, c long, cut off u = G c^2/4 at most, which is
// taken for 0 with the weight (1 - a)(1 - a/2) of the wall, at most 1. Besides, what counts as eight whole cells may
// lack 1e-6. (Where a reading lacked one of its cells it was 2.1e-3, 2.7e-3 and 9.4e-3 m/s off, R = 10, 10.3, 6.2
// cells: up to a tenth of the speed there.)
TEST(PointReader, ReadsTheParabolaInAPipeUpToItsWall) {
  for (const double cells : {10.0, 10.3, 6.2}) {
    const double radius = cells * cell, chord = 0.2 * cell, g = 1.0 / (radius * radius);
    const auto s = pipe(radius);
    const auto speed = [&](const Vec3& x) { return 1.0 - g * radial(x) * radial(x); };
    const auto pressure = [&](const Vec3& x) { return (x[1] + 2.0 * x[2]) / radius; };
    lay([&](const Vec3& x) { return Vec3(speed(x), 0.0, 0.0); }, pressure, *s);
    const tools::PointReader reader(*s);
    for (int direction = 0; direction <= 30; ++direction)
      for (int n = 0; n <= 40; ++n) {
        const double r = (0.6 + 0.3999 * n / 40) * radius, angle = std::numbers::pi / 60.0 * direction;
        const Vec3 x(1.3 * cell, r * std::cos(angle), r * std::sin(angle));
        const auto reading = reader.read(*s, x);
        ASSERT_TRUE(reading) << r / cell << " cells, " << 3 * direction << " degrees";
        EXPECT_NEAR(reading->velocity[0], speed(x), 0.25 * g * chord * chord + 1e-6)
            << "R = " << cells << ": " << r / cell << " cells, " << 3 * direction << " degrees";
        EXPECT_NEAR(reading->pressure, pressure(x), 1e-4)  // 1e-6 of differences of 4 Pa, in 25 readings
            << "R = " << cells << ": " << r / cell << " cells, " << 3 * direction << " degrees";
      }
  }
}

// The farthest of the eight cells is nearer than sqrt(3) cells: up to there a point behind an oblique wall touches one.
TEST(PointReader, ReadsNothingBehindAPipe) {
  const auto s = pipe(10.0 * cell);
  const tools::PointReader reader(*s);
  for (int direction = 0; direction <= 30; ++direction)
    for (int n = 0; n <= 40; ++n) {
      const double r = (10.01 + 0.05 * n) * cell, angle = std::numbers::pi / 60.0 * direction;
      EXPECT_FALSE(reader.read(*s, Vec3(1.3 * cell, r * std::cos(angle), r * std::sin(angle))))
          << r / cell << " cells, " << 3 * direction << " degrees";
    }
}

/// A duct along x, three cells of it, between plates `gap` apart across `normal`; its section is a rectangle around the
/// axis, 14.4 cells long along the plates.
TriangleMesh inclined_duct(const Vec3& normal, double gap) {
  const Vec3 axis(3.0 * cell, 0.0, 0.0), along = Vec3::UnitX().cross(normal);
  const Vec3 n = 0.5 * gap * normal, t = 7.2 * cell * along;
  TriangleMesh mesh;
  mesh.solids = {"x-min", "x-max", "wall"};
  for (const Vec3& end : {Vec3(Vec3::Zero()), axis})
    for (const Vec3& corner : {Vec3(-n - t), Vec3(n - t), Vec3(n + t), Vec3(t - n)})
      mesh.vertices.push_back(end + corner);
  const auto add = [&](int a, int b, int c, int d, int solid) {  // counter-clockwise seen from outside
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
    mesh.solid.insert(mesh.solid.end(), 2, solid);
  };
  add(3, 2, 1, 0, 0);
  add(4, 5, 6, 7, 1);
  for (int k = 0; k < 4; ++k) add(k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4, 2);
  return mesh;
}

// Plane Poiseuille flow, 1 m/s in the middle, and a pressure with a slope: exact but for the nine digits of the STL
// file, 5e-9 cells of the wall's place, and for what counts as eight whole cells and may lack 1e-6 of u or p. (0.01 m/s
// where a reading lacked a cell.)
TEST(PointReader, ReadsTheParabolaBetweenInclinedPlatesUpToThem) {
  const auto file = std::filesystem::temp_directory_path() / "puffin-inclined-plates.stl";
  for (const double degrees : {45.0, 30.0}) {
    const double gap = 10.2 * cell, angle = degrees * std::numbers::pi / 180.0;
    const Vec3 normal(0.0, std::cos(angle), std::sin(angle)), along = Vec3::UnitX().cross(normal);
    lbm::geometry::write_stl(file.string(), inclined_duct(normal, gap), false, 1e-3);
    const auto s = scene("[geometry]\nstl = \"" + file.string() + "\"\nunit = \"mm\"\n", periodic("x-min", "x-max"));
    std::filesystem::remove(file);
    const auto place = [&](const Vec3& x) { return x.dot(normal) / gap; };  // -1/2 ... 1/2
    const auto speed = [&](const Vec3& x) { return 1.0 - 4.0 * place(x) * place(x); };
    lay([&](const Vec3& x) { return Vec3(speed(x), 0.0, 0.0); }, place, *s);
    const tools::PointReader reader(*s);
    for (const double beside : {-0.9, 0.1, 1.7})
      for (int n = 0; n <= 80; ++n) {
        const Vec3 x = Vec3(1.3 * cell, 0.0, 0.0) + (n / 80.0 - 0.5) * gap * normal + beside * cell * along;
        const auto reading = reader.read(*s, x);
        ASSERT_TRUE(reading) << degrees << " degrees, " << n;
        EXPECT_NEAR(reading->velocity[0], speed(x), 2e-6) << degrees << " degrees, " << n;
        EXPECT_NEAR(reading->pressure, place(x), 2e-6) << degrees << " degrees, " << n;
      }
  }
}

// Beside the edge of a step, where the edge is the nearest of the wall, along the straight line from there: exact, to
// rounding, for a speed that rises evenly from 0 at the edge. (Along the normal of one of the edge's faces it was that
// of another place: half as much on the diagonal.)
TEST(PointReader, ReadsAlongTheLineFromAnEdgeThatStandsOut) {
  const auto s = scene(R"toml(
[geometry]
generator = "step"
[geometry.step]
inlet_height = "0.6 mm"
step_height = "0.4 mm"
width = "0.3 mm"
inlet_length = "0.6 mm"
outlet_length = "0.8 mm"
periodic = true
)toml",
                       through + periodic("y-min", "y-max"));
  const auto speed = [](const Vec3& x) { return 0.1 * (x[0] + x[2] - 10.0 * cell) / cell; };
  lay([&](const Vec3& x) { return Vec3(speed(x), 0.0, 0.0); }, [](const Vec3&) { return 0.0; }, *s);
  const tools::PointReader reader(*s);
  for (const double behind : {0.1, 0.25, 0.4})
    for (const double above : {0.1, 0.25, 0.4}) {
      const Vec3 x((6.0 + behind) * cell, 1.3 * cell, (4.0 + above) * cell);
      const auto reading = reader.read(*s, x);
      ASSERT_TRUE(reading);
      EXPECT_NEAR(reading->velocity[0], speed(x), 1e-11) << behind << ' ' << above;
    }
}

/// A duct of 10 x 8 x 6 cells along x.
std::unique_ptr<cases::Simulation> duct(const std::string& boundaries) {
  return scene(
      "[geometry]\ngenerator = \"duct\"\n[geometry.duct]\nlength = \"1 mm\"\nwidth = \"0.8 mm\"\nheight = \"0.6 mm\"\n",
      boundaries);
}
// 1 m/s in every cell. At the rim the wall's 0 is read, but for the rounding of places, 1e-12 cells; from the middle of
// the openings, more than a cell from the walls, what the cells before them hold.
TEST(PointReader, ReadsTheWallsSpeedAtTheRimsOfOpenings) {
  const auto s = duct(through);
  lay([](const Vec3&) { return Vec3(1.0, 0.0, 0.0); }, [](const Vec3&) { return 0.0; }, *s);
  const tools::PointReader reader(*s);
  for (const double x : {0.0, 10.0 * cell})
    for (int n = 0; n <= 40; ++n) {
      const double y = 8.0 * cell * n / 40, z = 6.0 * cell * n / 40;
      for (const Vec3& rim : {Vec3(x, y, 0.0), Vec3(x, y, 6.0 * cell), Vec3(x, 0.0, z), Vec3(x, 8.0 * cell, z)}) {
        const auto reading = reader.read(*s, rim);
        ASSERT_TRUE(reading) << rim.transpose();
        EXPECT_NEAR(reading->velocity[0], 0.0, 1e-11) << rim.transpose() / cell;
      }
      const auto middle = reader.read(*s, Vec3(x, 2.0 * cell + 0.5 * y, 3.0 * cell));
      ASSERT_TRUE(middle);
      EXPECT_NEAR(middle->velocity[0], 1.0, 1e-12);
    }
}

// A pressure that falls by 3 Pa evenly, at 2 m/s: rounding of numbers near 100 Pa, the unit of the lattice, in sums of
// 48 cells and 19 populations. Read from the nearest layer the planes of the openings were 0.15 Pa off.
TEST(ReadPlane, GoesOnWithThePressuresSlopeToTheOpenings) {
  const auto s = duct(through);
  const auto pressure = [](double x) { return 3.0 - 3.0 * x / (10.0 * cell); };
  lay([](const Vec3&) { return Vec3(2.0, 0.0, 0.0); }, [&](const Vec3& x) { return pressure(x[0]); }, *s);
  const double head = 0.5 * s->models.air.density * 4.0;
  for (const double x : {0.0, 0.2, 0.5, 3.3, 9.5, 9.7, 10.0}) {
    const auto reading = tools::read_plane(*s, 0, x * cell);
    ASSERT_TRUE(reading) << x;
    EXPECT_NEAR(reading->static_pressure, pressure(x * cell), 1e-10) << x;
    EXPECT_NEAR(reading->total_pressure, pressure(x * cell) + head, 1e-10) << x;
  }
}

// Half-way between the first and the last of 10 layers: -4.5 and 4.5 tenths of a pascal from the middle. No end, so no
// slope to go on with.
TEST(ReadPlane, LiesBetweenTheFirstAndTheLastLayerInAPeriodicFace) {
  const auto s = duct(periodic("inlet", "outlet"));
  lay([](const Vec3&) { return Vec3(2.0, 0.0, 0.0); }, [](const Vec3& x) { return x[0] / (10.0 * cell); }, *s);
  for (const double x : {0.0, 10.0}) {
    const auto reading = tools::read_plane(*s, 0, x * cell);
    ASSERT_TRUE(reading) << x;
    EXPECT_NEAR(reading->static_pressure, 0.5, 1e-10) << x;
  }
}

}  // namespace
}  // namespace puffin::test
