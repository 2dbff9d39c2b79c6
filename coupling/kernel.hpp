#pragma once
// The one kernel that reads the air at a carrier and gives the carrier's reaction back to the air.
//
// A carrier (or parcel) of diameter d sees the air through a tensor product of three equal one-dimensional kernels
//
//     W(x) = integral G(s) R((x - s)/dx) ds,                                                          (1)
//
// R: the 3-point kernel of Roma, Peskin & Berger, J. Comput. Phys. 153, 509 (1999), eq. 22, half width 1.5 cells;
// G: a bump (15/16 B)(1 - (s/B)^2)^2 of physical half width B; B = 0 (no bump) where dx >= d.
//
// R obeys  sum_j R(j - r) = 1  and  sum_j (j - r) R(j - r) = 0  for every r. An average over s keeps both, so W
// reproduces constants and linear fields exactly, whatever dx, d and the position are. Its variance is that of R
// plus that of G:  V dx^2 + B^2/7,  V = 0.298467. For dx < d the width B is chosen such that the variance stays
// V d^2: the air that the carrier sees no longer depends on dx, with a standard deviation of 0.55 d and a half width
// between 1.5 d (dx = d) and 1.45 d (dx -> 0). At dx = d both forms are the same: B rises from 0 like (d - dx)^(1/2).
//
// Rejected: R stretched to the width d. Between whole multiples of dx it loses both sums; after renormalisation a
// linear field is wrong by several per cent. A radial (1 - r^2)^2 has the same defect on coarse grids.

#include <vector>

namespace puffin::coupling {

/// Roma's 3-point kernel, `r` = distance in cells; 0 beyond 1.5.
double roma(double r);

/// Continuous variance of Roma's kernel in cells squared: integral r^2 R(r) dr.
inline constexpr double roma_variance = 0.29846673730727;

/// Eq. (1) for one ratio of the diameter to the cell, with the integral over G as a sum of nodes not farther apart than
/// half a cell and scaled to the exact variance.
class Kernel {
 public:
  /// Widest stencil: 2 * max_reach + 1 cells a direction.
  static constexpr int max_reach = 15;

  Kernel() : Kernel(0.0) {}
  /// `diameter_in_cells` = d/dx >= 0. Throws std::invalid_argument beyond 9: such a body is resolved by the lattice and
  /// wants a moving wall, not a kernel.
  explicit Kernel(double diameter_in_cells);

  /// Cells on each side of the nearest one that can have weight.
  int reach() const { return reach_; }
  double diameter_in_cells() const { return diameter_; }
  /// Weights of the cells -reach ... +reach around the nearest one; `offset` = carrier minus cell centre [cells], in
  /// [-1/2, 1/2]. `weights` has 2 reach + 1 places; they sum to 1 up to rounding.
  void weights(double offset, double* weights) const;

 private:
  struct Node {
    double shift, weight;  // [cells], sums to 1
  };
  double diameter_ = 0.0;
  int reach_ = 1;
  std::vector<Node> nodes_;
};

}  // namespace puffin::coupling
