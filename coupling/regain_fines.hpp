#pragma once
// Fines that come back to carriers: from the air that slips by, and from walls that they hit. Beyond the founding study
// (its 5.4), off unless asked for.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "coupling/fines.hpp"
#include "coupling/stencils.hpp"
#include "dem/carriers.hpp"
#include "dem/events.hpp"

namespace puffin::coupling {

struct Regain {
  double sticking = 0.0;       // of the airborne fines that meet a carrier, the part that stays; 0: off
  double pick_up = 0.0;        // of the fines in reach on a wall, the part that a hit takes along; 0: off
  double fine_diameter = 0.0;  // [m]
  double response_time = 0.0;  // of the fines [s]
  std::vector<double> area;    // of the wall's triangles [m^2]
};

/// Fines that meet a sphere over those in the tube of air of its diameter, in potential flow:
///   impaction K^2/(K + 1/2)^2, K = tau v/R (0 below 1/12), plus interception (1 + r)^2 - 1/(1 + r), r = d_f/d_c.
/// Source: I. Langmuir, J. Meteorol. 5, 175 (1948); N. A. Fuchs, The Mechanics of Aerosols (1964), section 34. At the
/// carriers' Reynolds numbers (up to 300) potential flow is an upper bound. Diffusion of fines above 1 um is left out.
double collection_efficiency(double slip, double carrier_diameter, double fine_diameter, double response_time);

/// Airborne fines to the carriers in `stencils` during `duration` [s], at the slip speeds `slip` [m/s] (by place):
/// each cell of a stencil loses 1 - exp(-weight E sticking (pi/4) d_c^2 v n duration/dx^3) of its fines, n the carriers
/// of a parcel. For one set of scalars.
void reattach(const Stencils& stencils, std::span<const double> slip, double duration, double dx,
              const dem::Carriers& carriers, const Regain& regain, Fines& fines, lbm::ScalarFields& fields);

/// Fines from the walls that the contacts begun after the first motion touch: within the gap of one fine a carrier
/// covers pi d_c d_f of the wall; `pick_up` of what sticks there (Fines::stuck over the triangle's area, never more
/// than that) goes along. In the order of the contacts. Fines that the air has deposited stay.
void pick_up_from_walls(std::span<const dem::ContactBegun> begun, const std::optional<double>& first_motion,
                        const dem::Carriers& carriers, const Regain& regain, Fines& fines);

}  // namespace puffin::coupling
