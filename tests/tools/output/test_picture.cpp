#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <set>

#include "tests/tools/output/scratch.hpp"
#include "tests/tools/output/synthetic_run.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/picture/decorations.hpp"
#include "tools/output/picture/scene.hpp"
#include "tools/output/picture/views.hpp"
#include "tools/output/picture/wall_shape.hpp"
#include "tools/output/render.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

constexpr Box all{0, 0, 60, 60};

/// Looks down the z axis: one unit of length is ten pixels, the origin is at the lower left.
Camera from_above() {
  Camera camera;
  camera.right = Vec3::UnitX(), camera.up = Vec3::UnitY(), camera.towards_eye = Vec3::UnitZ();
  camera.scale = 10, camera.centre_x = 0, camera.centre_y = 60;
  return camera;
}

/// The square [0,6]^2 at height z, as two triangles that share the diagonal.
void add_square(Scene& scene, double z, const Colour& colour, float opacity) {
  const Vec3 a(0, 0, z), b(6, 0, z), c(6, 6, z), d(0, 6, z);
  scene.triangles.push_back({a, b, c, colour, opacity});
  scene.triangles.push_back({a, c, d, colour, opacity});
}

std::size_t colours_in(const Canvas& canvas) {
  std::set<int> seen;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      const std::uint8_t* p = canvas.pixel(x, y);
      seen.insert(p[0] << 16 | p[1] << 8 | p[2]);
    }
  }
  return seen.size();
}

TEST(Painter, TrianglesThatShareAnEdgeCoverEverySampleOnce) {
  // Seen straight on, a pane of 50 % black over white is 50 % grey everywhere: a sample painted twice would be 25 %,
  // one left out 100 %. The colour is rounded to one of 255 steps.
  Scene scene;
  add_square(scene, 0, {0, 0, 0}, 0.5f);
  Canvas canvas(60, 60);
  paint(scene, from_above(), all, canvas);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) ASSERT_NEAR(canvas.pixel(x, y)[0], 127.5, 1.0) << x << ' ' << y;
  }
}

TEST(Painter, WhatIsInFrontHidesWhatIsBehindInAnyOrder) {
  for (const bool swapped : {false, true}) {
    Scene scene;
    add_square(scene, swapped ? 0 : 1, {1, 0, 0}, 1.0f);
    add_square(scene, swapped ? 1 : 0, {0, 1, 0}, 1.0f);
    Canvas canvas(60, 60);
    paint(scene, from_above(), all, canvas);
    const std::uint8_t* p = canvas.pixel(30, 20);
    EXPECT_EQ(p[0] > p[1], !swapped);
  }
}

TEST(Painter, PanesMixFrontToBack) {
  // Red 50 % before blue 50 % before white: (1/2 + 1/4, 1/4, 1/4 + 1/4) whatever the order of drawing.
  for (const bool swapped : {false, true}) {
    Scene scene;
    if (swapped) add_square(scene, 0, {0, 0, 1}, 0.5f);
    add_square(scene, 1, {1, 0, 0}, 0.5f);
    if (!swapped) add_square(scene, 0, {0, 0, 1}, 0.5f);
    Canvas canvas(60, 60);
    paint(scene, from_above(), all, canvas);
    const std::uint8_t* p = canvas.pixel(30, 20);
    EXPECT_NEAR(p[0], 0.75 * 255, 1.0);
    EXPECT_NEAR(p[1], 0.25 * 255, 1.0);
    EXPECT_NEAR(p[2], 0.50 * 255, 1.0);
  }
}

TEST(Painter, ASphereIsADiscOfItsRadius) {
  Scene scene;
  scene.spheres.push_back({Vec3(3, 3, 0), 2.0, {0, 0, 0}});
  Canvas canvas(60, 60);
  paint(scene, from_above(), all, canvas);
  double area = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) area += 1.0 - canvas.pixel(x, y)[0] / 255.0;
  }
  // pi 20^2 pixels; on 3 x 3 samples a pixel the rim of 126 pixels is known to a third of a pixel at random: well
  // below 1 %.
  EXPECT_NEAR(area, 3.14159 * 400, 0.01 * 3.14159 * 400);
}

TEST(Painter, ThePictureIsTheSameForEveryNumberOfThreads) {
  const auto with = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return carriers_picture(synthetic_walls(), synthetic_carriers(0.12), {"x", 0.12}, 2.0, {}, 400, 300).png();
  };
  EXPECT_EQ(with(1), with(2));
}

// A run that diverged leaves such values in its last output.
TEST(Painter, WhatIsNoNumberOrFarAwayIsLeftOut) {
  CarrierFrame carriers = synthetic_carriers(0.12);
  const auto picture = [&] {
    return carriers_picture(synthetic_walls(), carriers, {"x", 0.12}, speed_scale(carriers), {}, 400, 300).png();
  };
  const auto last = carriers.position.size() - 1;
  carriers.position[last] = {1e6, 0.0, 0.0};
  const auto beside = picture();
  carriers.velocity[last] = {std::nanf(""), 0.0F, 0.0F};
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300}) {
    carriers.position[last] = {x, x, x};
    EXPECT_EQ(picture(), beside) << x;
  }
  const Colour none = viridis(std::nanf(""));
  EXPECT_EQ(none.r, viridis(0.0F).r);
}

TEST(Camera, ShowsTheWholeBox) {
  const Vec3 low(-1, -2, -3), high(4, 5, 6);
  const Box view{10, 20, 300, 200};
  const Camera camera = Camera::looking(-62, 33, low, high, view);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = camera.project(
        {corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(), corner & 4 ? high.z() : low.z()});
    EXPECT_GE(p.x(), view.x - 1e-9);
    EXPECT_LE(p.x(), view.x + view.width + 1e-9);
    EXPECT_GE(p.y(), view.y - 1e-9);
    EXPECT_LE(p.y(), view.y + view.height + 1e-9);
  }
}

TEST(WallShape, MeasuresOfAnLShapedDuct) {
  const WallFrame walls = synthetic_walls();
  // (30 x 7 + 7 x 18) mm^2 x 4.5 mm; sums of some thousand terms of rounding 1e-16 each.
  EXPECT_NEAR(volume_of(walls), 1512e-9, 1512e-9 * 1e-12);
  EXPECT_NEAR(measures_of(walls)[1].area, 31.5e-6, 31.5e-6 * 1e-12);
  EXPECT_NEAR(measures_of(walls)[1].middle.y(), 3.5e-3, 1e-12);
  double length = 0;  // the outline at half height: the L's perimeter
  for (const auto& [a, b] : cut_of(walls, 2, 2.2e-3)) length += (b - a).norm();
  EXPECT_NEAR(length, 110e-3, 1e-12);
}

TEST(ColourScale, TicksAreRoundAndWithin) {
  EXPECT_EQ((ColourScale{0, 60, false}.ticks()), (std::vector<double>{0, 10, 20, 30, 40, 50, 60}));
  EXPECT_EQ((ColourScale{1e-2, 1e1, true}.ticks().size()), 4u);
  EXPECT_FLOAT_EQ((ColourScale{1e-4, 1, true}.position(1e-2)), 0.5f);
  EXPECT_EQ(round_up(2.1), 2.5);
  EXPECT_EQ(round_up(0.051), 0.1);
  EXPECT_EQ(scale_end(61), 70);
}

class RenderView : public testing::TestWithParam<View> {};

TEST_P(RenderView, IsAPictureOfTheAskedSizeWithManyColours) {
  const Scratch folder;
  write_synthetic_run(folder / "run");
  ASSERT_TRUE(can_render(folder / "run", GetParam()));
  render(folder / "run", GetParam(), 0.12, folder / "a.png");
  const std::string png = text_of(folder / "a.png");
  ASSERT_EQ(png.substr(1, 3), "PNG");
  const auto number = [&](std::size_t at) {  // big-endian, in the header chunk
    return static_cast<unsigned char>(png[at + 2]) * 256 + static_cast<unsigned char>(png[at + 3]);
  };
  EXPECT_EQ(number(16), 1600);
  EXPECT_EQ(number(20), 1000);
  EXPECT_GT(png.size(), 20000u);  // an empty white page of this size takes less than 10 kB
}

INSTANTIATE_TEST_SUITE_P(Views, RenderView,
                         testing::Values(View::geometry, View::carriers, View::slice, View::streamlines,
                                         View::wall_map));

TEST(Render, PicturesHaveManyColours) {
  // Shading, glass and the colour map give smooth tones; a failed drawing would be a page of one colour.
  const WallFrame walls = synthetic_walls();
  EXPECT_GT(colours_in(geometry_picture(walls, {"x", {}}, {}, 800, 500)), 100u);
  EXPECT_GT(colours_in(carriers_picture(walls, synthetic_carriers(0.12), {"x", 0.12}, 2.0, {}, 800, 500)), 500u);
  EXPECT_GT(colours_in(slice_picture(synthetic_field(0.1), walls, "speed", 2, 2e-3, {"x", 0.1}, {}, 800, 500)), 100u);
  EXPECT_GT(colours_in(wall_map_picture(walls, "fines", {"x", 0.1}, {}, 800, 500)), 500u);
}

TEST(Render, AWallMapIsOfTheScalarThatIsAsked) {
  WallFrame walls = synthetic_walls();
  const auto map = [&](const std::string& quantity) {
    return wall_map_picture(walls, quantity, {"x", 0.1}, {}, 400, 300);
  };
  walls.further_fines = {{"b", std::vector<double>(walls.fines.size(), 0.0)}};
  EXPECT_LT(colours_in(map("fines_b")), colours_in(map("fines")));  // grey alone, but for the bar and the edges
  EXPECT_EQ(wall_quantities(walls), (std::vector<std::string>{"fines", "fines_b", "hits", "energy"}));
  EXPECT_THROW(map("fines_c"), std::invalid_argument);
}

TEST(Render, APictureClosesUpOnAPatchAndNamesThePatchesIfThereIsNone) {
  const WallFrame walls = synthetic_walls();
  const Box view{0, 0, 800, 500};
  EXPECT_GT(camera_for(walls, {{}, {}, "pocket"}, view).scale, 1.5 * camera_for(walls, {}, view).scale);
  // From the side, x to the right and z up.
  EXPECT_NEAR(camera_for(walls, {-90.0, 0.0, "pocket"}, view).right.x(), 1.0, 1e-12);
  try {
    camera_for(walls, {{}, {}, "pockets"}, view);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("there are wall, inlet, outlet, pocket"), std::string::npos) << e.what();
  }
}

TEST(Render, TheSliceIsOfTheFirstRegionWithVelocityEvenIfALaterOneIsStoredMoreOften) {
  const auto painted = [](bool with_thin_region) {
    const Scratch folder;
    VtkSeries walls(folder / "vtk", "walls"), fields(folder / "vtk", "fields");
    walls.append(0.0, synthetic_walls());
    fields.append(0.1, synthetic_field(0.1));
    FieldFrame thin = synthetic_field(0.1);
    thin.velocity.clear();
    if (with_thin_region) fields.append(0.1, thin, 1), fields.append(0.15, thin, 1);
    render(folder.path(), View::slice, 0.15, folder / "a.png");
    return text_of(folder / "a.png");
  };
  EXPECT_EQ(painted(true), painted(false));
}

TEST(Render, AMissingViewSaysWhatIsMissing) {
  const Scratch folder;
  write_synthetic_run(folder / "run", RunKind::flow_only);
  EXPECT_FALSE(can_render(folder / "run", View::carriers));
  const RenderOptions usual;
  EXPECT_THROW(render(folder / "run", View::carriers, {}, folder / "a.png", usual), OutputError);
  EXPECT_THROW(render(folder / "none", View::geometry, {}, folder / "a.png", usual), OutputError);
  EXPECT_THROW(render(folder / "run", View::geometry, {}, "/proc/a.png", usual), OutputError);
  EXPECT_THROW(parse_view("carrier"), std::invalid_argument);
  EXPECT_EQ(parse_view("wall-map"), View::wall_map);
}

}  // namespace
}  // namespace puffin::output
