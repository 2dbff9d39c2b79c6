#pragma once
// Which carriers may come near which: a Verlet list with a skin, built from cells.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/carriers.hpp"

namespace puffin::dem {

/// Carrier i has a budget of travel; a pair is listed if its gap was less than the sum of both budgets when the list
/// was built. So the list is complete while no carrier is further than its budget from where it was then, and a few
/// fast carriers do not lengthen the lists of a slow bed.
struct Neighbours {
  std::vector<std::int32_t> begin;        // size n+1: the neighbours of i are list[begin[i]] .. list[begin[i+1]-1]
  std::vector<std::int32_t> list;         // places of carriers, ascending for each i; each pair in both directions
  std::vector<Eigen::Vector3d> built_at;  // positions at that time [m]
  std::vector<double> budget;             // [m]
  bool valid = false;
};

/// Builds the list anew with neighbours.budget, which the caller has set (one entry a carrier). Cost ~ number of
/// carriers, for budgets up to about the radius. A carrier whose place or budget is no finite number has none (the
/// health check will end the run), the others keep theirs.
void build(const Carriers& carriers, Neighbours& neighbours);

/// About how many neighbours a carrier of `which` would be given by build() with these budgets [m]: the mean of
///   (4/3) pi (reach/e)^3 c,  reach = radius + largest radius + 2 budget,
/// c the other carriers in its cube of edge e, the mean reach, and at most all of them. Crowds above 100 count as 100.
/// Cost ~ number of carriers, whatever it returns.
double expected_neighbours(const Carriers& carriers, const std::vector<double>& budget,
                           std::span<const std::int32_t> which);

}  // namespace puffin::dem
