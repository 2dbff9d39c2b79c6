#pragma once
// Micro-model file (TOML) -> the laws of the fines. The keys of each law: micromodels/README.md.

#include <filesystem>
#include <string>

#include "cases/case_error.hpp"
#include "micromodels/fines_models.hpp"

namespace puffin::cases {

/// An absent table is a mechanism that does not act; every value may carry its unit. Tables of numbers (law = "table")
/// are CSV files beside this one with a header line: speed, fraction (or rate), and, if wanted, angle [degrees].
/// Throws CaseError with every problem of the file, std::system_error if it cannot be read.
micromodels::FinesModels read_micromodels(const std::filesystem::path& file);

/// The text of the file, and behind it, as comments, the tables that it names: what a run keeps of its laws, equal only
/// for equal laws. A table that cannot be read is left out. Throws as read_micromodels where the file is no TOML.
std::string micromodels_with_tables(const std::filesystem::path& file);

}  // namespace puffin::cases
