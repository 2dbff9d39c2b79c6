#pragma once
// What happened between carriers, and between carriers and walls: every contact once at its start, once at its end.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace puffin::dem {

/// A contact at first touch.
struct ContactBegun {
  std::int64_t a = -1, b = -1;    // ids of the carriers; b = -1: a wall
  int triangle = -1;              // of the wall, -1 between carriers
  Eigen::Vector3d point;          // place of contact [m]
  Eigen::Vector3d normal;         // unit, from b (or the wall) towards a
  double normal_speed = 0.0;      // closing speed along the normal before adhesion pulls [m/s], >= 0
  double tangential_speed = 0.0;  // of the centres, before adhesion pulls [m/s]
  double angle = 0.0;             // between the relative velocity and the normal [rad]; 0: head-on
  double time = 0.0;              // [s]
};

/// The same contact when it is over.
struct ContactEnded {
  double time_start = 0.0, time_end = 0.0;  // [s]
  std::int64_t a = -1, b = -1;
  int triangle = -1;
  double normal_speed = 0.0, tangential_speed = 0.0;  // as at first touch [m/s]
  double energy = 0.0;       // 1/2 m v^2 [J]; m of one real carrier (mean of the two), v wall-normal or relative speed
  double max_force = 0.0;    // largest normal force of the entries [N]
  double max_overlap = 0.0;  // [m]
};

/// Appended by advance(), in an order that does not depend on the number of threads; cleared by the caller.
struct Events {
  std::vector<ContactBegun> begun;
  std::vector<ContactEnded> ended;
  void clear() {
    begun.clear();
    ended.clear();
  }
};

}  // namespace puffin::dem
