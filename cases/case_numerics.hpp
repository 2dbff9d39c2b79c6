#pragma once
// [numerics]: lattice, collision, walls, skips.

#include <cstdint>
#include <optional>

#include "cases/case_values.hpp"

namespace puffin::cases {

enum class TimeStepRule { follow_ramp, fixed, given };
enum class Collision { bgk, trt, rr3, hrr, central_moments };
enum class WallScheme { bouzidi, ibm, psm, halfway };
enum class Les { none, smagorinsky, vreman };
enum class Precision { float32, float64 };
/// What a run leaves out because the answer does not need it. All on by default; `puffin bench skip` measures each.
struct Skip {
  bool sleeping_carriers = true;  // carriers at rest are not moved until something disturbs them
  bool free_flight = true;        // carriers that touch nothing are moved in closed form, not by contact steps
  bool resting_exchange = true;   // fewer exchanges with the air while every carrier rests
  bool idle_transport = true;     // no transport of a scalar while next to none of it is airborne
  bool empty_cells = true;        // no transport where there are no fines nearby
  bool transport_steps = true;    // transport in longer steps than the air's
  bool operator==(const Skip&) const = default;
};
/// Of numerics.lattice_speed: what all scenes of `puffin bench stability` run at.
inline constexpr double default_lattice_speed = 0.10;
/// [cells a step] Beyond it no scheme here is stable.
inline constexpr double largest_lattice_speed = 0.3;
struct Numerics {
  std::optional<double> dx;               // [m]; exactly one of dx and cells is given
  std::optional<std::int64_t> cells;      // wanted number of fluid cells: dx = cbrt(volume / cells)
  double lattice_speed = 0.0;             // the reference speed in lattice units
  std::optional<double> reference_speed;  // [m/s]; empty: "auto", the largest section-mean speed of the run
  TimeStepRule time_step = TimeStepRule::follow_ramp;
  double time_step_seconds = 0.0;  // [s], time_step = given
  Collision collision = Collision::rr3;
  double hrr_sigma = 0.0;  // share of the cell's own stress in the collision hrr
  WallScheme wall = WallScheme::bouzidi;
  Les les = Les::smagorinsky;
  double smagorinsky_constant = 0.0;
  bool wall_model = false;
  Precision precision = Precision::float32;
  int coupling_interval = 5;  // air steps between two exchanges with moving carriers
  double scalar_cfl = 0.8;    // largest part of a cell's air that leaves it in one step of the transport
  Skip skip;
  int threads = 0;  // 0: all
  std::uint64_t seed = 0;
  bool operator==(const Numerics&) const = default;
};

}  // namespace puffin::cases
