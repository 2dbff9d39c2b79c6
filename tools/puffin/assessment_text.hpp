#pragma once
// The numbers of a case before it runs, for people and for scripts.

#include <nlohmann/json_fwd.hpp>

#include "cases/assessment.hpp"

namespace puffin::tools {

/// The keys of `puffin estimate --json` that need no clock: memory, steps, dt_min, dt_max, tau_min, mach_max,
/// cells_fluid, cells_active, and dx, volume, area, inlets, warnings.
nlohmann::json assessment_json(const cases::Case& c, const cases::Assessment& a);

/// Lines on stdout; warnings on stderr.
void print_assessment(const cases::Case& c, const cases::Assessment& a);

}  // namespace puffin::tools
