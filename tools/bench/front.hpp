#pragma once
// What is worth its time: settings that no other beats in both run time and error.

#include <vector>

namespace puffin::bench {

/// Run time [s], or another cost, and error of one setting; `half_width`: of the error's uncertainty, from its own
/// statistics and the reference's.
struct CostAndError {
  double seconds = 0.0, error = 0.0, half_width = 0.0;
};

/// For each setting whether none other is both faster and more accurate (ties stay). Settings without a finite error
/// are never on the front. n log n.
std::vector<bool> on_front(const std::vector<CostAndError>& settings);

/// The most accurate setting that costs no more than setting `which` (itself counts; of equals the fastest): what the
/// cost of `which` buys at best. Settings without a finite error are never chosen; `which` itself, if there is no
/// other.
std::size_t best_for_cost(const std::vector<CostAndError>& settings, std::size_t which);

/// Run time of setting `which` over that of the fastest setting that is no less accurate (itself counts): 1 on the
/// front, 1.1 if the same error could be had in 10 % less time. certain: only settings count whose error is smaller by
/// more than both uncertainties together, so that luck does not.
double time_over_front(const std::vector<CostAndError>& settings, std::size_t which, bool certain);

}  // namespace puffin::bench
