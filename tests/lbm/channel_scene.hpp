#pragma once
// A plane channel driven by a body force, behind any kind of wall.

#include <cmath>

#include "lbm/markers.hpp"
#include "lbm/wall_schemes.hpp"
#include "tests/lbm/box_scene.hpp"

namespace puffin::lbm::test {

inline AirOptions laminar(WallScheme wall, double tau = 0.8) {
  AirOptions options;
  options.markers.retraction = retraction_for(tau);
  options.wall = wall;
  options.smagorinsky = 0.0;
  options.double_precision = true;
  return options;
}

/// A plane channel of `height` cells along x, its grid shifted by `offset`; a body force drives it to a peak of 0.05.
struct Channel {
  Channel(WallScheme wall, double height, double offset, double time, const Boundary& side = periodic()) : tau(time) {
    scene = make_box(geometry::Vec3(4, height, 4), 1.0,
                     {periodic(), periodic(), test::wall(), test::wall(), side, side}, geometry::Vec3(0, offset, 0));
    air = make_air(scene, laminar(wall, tau));
    nu = (tau - 0.5) / 3.0;
    force = 8.0 * nu * 0.05 / (height * height);
    drive = at_rest(air);
    drive.uniform_force = {force, 0, 0};
    // Five diffusion times of the slowest mode: exp(-5) of the start, which is the exact profile.
    const int steps = static_cast<int>(5.0 * height * height / nu / 9.87);
    for (int t = 0; t < steps; ++t) step(air, tau, drive);
    settle_walls(drive, air);
  }
  /// How much wider the channel acts than it is, per wall: the height that the flow rate belongs to.
  double displacement(double height) const {
    double flow = 0.0;
    for (const Run& run : air.rows.runs())
      for (int n = 0; n < run.count; ++n) {
        const double z = air.rows.centre(run.first + n)[2];
        if (z > 0.0 && z < 4.0) flow += moments_at(air, run.first + n).ux + 0.5 * force;
      }
    return 0.5 * (std::cbrt(12.0 * nu * flow / 16.0 / force) - height);
  }
  BoxScene scene;
  Air air;
  Drive drive;
  double tau, nu = 0.0, force = 0.0;
};

}  // namespace puffin::lbm::test
