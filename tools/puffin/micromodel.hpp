#pragma once
// puffin micromodel: its three verbs. Each adds its options to its own parser and returns what they ask for.

#include "tools/puffin/commands.hpp"

namespace puffin::tools {

Action micromodel_derive(CLI::App& app);
Action micromodel_fit(CLI::App& app);
Action micromodel_show(CLI::App& app);

}  // namespace puffin::tools
