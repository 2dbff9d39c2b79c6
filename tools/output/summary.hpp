#pragma once
// summary.json: what a run came to, as plain numbers. SI units; an absent value is null in the file.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace puffin::output {

/// A mean over time with its 95 % confidence interval from batch means.
struct TimeMean {
  std::optional<double> mean, ci_low, ci_high;
  int batches = 0;
};

struct PressureSummary {
  TimeMean static_drop;                         // [Pa]
  TimeMean total_to_static_drop;                // [Pa]
  double window_begin = 0.0, window_end = 0.0;  // [s]
  TimeMean flow_rate;                           // that the drops were measured at [m^3/s]
};

struct CarrierSummary {
  std::int64_t count = 0;     // single carriers loaded
  std::int64_t emitted = 0;   // single carriers that left
  std::int64_t retained = 0;  // single carriers still inside
  double retained_fraction = 0.0;
  std::optional<double> first_motion, first_emitted, last_emitted;  // [s]
  std::optional<double> RDF;                                        // retained mass over the dose
  std::optional<double> momentum_error;  // impulse given less impulse taken by the air, over the impulse exchanged
};

struct MechanismShares {
  double wall = 0.0, particle = 0.0, drag = 0.0;  // of the fines that left a carrier
};

/// FFE + FFW + FFCR + FFCE + in_air = 1 of the fines loaded.
struct FinesSummary {
  std::string name;  // of the scalar
  double FFE = 0.0, FFW = 0.0, FFCR = 0.0, FFCE = 0.0, in_air = 0.0;
  double ledger_error = 0.0;
  MechanismShares by_mechanism;
};

/// Counted per carrier: a parcel of 10 counts ten times.
struct CollisionSummary {
  double wall = 0.0, particle = 0.0;
  std::optional<double> median_per_carrier, median_per_emitted_carrier;
  std::optional<double> mean_wall_energy, mean_particle_energy;  // [J]
  std::optional<double> largest_overlap;                         // of any contact, part of the (smaller) diameter
};

/// Of an air that no opening holds. Parts of its mass that rounding took, that were given back, that are missing now.
struct AirMass {
  double lost = 0.0, returned = 0.0, missing = 0.0;
  std::int64_t corrections = 0;
};

struct SkippedWork {
  std::string name;
  std::int64_t times = 0;
  double seconds_saved = 0.0;
};

struct PhaseTime {
  std::string name;
  double seconds = 0.0;
};

struct PatchForce {
  std::string patch;
  double fx = 0.0, fy = 0.0, fz = 0.0;  // mean over the pressure window [N]
};

/// A value given in [reference] beside ours. Names may carry a source in front: "experiment.FFE".
struct ReferenceRow {
  std::string name;
  double given = 0.0;
  std::optional<double> low, high;   // spread of the given value
  std::optional<double> ours;        // absent: this run has no such number
  std::optional<double> difference;  // ours - given
};

struct Summary {
  std::string name;
  std::string version;
  std::string state;            // finished | diverged | stopped
  std::string message;          // why it stopped, or where it diverged: step, cell or carrier, value, limit
  std::optional<double> until;  // finished because --until asked for no more [s]: --resume goes on
  std::string preset;           // of --preset; "" none
  std::optional<double> stop_time, case_stop_time;  // where this run was to end, and without preset and --until [s]
  std::vector<std::string> warnings;                // of the case, of impacts beyond its laws, of healed failures
  double simulated_time = 0.0;                      // [s]
  double wall_clock = 0.0;                          // [s]
  int threads = 0;
  std::string host;  // processor and instruction set
  std::int64_t cells_fluid = 0, cells_active = 0;
  std::int64_t steps = 0;
  double mlups = 0.0, mlups_active = 0.0;  // million cell updates a second: fluid cells, active cells
  double dx = 0.0;                         // [m]
  double dt_min = 0.0, dt_max = 0.0;       // [s]
  double tau_min = 0.0;                    // smallest relaxation time [time steps]
  double mach_max = 0.0;                   // of the lattice
  std::int64_t limited = 0;                // cells x steps in which the positivity limiter acted
  std::int64_t backflow = 0;               // outlet cells x steps in which back-flow was cut
  double memory_peak = 0.0;                // [byte]
  std::vector<PhaseTime> phases;
  std::vector<SkippedWork> skipped;
  std::optional<PressureSummary> pressure;
  std::vector<PatchForce> forces;
  std::optional<AirMass> air_mass;  // absent: an opening holds the density
  std::optional<CarrierSummary> carriers;
  std::vector<FinesSummary> fines;  // one a scalar
  std::optional<CollisionSummary> collisions;
  std::vector<std::string> assumptions;
  std::vector<ReferenceRow> reference;
};

/// Writes under a temporary name and renames. Throws OutputError.
void write_summary(const std::filesystem::path& file, const Summary& summary);
/// Throws OutputError if the file is missing or is no summary (without `state` it is none). Unknown keys are
/// ignored, other missing ones keep defaults.
Summary read_summary(const std::filesystem::path& file);
/// The `fines` block alone, of a summary or of what `puffin replay --json` wrote. Throws OutputError.
std::vector<FinesSummary> read_fines(const std::filesystem::path& file);
/// Writes summary.csv beside summary.json: a row `quantity,value` for every number and text in it, SI units; the
/// quantity is the path ("carriers.RDF"), elements of lists go by their name. Throws OutputError.
void write_summary_table(const std::filesystem::path& run);
/// The text of summary.json; for `--json`.
std::string summary_json(const Summary& summary);
/// The text of the `fines` block alone; for `puffin replay --json`.
std::string fines_json(const std::vector<FinesSummary>& fines);

/// Whether a finished run ended before its case was meant to end, not because everything had left.
bool cut_short(const Summary& summary);
/// What makes a run a trial: "preset quick, ended at 121 ms of 211 ms". "" if it is the case as it stands.
std::string trial(const Summary& summary);

/// Our value for a name of [reference]: a key of the summary ("FFE", "retained_fraction"), a dotted path of it
/// ("pressure.static_drop.mean", "fines.L-Base.FFE"), or a quantity that has a mean ("static_drop"). A first word
/// "thesis", "experiment" or "simulation" is ignored; fines without a scalar name are those of the first scalar.
std::optional<double> find_value(const Summary& summary, const std::string& name);

/// A value of [reference] as the case gives it.
struct ReferenceValue {
  std::string name;
  double given = 0.0;
  std::optional<double> low, high;
};
/// "experiment.FFE" -> {"experiment", "FFE"}, likewise "thesis" and "simulation"; what stands in [reference] itself is
/// plainly given: "FFE" -> {"reference", "FFE"}.
std::pair<std::string, std::string> source_of(const std::string& name);
/// Fills summary.reference from the given values and the rest of the summary.
void compare_with_reference(Summary& summary, const std::vector<ReferenceValue>& given);

/// status.json while a run goes on.
struct Status {
  std::string name;
  std::string state;  // running | finished | diverged | stopped | failed
  std::string phase;
  double simulated_time = 0.0, end_time = 0.0;  // [s]
  std::int64_t steps = 0;
  double mlups = 0.0;
  double wall_clock = 0.0;             // [s]
  std::optional<double> eta;           // [s]
  std::optional<double> ledger_error;  // of the fines loaded
  std::optional<double> air_lost;      // of a closed air: what rounding took of its mass, given back or missing
  std::vector<std::string> warnings;
};

/// Writes under a temporary name and renames, so that a reader never sees half a file. Throws OutputError.
void write_status(const std::filesystem::path& file, const Status& status);
Status read_status(const std::filesystem::path& file);

}  // namespace puffin::output
