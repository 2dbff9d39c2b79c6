#pragma once
// The small languages inside strings: "solid:inlet", "slice:z=2.2mm", "box:[...]". All throw std::invalid_argument
// (UnitError is one) saying what is wrong and what can stand there.

#include <string>
#include <string_view>

#include "cases/case.hpp"

namespace puffin::cases::format {

/// "solid:NAME", "plane:x-min" ... "plane:z-max" or "near:[x,y,z]", the point rewritten in metres.
std::string canonical_selection(std::string_view text);

/// "all", "slice:z=2.2mm" or "box:[x0,y0,z0,x1,y1,z1]" (lowest corner, highest corner; [[..],[..]] is read too).
Region parse_region(std::string_view text);
std::string format_region(const Region& region);

/// "x" | "y" | "z" -> 0 | 1 | 2.
int parse_axis(std::string_view text);
std::string_view axis_name(int axis);

}  // namespace puffin::cases::format
