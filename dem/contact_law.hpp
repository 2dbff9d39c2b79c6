#pragma once
// The law of a live contact, one contact at a time.

#include <cmath>

#include "dem/springs.hpp"

namespace puffin::dem::single {

inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
inline bool any(bool mask) { return mask; }
inline double maximum(double a, double b) { return a < b ? b : a; }
inline double minimum(double a, double b) { return b < a ? b : a; }
inline double root(double a) { return std::sqrt(a); }

#include "dem/contact_law.inc.hpp"

}  // namespace puffin::dem::single
