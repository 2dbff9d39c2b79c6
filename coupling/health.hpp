#pragma once
// Has the physics left the range in which the method means anything? The kernel watches every cell in every step; here
// is the rest, cheap enough to be asked every hundred steps; what a contact leaves behind, in every exchange.

#include <cstdint>
#include <vector>

#include "coupling/state.hpp"

namespace puffin::coupling {

struct HealthLimits {
  /// Largest overlap of a contact, as a part of the smaller diameter: far beyond any max_overlap of a case.
  double overlap = 0.3;
  /// Largest speed of a carrier, in the speed that the lattice can carry: 10 times what any air can be.
  double speed = 10.0;
  /// Largest error of a ledger, of the fines loaded: sums of 10^6 events with one rounding each stay below 1e-10.
  double ledger = 1e-9;
};

/// Whether a state that was checked `since` air steps ago must be checked before `next` more: every hundred at least.
constexpr bool check_due(std::int64_t since, std::int64_t next) { return since + next > 100; }

class Health {
 public:
  /// `state` at the start of the run: carriers that begin outside the walls are not asked to be inside.
  Health(const Models& models, const State& state, const HealthLimits& limits = {});

  /// Throws Diverged naming the first bad carrier or ledger, its place, value and limit, and the likely cause.
  void check(const Models& models, const State& state) const;

  /// If a contact of the last exchange overlapped too much, checks, then throws Diverged naming such a contact that
  /// ended: an impact can be over between two checks. To be asked after every exchange; else it takes no time.
  void check_impacts(const Models& models, const State& state) const;

 private:
  void check_motion(const State& state) const;
  void check_walls(const Models& models, const State& state) const;
  void check_overlaps(const State& state) const;
  void check_ledgers(const State& state) const;

  HealthLimits limits_;
  std::vector<std::uint8_t> began_inside_;  // by carrier id
  double fastest_start_ = 0.0;              // [m/s]
};

}  // namespace puffin::coupling
