#pragma once
// One flow for several populations of carriers that do not act on it.

#include <exception>
#include <span>

#include "coupling/state.hpp"

namespace puffin::coupling {

/// One population: its laws and its state. Of several, the first owns the air; the others' State::air is empty.
struct Companion {
  const Models* models = nullptr;
  State* state = nullptr;
  std::exception_ptr failure{};  // why it cannot go on, Diverged or another; the others can
};

/// While it lives, `borrower` holds the air of `owner`, what drives it and what is booked of it: to step it, to write
/// it, to look at it.
class BorrowedAir {
 public:
  BorrowedAir(State& owner, State& borrower);
  ~BorrowedAir();
  BorrowedAir(const BorrowedAir&) = delete;
  BorrowedAir& operator=(const BorrowedAir&) = delete;

 private:
  State& owner_;
  State& borrower_;
};

/// As `advance` for each, with the air computed once. All must be at the same time on the same cells, with the same
/// air, boundaries and time step, and none two-way. The interval is that of the most restless population: a carrier
/// that sleeps is asked oftener than it would be alone, which changes nothing of its physics. Throws Diverged if the
/// air does. What a population throws is its `failure`, and it is at the end of the interval with no meaning.
void advance_together(std::span<Companion> all, double until);

}  // namespace puffin::coupling
