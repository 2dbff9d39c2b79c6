#pragma once
// Sections of a study's page that need more than its tables: pictures, and what was measured.

#include <filesystem>
#include <string>

#include "tools/output/study_results.hpp"

namespace puffin::output {

/// "0.412 &plusmn; 0.03": the mean with the half width of its 95 % interval, if there are replicates.
std::string with_interval(const Estimate* e, double factor = 1.0);
/// "36.0": the mean flow rate [L/min] that a case's pressure drops are of.
std::string flow_rate_of(const StudyCaseResult& c);
/// The first replicate that is done; nullptr if none is.
const StudyRun* first_done(const StudyCaseResult& c);

/// The devices and their air: geometry, streamlines at four times over all and at the pocket. Of the first case of each
/// device that stores them.
std::string device_section(const StudyResults& results, const std::filesystem::path& study);
/// Every case: carriers at four times, what is left at the end, what landed on the walls.
std::string carrier_section(const StudyResults& results, const std::filesystem::path& study);
/// By device: every case beside the experiments; then the experiments themselves, by copy and test by test. "" without.
std::string experiment_section(const StudyResults& results);
/// Which cases were run with a preset or not to their end. "" if all are as they stand.
std::string trial_section(const StudyResults& results);
/// What runs warned of, each warning once: of a whole case or of some of its replicates. "" without.
std::string warning_section(const StudyResults& results);
/// What every case assumes, each assumption once.
std::string assumption_section(const StudyResults& results);
/// Where the time of each case went, and what was skipped.
std::string effort_section(const StudyResults& results);

}  // namespace puffin::output
