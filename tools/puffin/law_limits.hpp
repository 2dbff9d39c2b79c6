#pragma once
// Impacts and drag beyond what the laws of the fines were made for.

#include <string>
#include <vector>

#include "cases/build.hpp"

namespace puffin::tools {

/// Of the contacts that began in the last interval, and of the slip of the carriers in it: logs and appends to
/// `warnings` the first impact on a wall, the first between carriers and the first slip that is faster than the range
/// of validity of a law that it asks, and the first that is slower and takes fines off all the same (every contact that
/// ends at rest has slow ones, which take nothing), unless one of its kind stands there.
void warn_beyond_laws(const cases::Simulation& s, std::vector<std::string>& warnings);

/// After a retreat to `time` [s]: takes the warnings of later impacts out, which have not happened.
void forget_beyond_laws(double time, std::vector<std::string>& warnings);

}  // namespace puffin::tools
