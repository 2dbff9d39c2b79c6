// Impacts on walls made of flat faces, beside the edges between them.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/mesh_walls.hpp"
#include "dem/advance.hpp"
#include "lbm/geometry/weld.hpp"

namespace puffin::coupling {
namespace {

using lbm::geometry::TriangleMesh;
using lbm::geometry::Vec3;

/// A room of 2 x 1 x 1 mm whose floor bends at x = 0 by `angle` [rad]: up if > 0.
TriangleMesh bent_floor(double angle) {
  const double rise = 1e-3 * std::tan(angle);
  const std::array<std::array<double, 2>, 5> outline{{{-1e-3, 0}, {0, 0}, {1e-3, rise}, {1e-3, 1e-3}, {-1e-3, 1e-3}}};
  TriangleMesh mesh;
  mesh.solids = {"room"};
  for (const double y : {0.0, 1e-3})
    for (const auto& [x, z] : outline) mesh.vertices.emplace_back(x, y, z);
  for (int i = 0; i < 5; ++i) {
    const int j = (i + 1) % 5;
    mesh.triangles.push_back({i, j + 5, j});
    mesh.triangles.push_back({i, i + 5, j + 5});
  }
  for (int i = 0; i < 3; ++i) {
    mesh.triangles.push_back({4, i, i + 1});
    mesh.triangles.push_back({9, i + 6, i + 5});
  }
  mesh.solid.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// Kinetic energy after an impact, one touch, over that before: at (5, 0, -2) m/s, the first touch
/// `before` [m] from the edge.
double energy_ratio(const MeshWalls& walls, const dem::Models& models, double before) {
  constexpr double radius = 35e-6, gap = 1.5e-5;
  const Vec3 velocity(5.0, 0.0, -2.0);
  dem::Carrier c;
  c.position = Vec3(-before, 5e-4, radius) - gap / 2.0 * velocity;
  c.velocity = velocity;
  c.radius = radius;
  c.mass = 1520.0 * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  dem::State state;
  dem::add(std::span(&c, 1), state);
  const dem::Load none;
  dem::Events events;
  for (int n = 0; n < 30; ++n) dem::advance(1e-6, models, walls, std::span(&none, 1), state, events);
  EXPECT_EQ(events.begun.size(), 1u);
  return state.carriers.velocity[0].squaredNorm() / velocity.squaredNorm();
}

}  // namespace

// The force of the nearest face is that of a potential, half of k times the square of the larger overlap, so an elastic
// impact keeps its energy wherever it lies. What is left is where within a sub-step h = t_c/20 one face takes over: at
// most half a sub-step with a force turned by the angle, k overlap angle v_t h/2. With k = pi^2 m/t_c^2 and overlap =
// v_n t_c/pi that is pi/20 v_n v_t/v^2 = 0.054 of the angle, as a part of the energy.
TEST(EdgeImpacts, KeepTheirEnergyBesideAnEdge) {
  dem::Models models;
  dem::LinearContact law;
  law.restitution = 1.0;
  law.friction = dem::ConstantFriction{0.0};
  law.stiffness = 2000.0;
  models.carrier.contact = models.wall.contact = law;
  for (const double degrees : {2.0, 5.0, 10.0, 14.0, -5.0, -10.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const MeshWalls walls(std::make_shared<lbm::geometry::TriangleTree>(bent_floor(angle)));
    for (const double before : {0.0, 1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6, 8e-6, 1e-5, 1.5e-5, 3e-5})
      EXPECT_NEAR(energy_ratio(walls, models, before), 1.0, 0.06 * std::abs(angle))
          << degrees << " degrees, " << before;
  }
}

}  // namespace puffin::coupling
