#pragma once
// What only the geometry can show to be wrong with a case.

#include <stdexcept>
#include <string>
#include <vector>

#include "cases/surface.hpp"

namespace puffin::cases {

/// Names of patches that the surface does not have; boundaries on patches without area; periodic pairs that are not the
/// two congruent ends of the box, opposite along an axis; a velocity vector that does not point into the fluid; a slip
/// wall that is not along the grid; more carriers than the device holds; a run of more than 10^11 steps; a
/// time step too long for any scheme. Every problem, at its place in the file.
std::vector<Problem> boundary_problems(const Case& c, const Surface& surface);

/// Moving walls that do not slide along themselves: by more than 1 % of their speed, with the triangle where it is
/// most.
std::vector<std::string> boundary_warnings(const Case& c, const Surface& surface);

/// A problem at the place of a key (dotted), or of the nearest table around it.
Problem problem_at(const Case& c, const std::string& key, const std::string& text);

/// What `read` gives; a table that cannot be used (std::invalid_argument) is a mistake at that key of the case.
template <class F>
auto from_file(const Case& c, const std::string& key, const F& read) {
  try {
    return read();
  } catch (const std::invalid_argument& e) {
    throw CaseError({problem_at(c, key, key + ": " + e.what())});
  }
}

}  // namespace puffin::cases
