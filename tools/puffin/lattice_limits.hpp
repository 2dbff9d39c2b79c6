#pragma once
// Where a run left the range in which the lattice's air is that of the case.

#include <string>
#include <vector>

#include "cases/build.hpp"

namespace puffin::tools {

/// Highest less lowest density of the fluid cells over the mean density. The lattice's air carries pressure by its
/// density, p = rho c_s^2: a steady flow is faster by that share where its pressure is lower.
double density_range(const cases::Simulation& s);

/// What a user should know at the end of a run, each with its remedy: densities that differ by more than 5 %, tau above
/// 1 throughout.
std::vector<std::string> lattice_warnings(const cases::Simulation& s);

}  // namespace puffin::tools
