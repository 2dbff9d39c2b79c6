// Where the carriers start.

#include "cases/dose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>

namespace puffin::cases {
namespace {

using Vec3 = Eigen::Vector3d;
constexpr double um = 1e-6, mm = 1e-3;

const auto everywhere = [](const Vec3&) { return true; };
const auto no_walls = [](const Vec3&) { return std::numeric_limits<double>::infinity(); };

DoseSpec thesis_dose() {
  DoseSpec spec;
  spec.carriers = 25000;
  spec.parcel = 10;
  spec.diameter = 70 * um;
  spec.density = 1520.0;
  spec.floor = Vec3(3.5 * mm, 0.0, -0.25 * mm);
  spec.floor_diameter = 4.5 * mm;
  return spec;
}

DoseSpec cube_dose(std::int64_t carriers, std::int64_t parcel) {
  DoseSpec spec = thesis_dose();
  spec.shape = DoseShape::cube;
  spec.carriers = carriers;
  spec.parcel = parcel;
  return spec;
}

Dose place(const DoseSpec& spec) { return place_dose(spec, everywhere, no_walls); }

double smallest_distance(const Dose& dose) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < dose.positions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      smallest = std::min(smallest, (dose.positions[i] - dose.positions[j]).squaredNorm());
  return std::sqrt(smallest);
}

struct Extent {
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
};
Extent extent(const Dose& dose) {
  Extent e;
  for (const Vec3& p : dose.positions) {
    e.low = e.low.cwiseMin(p);
    e.high = e.high.cwiseMax(p);
  }
  return e;
}

TEST(Parcel, has_the_volume_of_its_carriers) {
  EXPECT_NEAR(std::pow(parcel_diameter(70 * um, 10), 3), 10.0 * std::pow(70 * um, 3), 1e-24);
  EXPECT_NEAR(parcel_diameter(70 * um, 10), 150.8 * um, 0.05 * um);
}

TEST(CylinderDose, holds_the_parcels_of_the_thesis_one_pitch_apart) {
  const Dose dose = place(thesis_dose());
  const double d = parcel_diameter(70 * um, 10);
  ASSERT_EQ(dose.positions.size(), 2500U);
  EXPECT_NEAR(smallest_distance(dose), 1.2 * d, 1e-12 * d);
  EXPECT_DOUBLE_EQ(dose.radius.front(), 0.5 * d);
}

TEST(CylinderDose, stays_within_the_floor_and_rests_just_above_it) {
  const Dose dose = place(thesis_dose());
  const double d = parcel_diameter(70 * um, 10);
  for (const Vec3& p : dose.positions) {
    ASSERT_LE(std::hypot(p.x() - 3.5 * mm, p.y()) + 0.5 * d, 2.25 * mm * (1 + 1e-12));
    ASSERT_GE(p.z() - 0.5 * d, -0.25 * mm + 0.1 * d * (1 - 1e-9));
  }
  EXPECT_NEAR(extent(dose).low.z(), -0.25 * mm + 0.6 * d, 1e-12);
}

TEST(CylinderDose, has_the_height_and_density_that_its_lattice_implies) {
  // Sites within 2.1746 mm on a lattice of 0.181 mm: pi r^2 / pitch^2 = 453 to a few, so 2500 need 5.5: six layers.
  const Dose dose = place(thesis_dose());
  const double pitch = 1.2 * parcel_diameter(70 * um, 10);
  EXPECT_EQ(dose.layers, 6);
  EXPECT_NEAR(dose.height, 6 * pitch - pitch / 12.0, 1e-12);  // less the half gap above the last layer
  const double mass = 25000 * 1520.0 * std::numbers::pi / 6.0 * std::pow(70 * um, 3);
  EXPECT_NEAR(dose.bulk_density / (mass / (std::numbers::pi / 4.0 * std::pow(4.5 * mm, 2) * 6 * pitch)), 1.0, 1e-12);
}

TEST(CylinderDose, fills_its_last_layer_from_the_middle) {
  const Dose dose = place(thesis_dose());
  const double top = extent(dose).high.z();
  double widest = 0.0;
  int on_top = 0;
  for (const Vec3& p : dose.positions)
    if (p.z() > top - 1 * um) {
      ++on_top;
      widest = std::max(widest, std::hypot(p.x() - 3.5 * mm, p.y()));
    }
  // A disc of n sites has the radius pitch sqrt(n / pi), give or take a diagonal.
  const double pitch = 1.2 * parcel_diameter(70 * um, 10);
  EXPECT_LT(widest, pitch * (std::sqrt(on_top / std::numbers::pi) + 1.0));
}

TEST(CubeDose, of_a_thousand_is_ten_by_ten_by_ten) {
  const Dose dose = place(cube_dose(1000, 1));
  const Extent e = extent(dose);
  EXPECT_EQ(dose.layers, 10);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(e.high[axis] - e.low[axis], 9 * 84 * um, 1e-12);
  EXPECT_NEAR(smallest_distance(dose), 84 * um, 1e-12);
  EXPECT_NEAR(0.5 * (e.low.x() + e.high.x()), 3.5 * mm, 1e-12);
}

TEST(CubeDose, of_a_number_that_is_no_cube_is_the_nearest_box) {
  EXPECT_EQ(nearest_box(1000), (std::array<std::int64_t, 3>{10, 10, 10}));
  EXPECT_EQ(nearest_box(10000), (std::array<std::int64_t, 3>{25, 20, 20}));
  EXPECT_EQ(nearest_box(100), (std::array<std::int64_t, 3>{5, 5, 4}));
  EXPECT_EQ(nearest_box(1), (std::array<std::int64_t, 3>{1, 1, 1}));
  for (std::int64_t n = 1; n < 2000; ++n) {
    const auto box = nearest_box(n);
    ASSERT_GE(box[0] * box[1] * box[2], n);
    ASSERT_TRUE(box[0] >= box[1] && box[1] >= box[2] && box[2] >= 1);
  }
  EXPECT_EQ(place(cube_dose(101, 1)).positions.size(), 101U);
}

TEST(CubeDose, of_parcels_takes_the_extent_of_the_single_carriers) {
  for (const auto& [singles, parcel] : {std::pair<std::int64_t, std::int64_t>{1000, 10}, {10000, 10}}) {
    DoseSpec spec = cube_dose(singles, parcel);
    spec.extent_of = {singles, 1};
    const Dose parcels = place(spec);
    const Extent ours = extent(parcels), theirs = extent(place(cube_dose(singles, 1)));
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(ours.high[axis] - ours.low[axis], theirs.high[axis] - theirs.low[axis], 1e-12);
    EXPECT_NEAR(ours.low.x(), theirs.low.x(), 1e-12);
    EXPECT_NEAR(ours.low.y(), theirs.low.y(), 1e-12);
    // Both stacks clear the floor by the same 0.1 single diameters.
    EXPECT_NEAR(ours.low.z() - 0.5 * parcel_diameter(70 * um, 10), theirs.low.z() - 35 * um, 1e-12);
    EXPECT_GT(smallest_distance(parcels), parcel_diameter(70 * um, 10));
  }
}

TEST(CubeDose, refuses_an_extent_in_which_spheres_overlap) {
  DoseSpec spec = cube_dose(1000, 1);
  spec.extent_of = {100, 1};
  EXPECT_THROW(place(spec), std::invalid_argument);
}

TEST(Jitter, gives_the_same_bits_for_the_same_seed_and_others_for_another) {
  DoseSpec spec = thesis_dose();
  spec.jitter = 0.01;
  const Dose first = place(spec), again = place(spec);
  EXPECT_EQ(first.positions, again.positions);
  spec.seed = 2;
  EXPECT_NE(first.positions, place(spec).positions);
}

TEST(Jitter, is_the_same_on_every_machine) {
  // The 10000th value of std::mt19937_64 is fixed by the standard (9981545732273789042 for the default seed 5489); the
  // first three draws place the first sphere.
  std::mt19937_64 generator(5489);
  DoseSpec spec = cube_dose(1, 1);
  spec.jitter = 0.05;
  spec.seed = 5489;
  const Vec3 p = place(spec).positions.front();
  const Vec3 ideal = spec.floor + Vec3(0, 0, 42 * um);
  for (int axis = 0; axis < 3; ++axis) {
    const double u = static_cast<double>(generator() >> 11) / 9007199254740992.0;  // 2^53
    EXPECT_NEAR(p[axis], ideal[axis] + 3.5 * um * (2.0 * u - 1.0), 1e-17);
  }
}

TEST(Jitter, moves_spheres_by_the_fraction_asked_for) {
  DoseSpec spec = cube_dose(1000, 1);
  const Dose ideal = place(spec);
  spec.jitter = 0.05;
  const Dose moved = place(spec);
  double largest = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const Vec3 offset = moved.positions[i] - ideal.positions[i];
    largest = std::max(largest, offset.cwiseAbs().maxCoeff());
    sum += offset.squaredNorm();
  }
  EXPECT_LE(largest, 3.5 * um * (1 + 1e-9));
  // Mean square of 3000 uniform draws: a^2 / 3; its standard error is a^2 sqrt(4/45/3000) = 0.0054 a^2; four of them.
  EXPECT_NEAR(sum / 3000.0 / std::pow(3.5 * um, 2), 1.0 / 3.0, 4 * 0.0054);
}

TEST(Jitter, never_makes_neighbours_or_the_floor_overlap) {
  DoseSpec spec = cube_dose(1000, 1);
  spec.jitter = 5.0;  // clamped to half the gap
  const Dose dose = place(spec);
  EXPECT_GE(smallest_distance(dose), 70 * um * (1 - 1e-12));
  EXPECT_GE(extent(dose).low.z(), spec.floor.z() + 35 * um * (1 - 1e-9));
  DoseSpec cylinder = thesis_dose();
  cylinder.jitter = 5.0;
  const double radius = 0.5 * parcel_diameter(70 * um, 10);
  for (int tenths = 20; tenths <= 45; ++tenths) {  // for some diameter the outermost sites lie close to the rim
    cylinder.floor_diameter = 0.1 * tenths * mm;
    for (const Vec3& p : place(cylinder).positions)
      ASSERT_LE(std::hypot(p.x() - 3.5 * mm, p.y()) + radius, 0.5 * cylinder.floor_diameter);
  }
}

TEST(Dose, that_does_not_fit_is_refused_with_the_place) {
  const auto below_ceiling = [](const Vec3& p) { return 0.5 * mm - p.z(); };
  try {
    place_dose(thesis_dose(), everywhere, below_ceiling);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("not wholly in the fluid"), std::string::npos) << error.what();
  }
  EXPECT_THROW(place_dose(
                   thesis_dose(), [](const Vec3& p) { return p.x() > 3 * mm; }, no_walls),
               std::invalid_argument);
}

TEST(Dose, of_nonsense_is_refused) {
  const auto refuses = [](auto change) {
    DoseSpec spec = thesis_dose();
    change(spec);
    EXPECT_THROW(place(spec), std::invalid_argument);
  };
  refuses([](DoseSpec& s) { s.carriers = 25001; });
  refuses([](DoseSpec& s) { s.carriers = 0; });
  refuses([](DoseSpec& s) { s.parcel = 0; });
  refuses([](DoseSpec& s) { s.diameter = -1.0; });
  refuses([](DoseSpec& s) { s.density = 0.0; });
  refuses([](DoseSpec& s) { s.gap = -0.1; });
  refuses([](DoseSpec& s) { s.jitter = std::nan(""); });
  refuses([](DoseSpec& s) { s.floor_diameter = 0.0; });
  refuses([](DoseSpec& s) { s.floor_diameter = 0.1 * mm; });
  refuses([](DoseSpec& s) { s.extent_of = {1000, 1}; });
}

TEST(Dose, is_described_in_one_line) {
  const std::string text = place(thesis_dose()).description;
  EXPECT_NE(text.find("2500 parcels of 10 carriers"), std::string::npos) << text;
  EXPECT_NE(text.find("6 layers"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

class DoseFile : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) {
    const auto path = std::filesystem::path(testing::TempDir()) / ("puffin_dose_" + name + ".csv");
    std::ofstream(path) << content;
    return path.string();
  }
  DoseSpec spec_of(const std::string& file, std::int64_t carriers) {
    DoseSpec spec = cube_dose(carriers, 1);
    spec.shape = DoseShape::file;
    spec.file = file;
    return spec;
  }
};

TEST_F(DoseFile, gives_positions_and_diameters) {
  const Dose dose = place(spec_of(write("good", "x,y,z,diameter\n# a comment\n1e-3,2e-3,3e-3\r\n0,0,1e-3,9e-5\n"), 2));
  ASSERT_EQ(dose.positions.size(), 2U);
  EXPECT_EQ(dose.positions[0], Vec3(1e-3, 2e-3, 3e-3));
  EXPECT_DOUBLE_EQ(dose.radius[0], 35 * um);
  EXPECT_DOUBLE_EQ(dose.radius[1], 45 * um);
}

TEST_F(DoseFile, with_a_bad_row_is_refused_by_line) {
  const std::string file = write("bad", "0,0,0\n1,2\n");
  try {
    place(spec_of(file, 2));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(file + ":2:"), std::string::npos) << error.what();
  }
}

TEST_F(DoseFile, with_another_count_or_missing_is_refused) {
  EXPECT_THROW(place(spec_of(write("count", "0,0,0\n"), 2)), std::invalid_argument);
  EXPECT_THROW(place(spec_of("/nonexistent/dose.csv", 1)), std::invalid_argument);
}

}  // namespace
}  // namespace puffin::cases
