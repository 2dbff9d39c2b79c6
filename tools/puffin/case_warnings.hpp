#pragma once
// What is doubtful about a case before it is run: told by `puffin check`, and by the run itself.

#include <string>
#include <vector>

#include "cases/assessment.hpp"

namespace puffin::tools {

/// Adds what the map of stability has against the case's settings: they diverged there, or are not in it.
void warn_of_stability(const cases::Case& c, cases::Assessment& assessment);

/// The warnings of the assessment, but for that of tau, and of the map of stability. It finds the cells once more (half
/// a second for a device of 200,000), and takes its memory only meanwhile. Empty if the case cannot be assessed: then
/// its run says why.
std::vector<std::string> assessment_warnings(const cases::Case& c);

/// Appends those that are not there yet.
void add_new(const std::vector<std::string>& more, std::vector<std::string>& warnings);

}  // namespace puffin::tools
