#pragma once
// Measurements beside a study: a table of tests, and what they come to by copy of the device and by device.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace puffin::output {

/// One measured quantity of one test; its unit stands in the name, as "pressure_drop_kPa".
struct Measurement {
  std::string device, copy, test, quantity;
  double value = 0.0;
};

/// Reads columns `device`, `copy`, `test`, and any others as quantities; empty cells were not measured. Throws
/// OutputError if the file cannot be read, has no `device` column or holds text where a number belongs.
std::vector<Measurement> read_experiments(const std::filesystem::path& file);

struct Spread {
  int tests = 0;
  double mean = 0.0;
  std::optional<double> deviation;  // of the sample, n - 1; none of one test
  double low = 0.0, high = 0.0;
  std::optional<double> relative_deviation() const {
    return deviation && mean != 0.0 ? std::optional(*deviation / mean) : std::nullopt;
  }
};
/// Of one quantity of a device; copy "" for all copies together. tests = 0 if there are none.
Spread spread_of(const std::vector<Measurement>& all, const std::string& device, const std::string& copy,
                 const std::string& quantity);

/// The values of a member in the order in which they first appear; a device once, in its first spelling.
std::vector<std::string> names_of(const std::vector<Measurement>& all, std::string Measurement::*member,
                                  const std::string& device = {});

/// The same device under another spelling: "L-bend" and "l-bend".
bool same_device(const std::string& a, const std::string& b);

/// experiments-summary.csv: a row a device, copy ("all" for all together) and quantity.
void write_experiments_summary(const std::vector<Measurement>& all, const std::filesystem::path& folder);

}  // namespace puffin::output
