#pragma once
// Small analytic walls and a scene that steps itself, for the tests of dem.

#include <vector>

#include "dem/advance.hpp"

namespace puffin::dem::testing {

/// Half-spaces: the fluid is where normal . (x - point) > 0 for every plane. Convex inside, so each plane is one touch.
class PlaneWalls : public Walls {
 public:
  struct Plane {
    Eigen::Vector3d point, normal;
  };
  PlaneWalls() = default;
  explicit PlaneWalls(std::vector<Plane> planes) : planes_(std::move(planes)) {}
  static PlaneWalls floor() { return PlaneWalls({{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()}}); }
  static PlaneWalls box(double edge) {
    std::vector<Plane> planes;
    for (int d = 0; d < 3; ++d) {
      planes.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(d)});
      planes.push_back({Eigen::Vector3d::Constant(edge), -Eigen::Vector3d::Unit(d)});
    }
    return PlaneWalls(planes);
  }
  RestOfWall near(const Eigen::Vector3d& centre, double reach, std::vector<WallTouch>& touches) const override {
    touches.clear();
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const double distance = planes_[i].normal.dot(centre - planes_[i].point);
      if (std::abs(distance) <= reach)
        touches.push_back({centre - distance * planes_[i].normal, std::abs(distance), static_cast<int>(i)});
    }
    return {};
  }
  double clearance(const Eigen::Vector3d& centre, double limit) const override {
    double nearest = limit;
    for (const Plane& plane : planes_) nearest = std::min(nearest, std::abs(plane.normal.dot(centre - plane.point)));
    return nearest;
  }
  bool inside(const Eigen::Vector3d& point) const override {
    for (const Plane& plane : planes_)
      if (plane.normal.dot(point - plane.point) < 0.0) return false;
    return true;
  }

 private:
  std::vector<Plane> planes_;
};

/// A lactose carrier of the thesis: d = 70 um, 1520 kg/m^3.
inline Carrier lactose(std::int64_t id, Eigen::Vector3d position, Eigen::Vector3d velocity = Eigen::Vector3d::Zero(),
                       double radius = 35e-6, double density = 1520.0) {
  Carrier c;
  c.id = id;
  c.position = position;
  c.velocity = velocity;
  c.radius = radius;
  c.mass = density * 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius;
  return c;
}

struct Scene {
  Models models;
  PlaneWalls walls;
  State state;
  Events events;
  std::vector<Load> loads;

  void add(const Carrier& carrier) {
    dem::add(std::span(&carrier, 1), state);
    loads.resize(state.carriers.size());
  }
  LinearContact& law() { return std::get<LinearContact>(models.carrier.contact); }
  void same_walls() { models.wall = models.carrier; }
  void step(double duration) { advance(duration, models, walls, loads, state, events); }
  void run(double time, double duration) {
    for (const double end = state.time + time * (1.0 - 1e-9); state.time < end;) step(duration);
  }
  const Eigen::Vector3d& x(std::size_t i) const { return state.carriers.position[i]; }
  const Eigen::Vector3d& v(std::size_t i) const { return state.carriers.velocity[i]; }
  const Eigen::Vector3d& w(std::size_t i) const { return state.carriers.spin[i]; }
  /// Kinetic energy of translation and spin [J].
  double kinetic() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < state.carriers.size(); ++i) {
      const double r = state.carriers.radius[i];
      sum += 0.5 * state.carriers.mass[i] * (v(i).squaredNorm() + 0.4 * r * r * w(i).squaredNorm());
    }
    return sum;
  }
};

}  // namespace puffin::dem::testing
