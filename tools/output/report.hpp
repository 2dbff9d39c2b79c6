#pragma once
// report.html: what a run came to, for a reader in a lab. One file, no network, prints well.

#include <filesystem>
#include <string>

namespace puffin::output {

/// The page for one run, from its summary.json, history.csv and vtk/. Pictures are painted and embedded (and kept in
/// images/); sections without data say why they are left out. Throws OutputError if there is no summary.json.
std::string make_report(const std::filesystem::path& run);

/// The page for a study: the cases beside each other and beside what is given for them, from study.json and the runs'
/// summaries and histories. Every number of its tables and bars is in results.csv and runs.csv, every curve in the
/// history.csv of its run. Throws OutputError if there is no study.json.
std::string make_study_report(const std::filesystem::path& study);

}  // namespace puffin::output
