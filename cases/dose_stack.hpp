#pragma once
// The ideal lattices of a dose, before jitter and before it is checked against the walls.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cases/dose.hpp"

namespace puffin::cases {

struct Stack {
  std::vector<Eigen::Vector3d> sites;  // [m], layer by layer from the floor up
  int layers = 0;
  double volume = 0.0;     // [m^3] that the stack takes up, half a gap around it included
  double free_play = 0.0;  // [m] offset along each axis that cannot make spheres touch each other or the floor
  std::string shape;       // "cylinder of 4.5 mm", "10 x 10 x 10 cube"
};

/// Throws std::invalid_argument if not even one sphere has room on the floor.
Stack cylinder_stack(const DoseSpec& spec);

/// Throws std::invalid_argument if the extent asked for makes spheres overlap.
Stack cube_stack(const DoseSpec& spec);

}  // namespace puffin::cases
