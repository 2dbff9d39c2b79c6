#pragma once
// How strong a wind takes a carrier off the wall, and what bundling carriers into parcels does to that.

#include <string>

#include "cases/case.hpp"
#include "coupling/state.hpp"

namespace puffin::cases {

/// Slip [m/s] at which the drag on an entry equals the force that holds it to the wall: `single` for one carrier alone,
/// `parcel` for a parcel of `count`, whose drag is that of `count` single carriers and whose adhesion follows
/// parcel_scaling. 0 without adhesion; infinite without drag. The drag law at solid fraction 0.
/// in: diameter of one carrier [m], > 0; carriers in a parcel, >= 1
struct LiftOff {
  double single = 0.0, parcel = 0.0;
};
LiftOff lift_off(const coupling::Models& models, double diameter, double count);

/// The bias of parcels in a sentence, with both speeds.
std::string parcel_bias(const Carriers& carriers, const coupling::Models& models);

}  // namespace puffin::cases
