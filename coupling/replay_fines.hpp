#pragma once
// The fines of a finished run again, with other micro-models: they are coupled one way, so contacts, slip and the fate
// of what was airborne are all that is needed; no air, no carriers.

#include <array>
#include <cstdint>
#include <vector>

#include "coupling/fines.hpp"
#include "coupling/slip_history.hpp"
#include "micromodels/fines_models.hpp"

namespace puffin::coupling {

/// What a run leaves behind about its fines.
struct FinesRecord {
  struct Contact {
    std::int64_t a = -1, b = -1;                                     // ids; b = -1: a wall
    double time = 0.0;                                               // of first touch [s]
    double normal_speed = 0.0, tangential_speed = 0.0, angle = 0.0;  // [m/s]; [degrees], 90: head on
    bool a_loses = false, b_loses = false;                           // as ContactMark
    double drag_a = 0.0, drag_b = 0.0;
  };
  struct Carrier {
    double initial = 0.0;
    bool emitted = false;
    double drag_rest = 0.0;  // asked for by drag since its last contact
  };
  struct Slip {
    std::int64_t carrier = -1;
    int slip_class = 0;
    double seconds = 0.0, metres = 0.0;
  };
  struct Share {
    double released = 0.0, in_air = 0.0, emitted = 0.0, deposited = 0.0;
  };

  double end = 0.0;                                 // simulated time [s]
  std::vector<Contact> contacts;                    // in the order in which the run released their fines
  std::vector<Carrier> carriers;                    // by id
  std::vector<Slip> slip;                           // classes that were visited
  RateSamples rates;                                // of the run's own drag law; empty: it had none
  std::vector<std::array<Share, mechanisms>> sets;  // fate of the airborne fines, by set of scalars and mechanism
};

struct Replayed {
  std::array<double, mechanisms> to_air{};  // fines
  double to_wall = 0.0;
  std::vector<Ledger> sets;
};

/// Asks `models` about every contact in its order, and about the slip between them. The run's own laws return what the
/// run found, to rounding. Another drag law is asked about each class of slip; what it takes from a carrier is spread
/// evenly over the time between its contacts, which matters only where a carrier is emptied. Airborne fines of a
/// mechanism share the fate of the run's own (emitted, deposited, still in the air; if it released no more than 1e-5 of
/// the dose, that of all mechanisms together; in the air if there is nothing to go by): the moment of release is not
/// followed anew. Throws std::invalid_argument if a contact names an unknown carrier.
Replayed replay(const FinesRecord& record, const micromodels::FinesModels& models);

}  // namespace puffin::coupling
