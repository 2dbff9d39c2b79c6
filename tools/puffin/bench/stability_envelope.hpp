#pragma once
// From the rows of `puffin bench stability` to what `puffin check` knows of them.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "cases/stability_envelope.hpp"
#include "tools/puffin/bench/stability_plan.hpp"

namespace puffin::tools {

/// The rows of the scenes of the map (`map = true`), together by collision, eddy viscosity and wall: variations that
/// differ in something else, like the viscosity, count together. `scenes`: the folder with their case files, the
/// first of which with walls tells what a variation sets.
std::vector<cases::EnvelopeRow> envelope_of(const StabilityPlan& plan, const std::filesystem::path& scenes,
                                            const nlohmann::json& rows);

}  // namespace puffin::tools
