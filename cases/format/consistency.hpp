#pragma once
// Contradictions between the values of a case that are each right by themselves.

#include "cases/case.hpp"
#include "cases/format/findings.hpp"

namespace puffin::cases::format {

/// Reports to `findings`, at the key to change. Keys that are already broken are left alone.
void check_consistency(const Case& c, Findings& findings);

}  // namespace puffin::cases::format
