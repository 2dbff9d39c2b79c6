#pragma once
// What a replay needs beside the contacts, in events.h5: data sets /replay_carriers, /replay_slip, /replay_air and
// /replay_rates.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace puffin::output {

struct ReplayTables {
  struct Carrier {
    double initial = 0.0;    // fines loaded
    double drag_rest = 0.0;  // fines that the drag law asked for since the last contact
    std::int32_t id = -1;
    std::int32_t emitted = 0;  // 1: left the device
  };
  struct Slip {
    double seconds = 0.0, metres = 0.0;  // time in this class of slip speeds [s], and way [m]
    std::int32_t carrier = -1;
    std::int32_t slip_class = 0;
  };
  struct Air {
    double released = 0.0, in_air = 0.0, emitted = 0.0, deposited = 0.0;  // fines, at the end
    std::int32_t set = 0;                                                 // index of [[fines.scalar]]
    std::int32_t mechanism = 0;                                           // 0 wall, 1 particle, 2 drag
  };

  double end = 0.0;  // simulated time [s]
  std::vector<Carrier> carriers;
  std::vector<Slip> slip;
  std::vector<Air> air;
  std::vector<double> rates;         // samples of the drag law; none: no such law
  std::vector<std::string> scalars;  // names of the sets
};

/// Adds the data sets to an existing events.h5. Throws OutputError.
void write_replay_tables(const std::filesystem::path& events, const ReplayTables& tables);
/// Throws OutputError if the file is missing, damaged, or holds no such tables: then the run carried no fines, or an
/// older version wrote it.
ReplayTables read_replay_tables(const std::filesystem::path& events);

}  // namespace puffin::output
