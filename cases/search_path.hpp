#pragma once
// Where the files that come with Puffin are.

#include <filesystem>
#include <span>
#include <string>

namespace puffin::cases {

/// Folders searched for micro-model files after the case file's own: share/puffin/cases/micromodels of the installation
/// that the program runs from, then cases/micromodels of the source tree it was built from.
std::span<const std::string> micromodel_directories();

/// The validation catalogue: share/puffin/cases/verify of the installation that the program runs from, or, where there
/// is none, cases/verify of the source tree it was built from.
std::filesystem::path verification_directory();

/// Likewise the scenes of `puffin bench stability`.
std::filesystem::path stability_directory();

/// The cases of `puffin bench pareto`: share/puffin/cases/bench of the installation, or cases/bench of the source tree.
std::filesystem::path bench_directory();

/// The file as given if it is there, else the one of that name in micromodel_directories(), else as given.
std::filesystem::path found_micromodels(const std::filesystem::path& file);

}  // namespace puffin::cases
