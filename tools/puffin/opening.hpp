#pragma once
// How a run begins: what is wrong or doubtful with its case is said before it moves.

#include <filesystem>
#include <memory>

#include "cases/build.hpp"

namespace puffin::tools {

/// cases::build within the memory that there is; what the parts find wrong with their numbers is a mistake of the case.
/// beds: as of RunOptions. Throws cases::CaseError, cases::TooLarge.
std::unique_ptr<cases::Simulation> built(const cases::Case& c, const std::filesystem::path& case_file,
                                         const std::filesystem::path& beds);

}  // namespace puffin::tools
