#pragma once
// Is there room for the case? Asked before anything of its size is allocated.

#include <stdexcept>

#include "cases/case.hpp"
#include "cases/surface.hpp"

namespace puffin::cases {

/// More cells, carriers or memory than there can be.
class TooLarge : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Most cells in the box around a device: places in a lattice are numbered with 32 bits.
inline constexpr double most_cells = 4294967296.0;

/// Cells of width dx in the box around the surface, at least one each way; 0 without a surface.
double cells_in_box(const Surface& s, double dx);

/// A lower bound of the memory of a run [byte]: the cells in the volume, their populations once, the carriers.
double least_memory(const Case& c, const Surface& s);

/// Throws TooLarge if the box around the device has more than most_cells cells, or the run needs for certain more than
/// `available` [byte].
void require_room(const Case& c, const Surface& s, double available);

}  // namespace puffin::cases
