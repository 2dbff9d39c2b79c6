#pragma once
// From contacts and slip to fines in the air and on the walls: asks the micro-models, takes from the carriers, books.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "coupling/fines.hpp"
#include "coupling/stencils.hpp"
#include "dem/carriers.hpp"
#include "dem/events.hpp"
#include "micromodels/fines_models.hpp"

namespace puffin::coupling {

/// What a replay must know of a contact beside its speeds.
struct ContactMark {
  bool a_loses = false, b_loses = false;  // begun after the first motion, with air in reach of the carrier
  double drag_a = 0.0, drag_b = 0.0;      // fines that drag asked for since the partner's last such contact
};

/// Takes fines off carriers and puts them into the air around them, in every set of scalars, or onto the walls. Keeps
/// nothing but scratch between calls. Call before carriers that left are removed from the list; ids ascend.
class FinesRelease {
 public:
  /// Fines released by the contacts that began at `first_motion` [s] or later: settling contacts move no fines, and
  /// without a first motion none do. Between carriers both partners lose. In the order of the contacts, so that a
  /// carrier that hits twice in one step loses from what the first hit left. A carrier without air in reach keeps its
  /// fines (Fines::without_air counts the contact).
  /// Throws std::invalid_argument if a carrier is not in the list or a wall contact has no triangle.
  void by_contacts(std::span<const dem::ContactBegun> begun, const std::optional<double>& first_motion,
                   const dem::Carriers& carriers, const micromodels::FinesModels& models, const CellIndex& cells,
                   Fines& fines, lbm::ScalarFields& fields);

  /// What each contact of the last by_contacts() took, of both partners together; one entry a contact.
  const std::vector<Taken>& taken() const { return taken_; }
  /// Likewise.
  const std::vector<ContactMark>& marks() const { return marks_; }

  /// Fines blown off during `duration` [s] at the slip speeds `slip` [m/s] (by place), for the carriers in `stencils`.
  /// What was taken is given to the air where the carrier is now: call it once each scalar step, not each air step. The
  /// slip goes into the history, with or without a law.
  void by_drag(const Stencils& stencils, std::span<const double> slip, double duration, const dem::Carriers& carriers,
               const micromodels::FinesModels& models, Fines& fines, lbm::ScalarFields& fields);

 private:
  void begin(std::size_t carriers);

  Stencils stencils_;
  std::vector<Taken> taken_;                            // by contact
  std::vector<ContactMark> marks_;                      // by contact
  std::vector<int> places_;                             // of the carriers that take part
  std::vector<char> in_air_;                            // by place
  std::array<std::vector<double>, mechanisms> amount_;  // to the air, by place
};

/// Impact angle as the micro-models count it, in degrees from the surface: 90 is head-on.
double angle_to_surface(const dem::ContactBegun& contact);

}  // namespace puffin::coupling
