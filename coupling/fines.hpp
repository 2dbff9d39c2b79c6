#pragma once
// Where the fines are: the state of the ledger. Fines are counted, as real numbers; 1 is one fine particle.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/slip_history.hpp"
#include "dem/carriers.hpp"
#include "lbm/scalars/compensated_sum.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::coupling {

/// What took fines from a carrier and gave them to the air. Each has a scalar of its own.
enum class Mechanism : std::uint8_t { wall, particle, drag };
inline constexpr int mechanisms = 3;

/// Index of a scalar in lbm::ScalarFields: the sets of [[fines.scalar]] follow each other, three scalars each.
inline int scalar_index(int set, Mechanism m) { return mechanisms * set + static_cast<int>(m); }

/// Plain data; belongs in a checkpoint. What happens to fines on carriers and walls is the same for all sets of
/// scalars: they differ in how the air carries on.
struct Fines {
  Fines() = default;
  /// `fines_each` on every real carrier. Throws std::invalid_argument unless >= 0 and the carriers' ids ascend.
  Fines(const dem::Carriers& carriers, double fines_each, std::size_t triangles);

  // by carrier id, of all real carriers of the entry
  std::vector<double> initial;
  std::vector<double> left;           // on the carrier now, >= 0; <= initial unless fines come back
  std::vector<std::uint8_t> emitted;  // 1: the carrier left the device, with its fines
  // by wall triangle
  std::vector<double> stuck;   // left there by carriers that hit it
  std::vector<double> placed;  // by set: in the air at the start
  // totals since the start
  double loaded = 0.0;  // on the carriers
  std::array<lbm::CompensatedSum, mechanisms> to_air;
  lbm::CompensatedSum to_wall;
  std::array<lbm::CompensatedSum, mechanisms> regained;  // from the air back to carriers (regain_fines.hpp)
  lbm::CompensatedSum picked_up;                         // likewise from walls
  std::int64_t without_air = 0;  // contacts so far outside the air that nothing could be released
  SlipHistory slip;              // for a replay with other laws
};

/// What one event really takes from a carrier.
struct Taken {
  double air = 0.0, wall = 0.0;
};

/// Takes `to_air` + `to_wall` fines (>= 0) from `left`, or all of it if that is less. What counts as taken is the
/// difference of the rounded numbers, left - left', which is exact where less than half is taken (Sterbenz): the air
/// gets it, less `to_wall`. So what carriers lose and what others get agree to one rounding an event, however small the
/// amounts are.
Taken take(double to_air, double to_wall, double& left);

/// Marks carriers that left through an opening. Their fines are emitted on carriers from now on.
void mark_emitted(std::span<const std::int64_t> ids, Fines& fines);

/// The books of one set of scalars, in fines. loaded = the sum of the other five.
struct Ledger {
  double loaded = 0.0;       // on carriers, in the air at the start, and brought in through openings
  double on_carriers = 0.0;  // in the device
  double on_emitted_carriers = 0.0;
  double on_walls = 0.0;  // left by carriers, and deposited from the air
  double in_air = 0.0;
  double emitted = 0.0;  // left with the air
  struct Shares {
    double released = 0.0, in_air = 0.0, emitted = 0.0;
    double deposited = 0.0, regained = 0.0;  // from the air: on walls, back on carriers
  };
  std::array<Shares, mechanisms> by_mechanism;

  /// (sum of the five - loaded) / loaded; 0 if nothing was loaded.
  double error() const;
  // Parts of the fines loaded; they add up to 1 + error().
  double FFE() const { return part(emitted); }
  double FFW() const { return part(on_walls); }
  double FFCR() const { return part(on_carriers); }
  double FFCE() const { return part(on_emitted_carriers); }
  double air_fraction() const { return part(in_air); }

 private:
  double part(double fines) const { return loaded > 0.0 ? fines / loaded : 0.0; }
};

Ledger ledger(const Fines& fines, const lbm::ScalarFields& fields, const lbm::ScalarBudget& budget, int set);

/// Fines on every triangle, of one set: those left by carriers and those that the air deposited in the cells of
/// `triangle_of_slot` (the triangle nearest to a cell beside a wall; -1 where there is none; may be empty while nothing
/// is deposited). Adds up to Ledger::on_walls. Throws std::invalid_argument if a depositing cell has no triangle.
std::vector<double> wall_map(const Fines& fines, const lbm::ScalarBudget& budget, int set,
                             std::span<const int> triangle_of_slot);

}  // namespace puffin::coupling
