#include "tools/puffin/sound_record.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "coupling/health.hpp"
#include "coupling/replay_fines.hpp"
#include "tools/output/csv_file.hpp"
#include "tools/output/output_error.hpp"

namespace puffin::tools {
namespace {

using output::shortest;

constexpr double light = 299792458.0;  // [m/s]
constexpr double most_fines = 1e30;    // more than any carrier has atoms
constexpr double rounding = 1e-9;      // of the moment of a contact, of an angle

/// The values of one row of a data set, asked for one after the other.
class Row {
 public:
  Row(const std::filesystem::path& file, const char* data_set, std::size_t row)
      : file_(file), data_set_(data_set), row_(row) {}

  void refuse(const char* member, double value, const std::string& must) const {
    throw output::OutputError(file_.string() + " is damaged: " + data_set_ + ", row " + std::to_string(row_) + ": " +
                              member + " is " + shortest(value) + ", but must be " + must +
                              "; no run writes this: take the file from its source again, or repeat the run");
  }
  void within(const char* member, double value, double low, double high, double slack = 0.0) const {
    if (!(value >= low - slack && value <= high + slack))  // nor if it is no number
      refuse(member, value, "from " + shortest(low) + " to " + shortest(high));
  }
  void at_least_zero(const char* member, double value) const {
    if (!(value >= 0.0 && std::isfinite(value))) refuse(member, value, "a number of at least 0");
  }
  void equals(const char* member, double value, double wanted) const {
    if (value != wanted) refuse(member, value, shortest(wanted));
  }

 private:
  const std::filesystem::path& file_;
  const char* data_set_;
  std::size_t row_;
};

void check_contact(const Row& row, const output::EventRecord& e, double end, double last) {
  row.within("a", e.a, 0.0, last);
  row.within("b", e.b, -1.0, last);
  if (e.a == e.b) row.refuse("b", e.b, "another carrier than a");
  row.within("time_start", e.time_start, 0.0, end, rounding * end);
  row.within("normal_speed", e.normal_speed, 0.0, light);
  row.within("tangential_speed", e.tangential_speed, 0.0, light);
  row.within("angle", e.angle, 0.0, 90.0, rounding);
  if (!(e.order >= -1.0 && std::isfinite(e.order))) row.refuse("order", e.order, "a number of at least -1");
  row.at_least_zero("drag_a", e.drag_a);
  row.at_least_zero("drag_b", e.drag_b);
  row.within("a_loses", e.a_loses, 0.0, 1.0);
  row.within("b_loses", e.b_loses, 0.0, 1.0);
}

void check_slip(const Row& row, const output::ReplayTables::Slip& s, double end, double last) {
  row.within("carrier", s.carrier, 0.0, last);
  row.within("slip_class", s.slip_class, 0.0, coupling::SlipHistory::classes - 1.0);
  row.within("seconds", s.seconds, 0.0, end, rounding * end);
  row.within("metres", s.metres, 0.0, light * s.seconds);
}

/// dose: fines on all carriers.
void check_air(const Row& row, const output::ReplayTables::Air& a, std::size_t n, double dose) {
  const double slack = coupling::HealthLimits{}.ledger * dose;  // a run with more does not end well
  const std::size_t set = n / coupling::mechanisms, mechanism = n % coupling::mechanisms;
  row.equals("set", a.set, static_cast<double>(set));
  row.equals("mechanism", a.mechanism, static_cast<double>(mechanism));
  row.within("released", a.released, 0.0, dose, slack);
  row.within("emitted", a.emitted, 0.0, a.released, slack);
  row.within("deposited", a.deposited, 0.0, a.released, slack);
  const double rest = a.released - a.emitted - a.deposited;
  if (!(std::abs(a.in_air - rest) <= slack))
    row.refuse("in_air", a.in_air, "what is released and neither emitted nor deposited, " + shortest(rest));
}

}  // namespace

void demand_sound(const std::filesystem::path& file, const output::ReplayTables& tables,
                  const std::vector<output::EventRecord>& events) {
  const auto say = [&](const std::string& what) {
    throw output::OutputError(file.string() + " is damaged: " + what +
                              "; take the file from its source again, or repeat the run");
  };
  if (!(tables.end >= 0.0 && std::isfinite(tables.end)))
    say("replay_end is " + shortest(tables.end) + ", but must be a number of at least 0");
  const double last = static_cast<double>(tables.carriers.size()) - 1.0;
  double dose = 0.0;
  for (std::size_t n = 0; n < tables.carriers.size(); ++n) {
    const auto& c = tables.carriers[n];
    const Row row(file, "/replay_carriers", n);
    row.equals("id", c.id, static_cast<double>(n));
    row.within("initial", c.initial, 0.0, most_fines);
    row.within("emitted", c.emitted, 0.0, 1.0);
    row.at_least_zero("drag_rest", c.drag_rest);
    dose += c.initial;
  }
  for (std::size_t n = 0; n < events.size(); ++n) check_contact({file, "/events", n}, events[n], tables.end, last);
  for (std::size_t n = 0; n < tables.slip.size(); ++n)
    check_slip({file, "/replay_slip", n}, tables.slip[n], tables.end, last);
  if (const std::size_t rows = tables.scalars.size() * coupling::mechanisms; tables.air.size() != rows)
    say("/replay_air has " + std::to_string(tables.air.size()) + " rows, but must have " + std::to_string(rows) +
        ", one for each scalar and mechanism");
  for (std::size_t n = 0; n < tables.air.size(); ++n) check_air({file, "/replay_air", n}, tables.air[n], n, dose);
  for (std::size_t n = 0; n < tables.rates.size(); ++n)
    Row(file, "/replay_rates", n).at_least_zero("rate", tables.rates[n]);
}

}  // namespace puffin::tools
