#pragma once
// The commands of the program. Each lives in one file and registers itself here by a function in this namespace;
// CMakeLists.txt lists their names.

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace puffin::tools {

/// What a command does once its options are parsed; returns an exit code. Errors are thrown.
using Action = std::function<int()>;

struct Command {
  std::string name;
  std::string summary;
  /// Adds the options to the command's own parser and returns what they ask for.
  std::function<Action(CLI::App&)> add;
};

/// Those of this build, in the order of the help; made from the list in CMakeLists.txt.
std::vector<Command> all_commands();

}  // namespace puffin::tools
