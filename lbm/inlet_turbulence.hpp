#pragma once
// Synthetic turbulence on a velocity inlet: random Fourier modes that the mean flow carries through the opening.
//
//   u'(x, s) = I U sqrt(6/N) sum_n sigma_n cos(k_n . (x - s e) + phi_n),   sigma_n . k_n = 0: free of divergence,
// I the intensity (rms of each component over the mean speed U), e the direction of the mean flow and s the way it has
// gone (Taylor's frozen turbulence), so a ramp slows the eddies down with the air. The wave numbers share the energy of
// the von Karman spectrum E(k) ~ k^4 / (k_e^2 + k^2)^(17/6), k_e = 0.747/L, equally among the modes; modes shorter than
// four cells are left out. Modes come in threes with orthogonal sigma: the components' variances are equal, exactly.
// Each mode's net flow through the opening is taken off, so that the flow rate is the given one in every step.
// Source: Kraichnan, Phys. Fluids 13, 22 (1970); Davidson, Flow Turbul. Combust. 79, 443 (2007).

#include <cstdint>
#include <vector>

#include "lbm/air.hpp"

namespace puffin::lbm {

struct InletTurbulence {
  int boundary = -1;
  std::vector<std::int32_t> links;   // into Links::inlets
  std::vector<float> cosine, sine;   // [link][mode]: population gained for a unit mean speed
  std::vector<double> along, phase;  // per mode: wave number along the mean flow [1/cell], phase
};

/// Modes on the links of one inlet, or of one face of several. intensity: rms of a component over the mean speed;
/// length: integral length scale [cells]; equal seeds give equal turbulence. Throws std::invalid_argument unless
/// intensity >= 0 and length > 0.
InletTurbulence make_inlet_turbulence(const Air& air, int boundary, double intensity, double length, std::uint64_t seed,
                                      int part = 0);

/// Adds the fluctuations to `gain` (one value an inlet link) after the mean flow has gone `way` cells, at a mean speed
/// of `speed` [lattice units].
void add_fluctuation(const InletTurbulence& turbulence, double way, double speed, std::vector<float>& gain);

}  // namespace puffin::lbm
