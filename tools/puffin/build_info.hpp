#pragma once
// What this program was built from; one generated file knows, so that a commit recompiles nothing else.

#include <string>

namespace puffin::tools {

struct BuildInfo {
  std::string version, commit, compiler, type;
};
BuildInfo build_info();

}  // namespace puffin::tools
