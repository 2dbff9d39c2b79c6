// The zoo: a clean surface and every way in which exports are damaged, written to a file, read back, checked, mended.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <random>

#include "lbm/geometry/repair.hpp"
#include "lbm/geometry/stl.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/voxelize.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

// 30 mm long, turned so that no facet lies along an axis; facets of 2 mm.
TriangleMesh healthy() {
  return shapes::transformed(shapes::box({0, 0, 0}, {0.03, 0.01, 0.008}, 5), shapes::rotation(), {0.01, -0.02, 0.003});
}

struct Animal {
  const char* name;
  const char* kind;  // of the defect that must be found; "" for none
  bool refused;      // a fatal defect as it is
  bool mended;       // --repair makes it acceptable, with the healthy volume
  std::function<void(TriangleMesh&)> damage;
};

void own_corners(TriangleMesh& m, double jitter) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-jitter, jitter);
  TriangleMesh soup = m;
  soup.vertices.clear();
  for (auto& t : soup.triangles)
    for (int& v : t) {
      soup.vertices.push_back(m.vertices[v] + Vec3(unit(random), unit(random), unit(random)));
      v = static_cast<int>(soup.vertices.size()) - 1;
    }
  m = soup;
}

void add_facet(TriangleMesh& m, const std::array<int, 3>& t) {
  m.triangles.push_back(t);
  m.solid.push_back(m.solid[0]);
}

const std::vector<Animal>& zoo() {
  static const std::vector<Animal> animals{
      {"healthy", "", false, true, [](TriangleMesh&) {}},
      {"own-corners", "", false, true, [](TriangleMesh& m) { own_corners(m, 0.0); }},
      {"own-corners-within-the-tolerance", "", false, true, [](TriangleMesh& m) { own_corners(m, 4e-10); }},
      {"missing-facet", "hole", true, true, [](TriangleMesh& m) { shapes::remove_triangle(m, 120); }},
      {"missing-cap", "hole", true, false,
       [](TriangleMesh& m) {
         for (int t = static_cast<int>(m.triangles.size()) - 1; t >= 0; --t)
           if (m.solids[m.solid[t]] == "x-max") shapes::remove_triangle(m, t);
       }},
      {"turned-facets", "inconsistent orientation", true, true,
       [](TriangleMesh& m) {
         for (const int t : {7, 8, 90, 200}) std::swap(m.triangles[t][0], m.triangles[t][1]);
       }},
      {"inside-out", "inside out", true, true, [](TriangleMesh& m) { m = shapes::turned(m); }},
      {"copies", "duplicate facet", true, true,
       [](TriangleMesh& m) {
         for (const int t : {3, 50, 250}) add_facet(m, m.triangles[t]);
       }},
      {"whole-surface-twice", "duplicate facet", true, true,
       [](TriangleMesh& m) {
         const auto all = m.triangles;
         for (const auto& t : all) add_facet(m, t);
       }},
      {"facets-without-area", "degenerate facet", false, true,
       [](TriangleMesh& m) {
         add_facet(m, {m.triangles[4][0], m.triangles[4][1], m.triangles[4][0]});
       }},
      {"fin", "non-manifold edge", true, false,
       [](TriangleMesh& m) {
         m.vertices.push_back(m.corner(0, 0) + 0.5 * m.area_vector(0).normalized() * 0.002);
         add_facet(m, {m.triangles[0][0], m.triangles[0][1], static_cast<int>(m.vertices.size()) - 1});
       }},
      {"crossing-bodies", "self-intersection", false, false,
       [](TriangleMesh& m) {
         m = shapes::joined(m, shapes::transformed(m, Eigen::Matrix3d::Identity(), {0.004, 0.003, 0.002}));
       }},
      {"separate-part", "disconnected part", false, false,
       [](TriangleMesh& m) {
         m = shapes::joined(m, shapes::sphere(0.002, 6, {0.1, 0, 0}));
       }},
      {"body-in-the-flow", "nested shell", false, false,
       [](TriangleMesh& m) {
         const Vec3 middle = shapes::rotation() * Vec3(0.015, 0.005, 0.004) + Vec3(0.01, -0.02, 0.003);
         m = shapes::joined(m, shapes::turned(shapes::sphere(0.002, 6, middle)));
       }},
      {"body-of-fluid-in-the-fluid", "nested shell", true, false,
       [](TriangleMesh& m) {
         const Vec3 middle = shapes::rotation() * Vec3(0.015, 0.005, 0.004) + Vec3(0.01, -0.02, 0.003);
         m = shapes::joined(m, shapes::sphere(0.002, 6, middle));
       }},
      {"plate-from-wall-to-wall", "nested shell", false, false,
       [](TriangleMesh& m) {
         const TriangleMesh plate = shapes::turned(shapes::box({0.012, 0, 0}, {0.0121, 0.01, 0.006}));
         m = shapes::joined(m, shapes::transformed(plate, shapes::rotation(), {0.01, -0.02, 0.003}));
       }},
      {"finer-on-one-side-of-an-edge", "hole", true, true,
       [](TriangleMesh& m) {
         // Three corners on an edge of one triangle, none on that of its neighbour; and the next triangle's as well.
         for (const int t : {40, 41}) {
           const auto whole = m.triangles[t];
           int from = whole[0];
           for (const double at : {0.2, 0.5, 0.9}) {
             m.vertices.push_back(m.vertices[whole[0]] + at * (m.vertices[whole[1]] - m.vertices[whole[0]]));
             const int to = static_cast<int>(m.vertices.size()) - 1;
             add_facet(m, {from, to, whole[2]});
             from = to;
           }
           m.triangles[t] = {from, whole[1], whole[2]};
         }
       }},
      {"metres-as-millimetres", "suspicious size", false, false,
       [](TriangleMesh& m) {
         for (auto& v : m.vertices) v *= 1e-3;
       }},
      {"far-from-the-origin", "coarse coordinates", false, false,
       [](TriangleMesh& m) {
         for (auto& v : m.vertices) v += Vec3(100.0, 0.0, 0.0);
       }},
  };
  return animals;
}

class Zoo : public ::testing::TestWithParam<Animal> {
 protected:
  // Written in millimetres as a user's file, and read.
  static TriangleMesh through_a_file(const TriangleMesh& mesh, bool binary) {
    const auto file = std::filesystem::temp_directory_path() / ("puffin-zoo-" + std::to_string(::getpid()) + ".stl");
    write_stl(file.string(), mesh, binary, 1e-3);
    TriangleMesh read = read_stl(file.string(), 1e-3);
    std::filesystem::remove(file);
    return read;
  }
};

TEST_P(Zoo, IsDescribedRightAndMendedIfItCanBe) {
  const Animal& animal = GetParam();
  TriangleMesh damaged = healthy();
  animal.damage(damaged);
  for (const bool binary : {false, true}) {
    TriangleMesh mesh = through_a_file(damaged, binary);
    const auto defects = check_surface(mesh);
    const auto named =
        std::find_if(defects.begin(), defects.end(), [&](const Defect& d) { return d.kind == animal.kind; });
    if (*animal.kind == '\0') {
      EXPECT_TRUE(defects.empty()) << defects[0].kind;
    } else {
      ASSERT_NE(named, defects.end());
      EXPECT_FALSE(named->where.empty());
      EXPECT_EQ(named->where.size(), std::min(named->count, Defect::places));
    }
    const auto fatal = [](const std::vector<Defect>& list) {
      return std::any_of(list.begin(), list.end(), [](const Defect& d) { return d.fatal; });
    };
    EXPECT_EQ(fatal(defects), animal.refused);
    repair(mesh);
    const auto left = check_surface(mesh);
    if (animal.mended) {
      EXPECT_TRUE(left.empty()) << left[0].kind << ": " << left[0].message;
      // Single precision moves corners by 6e-8 of 0.03 m: 1e-6 of the volume is ample.
      EXPECT_NEAR(enclosed_volume(mesh) / (0.03 * 0.01 * 0.008), 1.0, 1e-6);
    } else {
      EXPECT_FALSE(left.empty());  // what cannot be mended is still named
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Animals, Zoo, ::testing::ValuesIn(zoo()), [](const auto& animal) {
  std::string name = animal.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// Property: what a point is does not depend on how the surface lies in space.
TEST(Classification, IsTheSameForTurnedMirroredAndShiftedCopies) {
  const TriangleMesh mesh = shapes::torus(0.02, 0.007, 31, 17);
  const TriangleTree tree(mesh);
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(-0.028, 0.028);
  for (int copy = 0; copy < 12; ++copy) {
    Eigen::Matrix3d turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                               .normalized()
                               .toRotationMatrix();
    if (copy % 2 == 1) turn.col(0) *= -1.0;  // mirrored
    const Vec3 shift(normal(random), normal(random), normal(random));
    const TriangleTree moved(shapes::transformed(mesh, turn, shift));
    int compared = 0;
    for (int n = 0; n < 500; ++n) {
      const Vec3 p(unit(random), unit(random), 0.3 * unit(random));
      if (tree.closest(p).distance < 1e-9) continue;  // on the surface, within the rounding of the move
      ++compared;
      ASSERT_EQ(tree.inside(p), moved.inside(turn * p + shift)) << copy;
    }
    EXPECT_GT(compared, 490);
  }
}

}  // namespace
}  // namespace puffin::lbm::geometry
