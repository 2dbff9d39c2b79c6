#pragma once
// A bed that has fallen into place: the dose is let go in still, empty space before the run.

#include <vector>

#include "dem/carriers.hpp"
#include "dem/models.hpp"
#include "dem/walls.hpp"

namespace puffin::cases {

/// What came of it.
struct SettledBed {
  std::vector<Eigen::Vector3d> positions;  // [m], in the order of the carriers
  double time = 0.0;                       // [s] it took
  bool at_rest = false;                    // else it was stopped at the longest time
};

/// Lets `carriers` fall under the models' gravity until the bed stays below 2 mm/s for 2 ms, not before five times
/// what a sphere needs to fall by its diameter, at most 0.3 s longer than that. The spheres
/// are soft (linear law, 2 % overlap), their restitution is at most 0.3 and their rolling friction at least 0.1, so
/// that a heap stands; friction is the models'. Adhesion is left out: with it a carrier would stay where it first
/// touches and the bed would be a loose web; how loose a bed is, is said by its bulk density. Needs gravity: throws
/// std::invalid_argument without, and if a carrier is pressed through a wall: one whose radius is less than what the
/// largest may give.
SettledBed settle(dem::Models models, const dem::Walls& walls, const std::vector<dem::Carrier>& carriers);

/// Mass over the space between the bed's floor and its surface [kg/m^3]. Columns of one mean diameter, along `up`, that
/// are covered by a carrier; each from the lowest point of the bed to the highest point of a carrier in the column.
double bulk_density(const std::vector<dem::Carrier>& carriers, const Eigen::Vector3d& up);

/// Lifts each carrier over the lowest point in proportion to its height so that the bed has the bulk density `wanted`
/// [kg/m^3]. Throws std::invalid_argument if the bed is looser than that already.
void loosen(double wanted, const Eigen::Vector3d& up, std::vector<dem::Carrier>& carriers);

}  // namespace puffin::cases
