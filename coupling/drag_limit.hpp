#pragma once
// Many carriers in one cell can hold more drag than the cell holds momentum: then a reaction computed from the air as
// it was overshoots. Here the drag coefficient that BOTH sides use is limited such that it cannot, at any load.
//
// Over one interval D the mover takes drag implicitly and the air explicitly, with the same weights both ways:
//     J_p = b_p D (u_p - v_p'),   u_p = sum_j w_pj u_j,   u_j' = u_j - sum_p w_pj J_p / (rho dx^3).
// With E = diag(b_p D), M = diag(m_p) and K_pq = sum_j w_pj w_qj / (rho dx^3) the slips s = u - v at the carriers obey
//     s' = (1 - K E)(1 + E M^-1)^-1 s.
// K E, similar to E^1/2 K E^1/2, has real eigenvalues >= 0. In the norm |s|^2 = s.E s the first factor is a contraction
// if none exceeds 1 (above 2 the air would oscillate and grow), and the diagonal second factor always is.
// Let beta_p be the coefficient that the drag law asks for, and
//     G_p = sum_q K_pq beta_q D = sum_j w_pj sum_q w_qj beta_q D / (rho dx^3),
//     b_p = beta_p / max(1, G_p).                                                                        (1)
// Then K E = Y X with Y = K diag(beta) D, X = diag(1/max(1, G)); it has the eigenvalues of X Y, a non-negative matrix
// with row sums min(G_p, 1): so they lie in [0, 1], and the slips decay at every load, without oscillation.
// The mover is handed b_p and u_p and returns J_p, the air gets -J_p: (1) changes the size of J_p, not who gets it.
//
// Where G <= 1 nothing is changed. Rejected: b = beta/(1 + G), which is backward Euler for one carrier and one cell. In
// a steady bed the air is renewed by the flow between two exchanges, and that factor would lower the drag (and the
// pressure drop) of the bed by G/(1 + G): 18 % at a solid fraction of 0.3, cells of 0.23 mm and D = 8e-7 s.

#include <span>

#include "coupling/scale.hpp"
#include "coupling/transfer.hpp"

namespace puffin::coupling {

/// Limits the drag coefficients `beta` [kg/s] (by carrier index) of the carriers in `stencils` by eq. (1).
/// `interval` [s]: time between two exchanges. `scratch`: by carrier index, any content; receives G_p.
void limit_drag(const Stencils& stencils, double interval, const Scale& scale, Spreader& spreader,
                std::span<double> scratch, std::span<double> beta);

/// An upper bound of G_p from numbers that are known already: sum_q w_qj beta_q <= max(beta/V) sum_q w_qj V_q, so
///     G <= largest_fraction * max(beta_q / V_q) * interval / density.
/// Where it is below 1, limit_drag would change nothing and can be left out. in: largest solid fraction of a cell
/// before the limit (solid_fraction returns it); `beta` [kg/s] and `solid_volume` [m^3] by carrier index.
double load_bound(double largest_fraction, std::span<const double> beta, std::span<const double> solid_volume,
                  double interval, const Scale& scale);

}  // namespace puffin::coupling
