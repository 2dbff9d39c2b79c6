// Samples of wall triangles, from which the markers of an immersed boundary are chosen.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lbm/marker_samples.hpp"
#include "tests/lbm/box_scene.hpp"

using namespace puffin::lbm;
using namespace puffin::lbm::test;
using geometry::Vec3;

namespace {

using Triangle = std::array<Vec3, 3>;

double area_of(const Triangle& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }

struct Samples {
  std::vector<Vec3> places;
  double area = 0.0;
};

Samples samples_of(const Triangle& t, double apart) {
  Samples s;
  sample_triangle(t, area_of(t), apart, [&](const Vec3& x, double area) {
    s.places.push_back(x);
    s.area += area;
  });
  return s;
}

TEST(MarkerSamples, TheirNumberGoesWithTheAreaHoweverLongTheTriangle) {
  const double apart = 0.5;
  for (const double length : {10.0, 100.0, 1000.0})
    for (const double height : {2.0, 0.3, 0.01}) {
      const Triangle t{Vec3(0, 0, 0), Vec3(length, 0, 0), Vec3(0.9 * length, 0, height)};
      const Samples s = samples_of(t, apart);
      // At most four times the height long: (side/apart + 1)^2 <= 4 side^2/apart^2, and side^2 <= 8 area. Longer:
      // slices and rows one more than their length and height in `apart`, and two halves of that.
      EXPECT_LE(static_cast<double>(s.places.size()), 32.0 * area_of(t) / (apart * apart) + 1.5 * length / apart + 2.0);
      EXPECT_NEAR(s.area, area_of(t), 1e-12 * area_of(t));
    }
}

TEST(MarkerSamples, NoPlaceOfALongTriangleIsFarFromOne) {
  const double apart = 0.5;
  const Triangle t{Vec3(0, 0, 0), Vec3(40, 0, 0), Vec3(31, 0, 1.3)};
  const Samples s = samples_of(t, apart);
  for (int i = 0; i <= 80; ++i)
    for (int j = 0; i + j <= 80; ++j) {
      const Vec3 x = t[0] + i / 80.0 * (t[1] - t[0]) + j / 80.0 * (t[2] - t[0]);
      double least = 1e9;
      for (const Vec3& y : s.places) least = std::min(least, (x - y).norm());
      EXPECT_LE(least, apart);
    }
}

TEST(MarkerSamples, WellShapedTrianglesAreDividedEvenly) {
  const Triangle t{Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(0, 5, 0)};
  EXPECT_EQ(samples_of(t, 0.5).places.size(), 225u);  // the longest side in ceil(7.07/0.5) = 15 parts
}

TEST(MarkerSamples, MarkersHoldTheWholeAreaOfTheWalls) {
  BoxScene scene = make_box(Vec3(30, 2, 0.4), 1.0, {wall(), wall(), wall(), wall(), wall(), wall()});
  scene.surface.mesh = &scene.mesh;
  double area = 0.0;
  const auto markers = spread_markers(scene.surface, 1.3);
  for (const SurfaceMarker& m : markers) area += m.area;
  EXPECT_NEAR(area, 2 * (30 * 2 + 30 * 0.4 + 2 * 0.4), 1e-10);
}

}  // namespace
