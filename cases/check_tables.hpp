#pragma once
// The tables beside a case are there and hold what is asked of them.

#include "cases/case.hpp"
#include "cases/case_error.hpp"

namespace puffin::cases {

/// What is wrong with the files of inlet profiles, initial and frozen fields, body forces and carriers' positions: each
/// at the key that names it. Reads them; builds nothing.
std::vector<Problem> table_problems(const Case& c);

}  // namespace puffin::cases
