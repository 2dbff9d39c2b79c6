#pragma once
// A carrier drags the air along that it then reads: the velocity at its place contains its own disturbance, and its
// slip comes out too small by a part lambda. A drag law wants the slip to the air as it would be without the carrier.
//
// Far from others the disturbance is that of a steady force F spread with a bump of standard deviation s and read with
// the same bump, in air that passes at the slip U (Oseen's equation, in wave numbers k, q = s k, c = cos of k and U):
//   u = F/(4 pi^2 mu s) int (1 - c^2) int exp(-q^2) q^2/(q^2 + (R c)^2) dq dc = F/(6 pi^(3/2) mu s) Psi(R),  R = U
//   s/nu, Psi(R) = 3/2 int_0^1 (1 - c^2) (1 - sqrt(pi) R c exp((R c)^2) erfc(R c)) dc,                              (1)
// Psi(0) = 1 (Stokes: Maxey & Patel, Int. J. Multiphase Flow 27, 1603 (2001), with F = 6 pi mu a U at a = s sqrt(pi)),
// and falls as 1/R. With F = beta U it is lambda U with
//   lambda = beta Psi(R)/(6 pi^(3/2) mu s).                                                                   (2)
// s^2 is the variance of the coupling kernel (kernel.hpp): roma_variance max(dx, d)^2. The lattice answers waves of a
// few cells more weakly than (1) says; lattice_answer() is what is left, and lambda is multiplied with it. At 70 um,
// 0.15 m/s and 0.25 mm lambda = 0.08; at 10 m/s 0.01. The idea of taking it off: Balachandar, Liu & Lakhote, Int. J.
// Multiphase Flow 114, 1 (2019). Of a parcel's carriers each takes off its own part, not that of the others. Among
// others the drag laws know a mean velocity that includes everybody's part: there lambda is weighted with the entry's
// share of the solid volume that it sees. Walls within a few kernel widths weaken the disturbance, eddy viscosity too:
// (2) is then too large. Checked by: tests/coupling/test_self_disturbance.cpp

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "coupling/kernel.hpp"
#include "coupling/state.hpp"

namespace puffin::coupling {

/// exp(b^2) erfc(b), b >= 0; beyond 5 by its asymptotic series, good to 1e-6.
inline double scaled_erfc(double b) {
  if (b < 5.0) return std::exp(b * b) * std::erfc(b);
  const double i2 = 0.5 / (b * b);
  return (1.0 - i2 * (1.0 - 3.0 * i2 * (1.0 - 5.0 * i2))) / (b * std::sqrt(std::numbers::pi));
}

/// Eq. (1) by Gauss and Legendre's rule in x = c^(1/2), which crowds where the integrand changes for large R; within
/// 0.5 % up to R = 50, 2 % at 100, where it is 0.013.
inline double oseen_factor(double r) {
  constexpr std::array<double, 8> node{0.0198550717512319, 0.101666761293187, 0.237233795041836, 0.408282678752175,
                                       0.591717321247825,  0.762766204958164, 0.898333238706813, 0.980144928248768};
  constexpr std::array<double, 8> weight{0.0506142681451881, 0.111190517226687, 0.156853322938944, 0.181341891689181,
                                         0.181341891689181,  0.156853322938944, 0.111190517226687, 0.0506142681451881};
  double sum = 0.0;
  for (std::size_t n = 0; n < node.size(); ++n) {
    const double c = node[n] * node[n], b = r * c;
    sum += weight[n] * 2.0 * node[n] * (1.0 - c * c) * (1.0 - std::sqrt(std::numbers::pi) * b * scaled_erfc(b));
  }
  return 1.5 * sum;
}

/// Standard deviation [m] of the kernel of an entry of `diameter` [m] on cells of dx [m].
inline double kernel_width(double diameter, double dx) { return std::sqrt(roma_variance) * std::max(diameter, dx); }

/// Eq. (2) times `answer`, see lattice_answer(). in: drag coefficient of ONE carrier [kg/s], its slip to the
/// undisturbed air [m/s], kernel width [m], viscosity [Pa s] and density of the air [kg/m^3]. At most 0.8: a carrier
/// that would read more of itself than that is resolved by the lattice.
double self_disturbance(double beta, double slip, double width, double viscosity, double density, double answer = 1.0);

/// Changes `velocity` [m/s] from what the carriers read to the air without their own disturbance, and `beta` [kg/s] to
/// what the drag law says at that slip. Both by carrier index. `solid`: solid fraction at the carriers, or empty.
void take_off_self(const Models& models, std::span<const double> solid, const State& state, std::vector<Vec3>& velocity,
                   std::vector<double>& beta);

}  // namespace puffin::coupling
