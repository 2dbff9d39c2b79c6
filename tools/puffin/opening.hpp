#pragma once
// How a run begins: what is wrong or doubtful with its case is said before it moves.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cases/build.hpp"
#include "cases/read_case.hpp"
#include "tools/output/output_folder.hpp"

namespace puffin::tools {

/// [s] When the case would end without the preset that `c` was read with.
double stop_time_of(const cases::Case& c, const std::filesystem::path& case_file,
                    const std::vector<cases::Override>& sets, const std::string& preset);

/// cases::build within the memory that there is; what the parts find wrong with their numbers is a mistake of the case.
/// beds: as of RunOptions. Throws cases::CaseError, cases::TooLarge.
std::unique_ptr<cases::Simulation> built(const cases::Case& c, const std::filesystem::path& case_file,
                                         const std::filesystem::path& beds);

/// Of places in vain, and of what the run does otherwise than described. Throws as PointReader::check_places.
std::vector<std::string> first_warnings(const cases::Simulation& s);

/// The case as it runs, and beside it the laws of its fines, whose file may change later: case.toml, micromodels.toml.
void keep_case(const cases::Case& c, const output::OutputFolder& folder);

/// The run's first line, and where its dose comes from.
void log_beginning(const cases::Simulation& s, int threads, const std::filesystem::path& out);

}  // namespace puffin::tools
