#pragma once
// report.html: what a run came to, for a reader in a lab. One file, no network, prints well.

#include <filesystem>
#include <string>

namespace puffin::output {

/// The page for one run, from its summary.json, history.csv and vtk/. Pictures are painted and embedded (and kept in
/// images/); sections without data say why they are left out. Throws OutputError if there is no summary.json.
std::string make_report(const std::filesystem::path& run);

}  // namespace puffin::output
