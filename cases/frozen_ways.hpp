#pragma once
// Which patches a frozen field that carries fines may blow through.

#include <functional>
#include <string>
#include <vector>

#include "cases/surface.hpp"

namespace puffin::cases {

/// The case with a boundary for each patch that has none and through which a frozen field passes, as carriers do
/// (is_opening in build_carriers.cpp): closed, the cells beside them would be emptied or filled by it.
Case with_open_patches(Case c, const Surface& surface);

/// A text for each patch without a boundary that lets air pass, through which the frozen field blows by more than a
/// twentieth of its area times the largest speed: fines that come there end the run. (A field between points may cross
/// a wall by a little.)
std::vector<std::string> closed_ways(const Case& c, const Surface& surface, double speed,
                                     const std::function<Vec3(const Vec3&)>& field);

}  // namespace puffin::cases
