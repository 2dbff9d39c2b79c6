// Slices through the air: what they paint, and what they refuse.

#include <gtest/gtest.h>

#include "tests/tools/output/scratch.hpp"
#include "tests/tools/output/synthetic_run.hpp"
#include "tools/output/picture/views.hpp"
#include "tools/output/render.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

/// Air with two scalars: 1e12 of a everywhere, a hundredth of it of b but in one cell.
FieldFrame field_with_scalars() {
  FieldFrame field = synthetic_field(0.1);
  const auto cells = static_cast<std::size_t>(field.cells());
  field.fines = {{"a", std::vector<float>(cells, 1e12F)}, {"b", std::vector<float>(cells, 1e10F)}};
  field.fines[1].values[4 * 60 * 50] = 1e12F;  // in the layer that is painted: it ends the scale
  return field;
}

TEST(Slice, PaintsTheQuantityThatIsAsked) {
  // 30 mm x 25 mm on a stage of 550 x 280 pixels: 11.2 pixels a millimetre, the device's corner at pixel (157, 410).
  FieldFrame field = field_with_scalars();
  const auto colour = [&](const std::string& quantity, std::optional<double> maximum = {}) {
    const Canvas canvas = slice_picture(field, synthetic_walls(), quantity, 2, 2.25e-3, {"x", 0.1}, maximum, 800, 500);
    const std::uint8_t* p = canvas.pixel(157 + 112, 410 - 39);  // 10.04 mm, 3.4 mm
    return std::array{p[0], p[1], p[2]};
  };
  const auto expect = [&](const std::array<std::uint8_t, 3>& seen, double part, const char* what) {
    const Colour wanted = viridis(static_cast<float>(part));
    const float rgb[] = {wanted.r, wanted.g, wanted.b};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 255 * rgb[c], 1.0) << what << ' ' << c;
  };
  expect(colour("fines"), 1.0, "the first scalar, at the end of its scale");
  expect(colour("fines_a"), 1.0, "by its name");
  expect(colour("fines_b"), 0.5, "two of four powers of ten below the highest");
  expect(colour("fines_a", 1e14), 0.5, "the asked end of the scale");
  const double pressure = 1.0 - (112.5 / 11.2) / 30.0;  // of 3000 Pa, linear in x, on a scale to 3000 Pa
  expect(colour("pressure"), pressure, "pressure");
  expect(colour("pressure", 6000.0), 0.5 * pressure, "pressure to 6 kPa");
  EXPECT_NE(colour("speed"), colour("pressure"));
  for (float& value : field.pressure) value -= 1000.0F;
  expect(colour("pressure"), pressure, "from -1 to 2 kPa");
}

TEST(Slice, WhatIsNotStoredIsRefusedWithWhatIs) {
  const Scratch folder;
  VtkSeries walls(folder / "vtk", "walls"), fields(folder / "vtk", "fields");
  walls.append(0.0, synthetic_walls());
  fields.append(0.1, field_with_scalars());
  const auto said = [&](const RenderOptions& options, View view = View::slice) -> std::string {
    try {
      render(folder.path(), view, {}, folder / "a.png", options);
    } catch (const NotStored& e) {
      return e.what();
    }
    return "painted";
  };
  RenderOptions options;
  options.width = 400, options.height = 300;
  for (const char* quantity : {"speed", "pressure", "fines", "fines_a", "fines_b"}) {
    options.quantity = quantity;
    EXPECT_EQ(said(options), "painted") << quantity;
  }
  options.quantity = "fines_c";
  EXPECT_NE(said(options).find("they hold speed, pressure, fines, fines_a, fines_b"), std::string::npos);
  EXPECT_NE(said(options, View::wall_map).find("they hold fines, hits, energy"), std::string::npos);
  options.quantity = "speed";
  options.slice_axis = 0;
  for (const double at : {0.0, 0.012, 0.030}) {
    options.slice_at = at;
    EXPECT_EQ(said(options), "painted") << at;
  }
  for (const double at : {-1e-4, 0.0301, 1.0}) {
    options.slice_at = at;
    EXPECT_NE(said(options).find("outside the device, from 0 to 30 mm along x"), std::string::npos) << said(options);
  }
}

TEST(Slice, IsOfTheRegionThatHoldsThePlane) {
  const Scratch folder;
  VtkSeries walls(folder / "vtk", "walls"), fields(folder / "vtk", "fields");
  walls.append(0.0, synthetic_walls());
  FieldFrame thin = synthetic_field(0.1);  // the lowest layer of cells alone, from 0 to 0.5 mm
  thin.size[2] = 1;
  thin.fluid.resize(thin.cells()), thin.velocity.resize(3 * thin.cells()), thin.pressure.clear();
  fields.append(0.1, thin, 0);
  RenderOptions options;
  options.slice_axis = 2, options.slice_at = 2.25e-3;
  EXPECT_THROW(render(folder.path(), View::slice, {}, folder / "a.png", options), NotStored);
  fields.append(0.1, synthetic_field(0.1), 1);
  render(folder.path(), View::slice, {}, folder / "a.png", options);
  const Canvas whole =
      slice_picture(synthetic_field(0.1), synthetic_walls(), "speed", 2, 2.25e-3, {"", 0.1}, {}, 1600, 1000);
  EXPECT_EQ(text_of(folder / "a.png"), whole.png());
}

}  // namespace
}  // namespace puffin::output
