#pragma once
// Makes a run of the validation catalogue as `puffin run` does, and gives its output to the evaluation.

#include <filesystem>

#include "cases/verification/evaluate.hpp"
#include "tools/puffin/run.hpp"

namespace puffin::tools {

/// The outputs of a finished run. Tables are read when they are asked for, and kept.
/// Throws OutputError if there is no summary.
cases::RunOutput read_run(const std::filesystem::path& folder);

}  // namespace puffin::tools
