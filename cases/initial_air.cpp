#include "cases/initial_air.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "cases/point_field.hpp"
#include "cases/table_file.hpp"

namespace puffin::cases {

namespace {

double no_pressure(const Vec3&) { return 0.0; }

InitialAir taylor_green_3d(double rho, double u, const Vec3& corner, const Vec3& k) {
  return {[=](const Vec3& at) -> Vec3 {
            const Vec3 x = k.cwiseProduct(at - corner);
            return {u * std::sin(x[0]) * std::cos(x[1]) * std::cos(x[2]),
                    -u * std::cos(x[0]) * std::sin(x[1]) * std::cos(x[2]), 0.0};
          },
          [=](const Vec3& at) {
            const Vec3 x = 2.0 * k.cwiseProduct(at - corner);
            return rho * u * u / 16.0 * (std::cos(x[0]) + std::cos(x[1])) * (std::cos(x[2]) + 2.0);
          }};
}

/// In the plane of the axes a and b.
InitialAir taylor_green_2d(double rho, double u, const Vec3& corner, const Vec3& k, int a, int b) {
  const double v = u * k[a] / k[b];
  return {[=](const Vec3& at) -> Vec3 {
            const Vec3 x = k.cwiseProduct(at - corner);
            Vec3 velocity = Vec3::Zero();
            velocity[a] = -u * std::cos(x[a]) * std::sin(x[b]);
            velocity[b] = v * std::sin(x[a]) * std::cos(x[b]);
            return velocity;
          },
          [=](const Vec3& at) {
            const Vec3 x = 2.0 * k.cwiseProduct(at - corner);
            return -0.25 * rho * (u * u * std::cos(x[a]) + v * v * std::cos(x[b]));
          }};
}

/// The axis along which a box is a slab, less than a quarter of its other edges; else z.
int thin_axis(const Vec3& box) {
  int thin = 2;
  box.minCoeff(&thin);
  return 4.0 * box[thin] < std::min(box[(thin + 1) % 3], box[(thin + 2) % 3]) ? thin : 2;
}

InitialAir from_table(const std::string& file) {
  const auto field = std::make_shared<const PointField>(read_point_field(file));
  InitialAir start{[field](const Vec3& x) { return field->at(x); }, no_pressure};
  const Columns columns = read_columns(file, {"x", "y", "z"});
  if (const auto p = columns.find("p"); p != columns.end()) {
    std::vector<Vec3> values;
    for (const double value : p->second) values.emplace_back(value, 0.0, 0.0);
    const auto pressure = std::make_shared<const PointField>(read_point_rows(file).points, std::move(values));
    start.gauge = true;
    start.pressure = [pressure](const Vec3& x) { return pressure->at(x)[0]; };
  }
  return start;
}

}  // namespace

std::optional<InitialAir> initial_air(const Air& air, const Vec3& corner, const Vec3& box) {
  const double u = air.initial_velocity.norm();
  const Vec3 k = 2.0 * std::numbers::pi * box.cwiseInverse();
  switch (air.initial) {
    case InitialField::taylor_green: {
      const bool cube = box.maxCoeff() - box.minCoeff() <= 0.01 * box.maxCoeff();
      const int thin = thin_axis(box), a = thin == 0 ? 1 : 0, b = thin == 2 ? 1 : 2;
      return cube ? taylor_green_3d(air.density, u, corner, k) : taylor_green_2d(air.density, u, corner, k, a, b);
    }
    case InitialField::shear_layer:
      return InitialAir{[=](const Vec3& at) -> Vec3 {
                          const Vec3 x = (at - corner).cwiseQuotient(box);
                          const double y = x[1];
                          return {u * (y < 0.5 ? std::tanh(80.0 * (y - 0.25)) : std::tanh(80.0 * (0.75 - y))),
                                  0.05 * u * std::sin(2.0 * std::numbers::pi * (x[0] + 0.25)), 0.0};
                        },
                        no_pressure};
    case InitialField::file:
      return from_table(air.initial_file);
    case InitialField::uniform:
      break;
  }
  if (u == 0.0) return std::nullopt;
  return InitialAir{[v = air.initial_velocity](const Vec3&) { return v; }, no_pressure};
}

}  // namespace puffin::cases
