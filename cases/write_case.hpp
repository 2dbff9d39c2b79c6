#pragma once
// Case -> the resolved case file.

#include <string>
#include <vector>

#include "cases/case.hpp"

namespace puffin::cases {

/// The case as TOML with every default filled in and, behind each value, where it came from:
/// `# given`, `# default`, `# derived: how` or `# assumed: why`. parse_case of the text gives an equal Case.
std::string write_resolved(const Case& c);

/// "key = value: why" for every value marked as assumed, in the order of the keys.
std::vector<std::string> assumptions(const Case& c);

}  // namespace puffin::cases
