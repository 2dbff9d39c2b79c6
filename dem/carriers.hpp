#pragma once
// The tracked carriers as plain arrays. An entry is a single carrier, or a parcel that stands for several.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace puffin::dem {

/// How an entry takes part in the motion.
enum class Rest : std::uint8_t {
  awake,   // moves
  asleep,  // rests on its contacts; wakes by the rules of rest.hpp
  stuck,   // holds to a wall for good (Models::on_wall == OnWall::stick)
  held     // not yet let go: the caller keeps it in place until it sets it awake
};

/// One entry, to be added.
struct Carrier {
  std::int64_t id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      // [rad/s]
  double radius = 0.0;                                 // of the tracked sphere, i.e. of the parcel [m]
  double mass = 0.0;                                   // of the entry [kg]
  double carriers = 1.0;                               // real carriers it stands for
  double single_radius = 0.0;                          // of one real carrier [m]; 0: the same as radius
};

/// All entries, entry i in place i of each array. Change the number of entries only through add() and remove() of
/// state.hpp, which keep the contact histories with them.
struct Carriers {
  std::vector<std::int64_t> id;
  std::vector<Eigen::Vector3d> position;  // [m]
  std::vector<Eigen::Vector3d> velocity;  // [m/s]
  std::vector<Eigen::Vector3d> spin;      // [rad/s]; stays 0 with Models::rotation == false
  std::vector<double> radius;             // tracked sphere [m]
  std::vector<double> mass;               // entry [kg]
  std::vector<double> carriers;           // real carriers an entry
  std::vector<double> single_radius;      // one real carrier [m]
  std::vector<Rest> rest;

  std::size_t size() const { return id.size(); }
  double single_mass(std::size_t i) const { return mass[i] / carriers[i]; }  // [kg]
};

}  // namespace puffin::dem
