#pragma once
// Constants of laws from the outcome of whole devices: the fines of stored runs, replayed until they fit.

#include <map>
#include <string>
#include <vector>

#include "micromodels/derivation/least_squares.hpp"
#include "micromodels/fines_models.hpp"
#include "tools/puffin/replay_record.hpp"

namespace puffin::tools {

/// A fraction that a run shall have: FFE, FFW, FFCR or FFCE of its first scalar.
struct Target {
  std::size_t run = 0;
  std::string quantity;
  double value = 0.0, ours = 0.0;
};

/// A constant by its name: "wall_detach.A0" ... "A4" (power), ".limit", ".spread", ".surface_energy" (lift-off),
/// ".limit", ".energy_ratio", ".shape" (weibull), or "wall_detach.scale": A0 and A3, or the limit, together.
struct FreeConstant {
  std::string name;
  micromodels::derivation::Estimate estimate;
  bool at_end_of_reach = false;
};

struct Calibration {
  micromodels::FinesModels models;
  std::vector<FreeConstant> constants;
  std::vector<Target> targets;  // with ours after the fit
  double rms = 0.0;             // of ours - value
};

/// How far a constant may go from its start: to this many times, or this part of it. A law that takes all the fines
/// there are, or none, feels no more of it, so that without an end a fit goes on to any number.
constexpr double calibration_reach = 1000.0;

/// Least squares in the logarithms of the constants, which stay positive. The fates of airborne fines are those of each
/// run. Throws std::invalid_argument if a constant is unknown or 0, or there are fewer targets than constants.
Calibration calibrate(const micromodels::FinesModels& start, const std::vector<StoredRun>& runs,
                      const std::vector<Target>& targets, const std::vector<std::string>& constants);

}  // namespace puffin::tools
