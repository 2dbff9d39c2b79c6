#pragma once
// The laws of the fines as a micro-model file.

#include <map>
#include <string>

#include "micromodels/fines_models.hpp"

namespace puffin::cases {

/// TOML text that read_micromodels() reads back to equal laws. `comments`: lines put before a table, by its name
/// ("wall_detach"), or at the head (""); each line gets its "# ". `table_files`: the CSV of a table law, by the table's
/// name. Throws std::invalid_argument for a table law without a file.
std::string write_micromodels(const micromodels::FinesModels& models,
                              const std::map<std::string, std::string>& comments,
                              const std::map<std::string, std::string>& table_files = {});

/// derived, calibrated, surrogate, given.
std::string name(micromodels::Label label);

}  // namespace puffin::cases
