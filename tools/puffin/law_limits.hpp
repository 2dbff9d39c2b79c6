#pragma once
// Impacts faster than the laws of the fines were made for.

#include <string>
#include <vector>

#include "cases/build.hpp"

namespace puffin::tools {

/// Of the contacts that began in the last interval: logs and appends to `warnings` the first impact on a wall, and the
/// first between carriers, that is faster than the range of validity of a law that it asks, unless one of its kind
/// stands there. Slower ones are not told: every contact that ends at rest has some.
void warn_beyond_laws(const cases::Simulation& s, std::vector<std::string>& warnings);

/// After a retreat to `time` [s]: takes the warnings of later impacts out, which have not happened.
void forget_beyond_laws(double time, std::vector<std::string>& warnings);

}  // namespace puffin::tools
