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
//     b_p = beta_p / max(1, G_p / most).                                                                 (1)
// and most = 1 (below). Then K E = Y X with Y = K diag(beta) D, X = diag(1/max(1, G)); it has the eigenvalues of X Y, a
// non-negative matrix with row sums min(G_p, 1): so they lie in [0, 1], and the slips of that model decay at every
// load.
//
// What it leaves out: the N steps of the interval. The air's motions y take y' = mu (y + a) in a step, a = -G s/N, with
// the sample s of the interval before; |mu| = 1 where nothing damps: 1 for what stays, -1 for what changes sign from
// step to step, e^(i theta) for sound. Read in the last step alone, s = y_(N-1) + a/2, mu = -1 grows by 1 + G/N an
// interval where N is odd, whatever G. So two instants are averaged (air_steps.cpp), which do not see mu = -1:
//   N = 1: the step and its end. Nothing grows up to G = 1, whatever mu.
//   N > 1: the last two steps (the end of the last would cost a sweep of its own). What stays decays up to G = 2. Sound
//          meets a reaction half its period late and would grow by up to 1.24 an interval at G = 1/2, N = 2, but decays
//          with its own damping where the collision relaxes the trace at once (bulk viscosity 1/9): largest factor
//          0.95 (N = 2), 0.94 (5), 0.97 (8) at G = 1/2, 1.13, 1.11, 1.14 at G = 1; 0.95 at G = 1/4, N = 16.
// Hence most = 1 for N = 1, 1/2 to N = 8, 1/4 to 16 and 1/8 to 64; and where the load is larger than 1/2 the exchange
// comes more often (exchange_interval.cpp), so that the limit lowers the drag only of what is too much for a single
// step. The mover is handed b_p and u_p and returns J_p, the air gets -J_p: (1) changes the size of J_p, not who gets
// it.
//
// Where G <= most nothing is changed. Rejected: b = beta/(1 + G), which is backward Euler for one carrier and one cell.
// In a steady bed the air is renewed by the flow between two exchanges, and that factor would lower the drag (and the
// pressure drop) of the bed by G/(1 + G): 18 % at a solid fraction of 0.3, cells of 0.23 mm and D = 8e-7 s.

#include <span>

#include "coupling/scale.hpp"
#include "coupling/transfer.hpp"

namespace puffin::coupling {

/// Limits the drag coefficients `beta` [kg/s] (by carrier index) of the carriers in `stencils` by eq. (1).
/// `interval` [s]: time between two exchanges; `most`: largest load that needs no limit. `scratch`: by carrier index,
/// any content; receives G_p.
void limit_drag(const Stencils& stencils, double interval, const Scale& scale, Spreader& spreader,
                std::span<double> scratch, std::span<double> beta, double most = 1.0);

/// The same beside walls, where drag is larger across them than along: `beta` along, `excess` what it is more across,
/// both [kg/s] by carrier index. With G^a of the one and G^e of the other, limited as in (1), the excess has what beta
/// leaves:
///     x_a = min(1, most/G^a_p),  x_e = min(1, (most - G^a_p)/G^e_p) or 0,
/// and both the same reduction where (x_a beta + x_e excess)_p/(beta + excess)_p (G^a + G^e)_p still is beyond `most`,
/// as among carriers of unequal drag; that is the row sum of which the proof above speaks. One limit for the larger of
/// the drags would take away that along the wall, too, wherever the gap is narrow. `loads`: receives G^a.
void limit_drag_beside_walls(const Stencils& stencils, double interval, const Scale& scale, Spreader& spreader,
                             std::span<double> loads, std::span<double> beta, std::span<double> excess, double most);

/// `most` for an interval of so many air steps.
inline double largest_load(double steps) {
  if (steps < 1.5) return 1.0;
  return steps < 8.5 ? 0.5 : steps < 16.5 ? 0.25 : 0.125;
}

/// An upper bound of G_p from numbers that are known already: sum_q w_qj beta_q <= max(beta/V) sum_q w_qj V_q, so
///     G <= largest_fraction * max(beta_q / V_q) * interval / density.
/// Where it is below `most`, limit_drag would change nothing and can be left out. in: largest solid fraction of a cell
/// before the limit (solid_fraction returns it); `beta` [kg/s] and `solid_volume` [m^3] by carrier index.
double load_bound(double largest_fraction, std::span<const double> beta, std::span<const double> solid_volume,
                  double interval, const Scale& scale);

}  // namespace puffin::coupling
