#include "tools/output/experiments.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "tools/output/csv_file.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"

namespace puffin::output {

std::vector<Measurement> read_experiments(const std::filesystem::path& file) {
  const CsvTable table = read_csv(file);
  const int device = table.find("device"), copy = table.find("copy"), test = table.find("test");
  if (device < 0) throw OutputError(file.string() + ":1: experiments need a column 'device'");
  std::vector<std::vector<double>> values;  // by column
  for (const std::string& column : table.columns) values.push_back(table.numbers(column));
  std::vector<Measurement> all;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& row = table.rows[r];
    const auto text = [&](int column) {  // a short row leaves its last columns empty
      const auto at = static_cast<std::size_t>(column);
      return column < 0 || at >= row.size() ? std::string() : row[at];
    };
    for (int c = 0; c < static_cast<int>(table.columns.size()); ++c) {
      if (c == device || c == copy || c == test || text(c).empty()) continue;
      const double value = values[static_cast<std::size_t>(c)][r];
      if (!std::isfinite(value))
        throw OutputError(file.string() + ":" + std::to_string(r + 2) + ": '" + text(c) + "' in column '" +
                          table.columns[static_cast<std::size_t>(c)] +
                          "' is no number; leave what was not measured empty");
      all.push_back({text(device), text(copy), text(test), table.columns[static_cast<std::size_t>(c)], value});
    }
  }
  return all;
}

Spread spread_of(const std::vector<Measurement>& all, const std::string& device, const std::string& copy,
                 const std::string& quantity) {
  std::vector<double> values;
  for (const Measurement& m : all)
    if (same_device(m.device, device) && (copy.empty() || m.copy == copy) && m.quantity == quantity)
      values.push_back(m.value);
  Spread s;
  s.tests = static_cast<int>(values.size());
  if (values.empty()) return s;
  for (const double v : values) s.mean += v / s.tests;
  double squares = 0.0;
  for (const double v : values) squares += (v - s.mean) * (v - s.mean);
  if (s.tests > 1) s.deviation = std::sqrt(squares / (s.tests - 1));
  s.low = *std::min_element(values.begin(), values.end());
  s.high = *std::max_element(values.begin(), values.end());
  return s;
}

std::vector<std::string> names_of(const std::vector<Measurement>& all, std::string Measurement::*member,
                                  const std::string& device) {
  std::vector<std::string> names;
  const auto known = [&](const std::string& name) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& one) {
      return member == &Measurement::device ? same_device(one, name) : one == name;
    });
  };
  for (const Measurement& m : all)
    if ((device.empty() || same_device(m.device, device)) && !known(m.*member)) names.push_back(m.*member);
  return names;
}

bool same_device(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

void write_experiments_summary(const std::vector<Measurement>& all, const std::filesystem::path& folder) {
  const std::filesystem::path part = folder / "experiments-summary.csv.part";
  const auto cell = [](const std::optional<double>& v) { return v ? CsvCell(*v) : CsvCell(""); };
  {
    CsvFile table(part, {"device", "copy", "quantity", "tests", "mean", "standard_deviation", "relative_deviation",
                         "lowest", "highest"});
    for (const std::string& device : names_of(all, &Measurement::device)) {
      std::vector<std::string> copies = names_of(all, &Measurement::copy, device);
      copies.emplace_back();
      for (const std::string& copy : copies)
        for (const std::string& quantity : names_of(all, &Measurement::quantity, device))
          if (const Spread s = spread_of(all, device, copy, quantity); s.tests > 0)
            table.append({device, copy.empty() ? "all" : copy, quantity, double(s.tests), s.mean, cell(s.deviation),
                          cell(s.relative_deviation()), s.low, s.high});
    }
    table.flush();
  }
  finish_file(part, folder / "experiments-summary.csv");
}

}  // namespace puffin::output
