#pragma once
// What a study shares and why, in words.

#include <string>
#include <vector>

#include "cases/study.hpp"
#include "tools/puffin/batch/jobs.hpp"

namespace puffin::tools {

/// The names of a job's cases.
std::string listed(const cases::Study& study, const Job& job);

/// Equal for cases whose doses settle to one bed; empty where none settles. Adhesion, stiffness, air and fines in it
/// are none of it; the bed store, which sees the carriers themselves, has the last word.
std::string bed_key(cases::Case c);

/// Adds what the jobs share of scalars, micro-models and geometry, and what they do not.
void explain(const cases::Study& study, const std::vector<Job>& jobs, std::vector<Sharing>& sharings);

/// Adds which cases begin from one bed. Cases in one run share it anyway.
void explain_beds(const cases::Study& study, std::string_view preset, Jobs& plan);

/// Warns of the cases whose replicates will all be equal: the seed acts on nothing there.
void warn_of_equal_replicates(const cases::Study& study, Jobs& plan);

}  // namespace puffin::tools
