#pragma once
// What the carriers read of the air and what they give back, both through the same stencils: interpolation is the
// transpose of spreading, so the power that a carrier takes from the air at its sampled velocity is the power that the
// air loses in its cells. Beside walls it is not: there the cells lie further out than the carrier.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "coupling/scale.hpp"
#include "coupling/stencils.hpp"
#include "lbm/moments.hpp"

namespace puffin::coupling {

/// The air at the carriers, by carrier index, in lattice units. Zero where a carrier has no stencil.
struct AirSamples {
  std::vector<Eigen::Vector3d> velocity_lu;
  std::vector<Eigen::Vector4d> in_cells;  // by slot, scratch: the velocity of the cells that are read
};

/// Gradients of the air at the carriers, by carrier index, a cell.
struct AirGradients {
  std::vector<Eigen::Matrix3d> velocity_lu;        // (a,b) = d u_a / d x_b
  std::vector<Eigen::Vector3d> density_excess_lu;  // a third of it is the pressure gradient
};

/// The carriers' velocity of the air, u_m = sum_j w_pj u_j, and where walls cut the kernel
///     u_p = u_m + min(1, (|u_m| + U)/|d|) d,   d = sum_j s_pj u_j,   U: `wall_speed_lu`, of the fastest wall.
/// Exact for linear fields beside plane walls too, where the air has the wall's velocity: there |d| <= |u_m - u_wall|.
/// The limit keeps what is read from going past the velocity of a wall at rest. Arrays grow to `carriers`.
void interpolate(const Stencils& stencils, const lbm::Moments& moments, std::size_t carriers, AirSamples& samples,
                 double wall_speed_lu = 0.0);

/// Gradients by least squares over the stencil, weighted by its weights:
///     g = C^-1 sum_j w_j (x_j - x_m)(f_j - f_m),  C = sum_j w_j (x_j - x_m)(x_j - x_m)^T,  x_m, f_m: weighted means.
/// Exact for linear fields, beside walls too. In a direction in which the stencil is one cell thick the gradient is 0.
void interpolate_gradients(const Stencils& stencils, const lbm::Moments& moments, std::size_t carriers,
                           AirGradients& gradients);

/// The books of one spreading, [N s]. given = taken up to the rounding of doubles (1e-15 a carrier, relative to
/// `exchanged`); what the float force of the lattice adds to that is `rounding`.
struct MomentumBooking {
  Eigen::Vector3d given = Eigen::Vector3d::Zero();     // sum of the carriers' impulses on the air
  Eigen::Vector3d taken = Eigen::Vector3d::Zero();     // sum over the cells, in double
  Eigen::Vector3d rounding = Eigen::Vector3d::Zero();  // sum over the cells of float force minus double force
  double exchanged = 0.0;                              // sum of |impulse|: the scale of an error
};

/// Adds what carriers give into cells. Holds the double sums of one field a slot; they are zero between calls.
class Spreader {
 public:
  Spreader() = default;
  explicit Spreader(std::size_t slots) : momentum_(slots, Eigen::Vector4d::Zero()), scalar_(slots, 0.0) {}

  /// Gives every cell of the stencils the force  F_j = sum_p w_pj J_p / interval  (lattice units).
  /// in: `impulse` [N s] on the air by carrier index; `interval` [s] during which the force will act.
  /// The cells must hold no force: clear() those of the interval before first.
  MomentumBooking spread(const Stencils& stencils, std::span<const Eigen::Vector3d> impulse, double interval,
                         const Scale& scale, lbm::BodyForce& force);
  /// Sets the force of cells to zero.
  static void clear(std::span<const std::int32_t> slots, lbm::BodyForce& force);

  /// s_j = sum_p w_pj value_p in every cell, limited to `ceiling`, and read back: result_p = sum_j w_pj s_j.
  /// in: `value` >= 0 by carrier index; out: `result` by carrier index (0 without a stencil; others are left alone).
  /// Returns the largest s_j, before the limit.
  double smooth(const Stencils& stencils, std::span<const double> value, double ceiling, std::span<double> result);

  /// s_j as above, for every cell of the stencils once, ascending.
  void collect(const Stencils& stencils, std::span<const double> value, std::vector<std::int32_t>& slots,
               std::vector<double>& sums);

 private:
  void add(const Stencils& stencils, std::span<const double> value);  // s_j into scalar_

  std::vector<Eigen::Vector4d> momentum_;  // by slot [N s]; the fourth place fills the register
  std::vector<double> scalar_;             // by slot
};

}  // namespace puffin::coupling
