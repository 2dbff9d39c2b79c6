// Fields given at points: exact for linear fields, constant beyond their points.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cases/point_field.hpp"

namespace puffin::cases {
namespace {

Vec3 linear(const Vec3& x) { return {1.0 + 2.0 * x[0] - x[1], 3.0 * x[2], x[0] + x[1] + x[2]}; }

// Multilinear interpolation reproduces linear fields: rounding of some ten operations on values of order 10.
TEST(PointField, AGridIsExactForLinearFieldsWhateverTheOrderOfItsRows) {
  std::vector<Vec3> points, values;
  for (const double z : {0.0, 0.5, 2.0})
    for (const double x : {3.0, 1.0, 0.0, 1.5})
      for (const double y : {0.0, 1.0}) points.emplace_back(x, y, z);
  std::shuffle(points.begin(), points.end(), std::mt19937(7));
  for (const Vec3& p : points) values.push_back(linear(p));
  const PointField field(points, values);
  EXPECT_TRUE(field.is_grid());
  for (const Vec3& x : {Vec3(0.3, 0.2, 0.1), Vec3(2.9, 0.99, 1.7), Vec3(1.0, 0.0, 2.0)})
    EXPECT_LT((field.at(x) - linear(x)).norm(), 1e-13);
  EXPECT_LT((field.at(Vec3(9, 9, 9)) - linear(Vec3(3, 1, 2))).norm(), 1e-13) << "beyond the grid its edge is held";
}

TEST(PointField, AlongADirectionWithOneCoordinateTheFieldIsConstant) {
  const PointField field({Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 3, 0)}, {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 0, 4)});
  EXPECT_LT((field.at(Vec3(5, 0.25, -7)) - Vec3(0.5, 0, 0)).norm(), 1e-15);
  EXPECT_LT((field.at(Vec3(0, 2, 0)) - Vec3(2, 0, 2)).norm(), 1e-15);
}

// A linear fit to linear data leaves rounding alone, amplified by the weights (up to 1e8 in the square): 1e-7. Inside
// the cloud the bounds of the neighbours do not bite.
TEST(PointField, ScatteredPointsAreExactForLinearFieldsAndPassThroughTheirValues) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> random(0.0, 1.0);
  std::vector<Vec3> points, values;
  for (int n = 0; n < 4000; ++n) points.emplace_back(random(engine), random(engine), random(engine));
  for (const Vec3& p : points) values.push_back(linear(p));
  const PointField field(points, values);
  EXPECT_FALSE(field.is_grid());
  for (const Vec3& x : {Vec3(0.5, 0.5, 0.5), Vec3(0.31, 0.72, 0.4), Vec3(0.6, 0.2, 0.8)})
    EXPECT_LT((field.at(x) - linear(x)).norm(), 1e-7);
  EXPECT_LT((field.at(points[17]) - values[17]).norm(), 1e-12);
}

TEST(PointField, ScatteredPointsOnALineGiveALinearProfileAcrossIt) {
  std::vector<Vec3> points, values;
  for (int n = 0; n <= 20; ++n) {
    const double s = 0.05 * n + 0.01 * std::sin(9.0 * n);
    points.emplace_back(s, 2.0 * s, 0.0);
    values.emplace_back(s, 0.0, 0.0);
  }
  const PointField field(points, values);
  EXPECT_FALSE(field.is_grid());
  const Vec3 on(0.4, 0.8, 0.0), across(-0.02, 0.01, 0.0);
  EXPECT_NEAR(field.at(on)[0], 0.4, 1e-7);
  EXPECT_NEAR(field.at(on + across)[0], 0.4, 1e-7);
}

TEST(PointField, NoPointsAndTwoValuesAtOnePointAreRefused) {
  EXPECT_THROW(PointField({}, {}), std::invalid_argument);
  EXPECT_THROW(PointField({Vec3(0, 0, 0), Vec3(1, 2, 3), Vec3(1, 2, 3)}, std::vector<Vec3>(3, Vec3::Zero())),
               std::invalid_argument);
}

}  // namespace
}  // namespace puffin::cases
