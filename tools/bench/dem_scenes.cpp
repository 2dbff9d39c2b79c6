#include "tools/bench/dem_scenes.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "dem/linear_contact.hpp"

namespace puffin::bench {
namespace {

using Eigen::Vector3d;
constexpr double radius = 35e-6, density = 1520.0;  // of the founding study's carriers
constexpr double stiffness = 100.0;                 // [N/m]
constexpr double restitution = 0.6;

dem::Carrier carrier(std::int64_t id, const Vector3d& position, const Vector3d& velocity) {
  dem::Carrier c;
  c.id = id;
  c.position = position, c.velocity = velocity;
  c.radius = radius;
  c.mass = density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  return c;
}

/// Lower corner of the n-th cell of a cube with `side` cells an edge, counted along x first; the cell's edge is 1.
Vector3d corner_of(std::int64_t n, std::int64_t side) {
  const std::int64_t column = n / side, layer = column / side;
  return {static_cast<double>(n % side), static_cast<double>(column % side), static_cast<double>(layer)};
}

/// Body-centred cubic, the cube's edge 4 R/sqrt(3) shortened by `pressed`: every carrier overlaps with eight.
void pack(std::int64_t count, double pressed, DemScene& scene) {
  const double edge = 4.0 * radius / std::sqrt(3.0) * (1.0 - pressed);
  const auto side = static_cast<std::int64_t>(std::ceil(std::cbrt(0.5 * static_cast<double>(count)) - 1e-9));
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-52 - 1.0; };
  // Above the packing is room: nothing but what is pressed together moves.
  scene.walls = BoxWalls(Vector3d::Constant(static_cast<double>(side) * edge + 4.0 * radius));
  for (std::int64_t n = 0; n < count; ++n) {
    const Vector3d corner = corner_of(n / 2, side);
    const Vector3d at = Vector3d::Constant(2.0 * radius) + edge * (corner + Vector3d::Constant(n % 2 ? 0.5 : 0.0));
    const Vector3d speed(uniform(), uniform(), uniform());
    scene.carriers.push_back(carrier(n, at, 1e-3 * speed));
  }
}

void scatter(std::int64_t count, double solid_fraction, double speed, DemScene& scene) {
  const double volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  const auto side = static_cast<std::int64_t>(std::ceil(std::cbrt(static_cast<double>(count)) - 1e-9));
  const double pitch = std::cbrt(volume / solid_fraction);
  scene.walls = BoxWalls(Vector3d::Constant(static_cast<double>(side) * pitch));
  std::mt19937_64 random(2);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-52 - 1.0; };
  for (std::int64_t n = 0; n < count; ++n) {
    const Vector3d cell = corner_of(n, side);
    const Vector3d shake(uniform(), uniform(), uniform()), way(uniform(), uniform(), uniform());
    scene.carriers.push_back(carrier(
        n, pitch * (cell + Vector3d::Constant(0.5)) + (0.5 * pitch - 1.01 * radius) * shake, speed * way.normalized()));
  }
}

}  // namespace

dem::RestOfWall BoxWalls::near(const Vector3d& centre, double reach, std::vector<dem::WallTouch>& touches) const {
  touches.clear();
  for (int d = 0; d < 3; ++d)
    for (const double wall : {0.0, size_[d]}) {
      const double distance = std::abs(centre[d] - wall);
      if (distance > reach) continue;
      Vector3d point = centre;
      point[d] = wall;
      touches.push_back({point, distance, 2 * d + (wall > 0.0)});
    }
  return {};
}

double BoxWalls::clearance(const Vector3d& centre, double limit) const {
  return std::min({limit, centre.minCoeff(), (size_ - centre).minCoeff()});
}

bool BoxWalls::inside(const Vector3d& point) const {
  return (point.array() < 0.0).any() || (point.array() > size_.array()).any();
}

DemScene dem_scene(const std::string& name, std::int64_t carriers) {
  if (carriers < 1) throw std::invalid_argument("a scene needs at least one carrier");
  DemScene scene;
  dem::LinearContact law;
  law.restitution = restitution;
  law.stiffness = stiffness;
  scene.models.carrier = {law, dem::Hamaker{3.6e-3, 0.0, 4e-10, dem::ParcelScaling::ddpm, {}}};
  scene.models.wall = scene.models.carrier;
  scene.models.integration.sleep = name == "resting";
  scene.step = 1e-6;
  if (name == "dense" || name == "resting") {
    pack(carriers, 2e-4, scene);
  } else if (name == "dilute") {
    scatter(carriers, 1e-3, 1.0, scene);
  } else {
    throw std::invalid_argument("no scene '" + name + "'; known: dense, resting, dilute");
  }
  const double mass = 0.5 * scene.carriers.front().mass;
  scene.contact_step = dem::contact_time(mass, stiffness, dem::damping_ratio(restitution)) / 20.0;
  return scene;
}

}  // namespace puffin::bench
