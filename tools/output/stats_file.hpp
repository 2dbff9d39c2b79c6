#pragma once
// stats.h5: the history of a run as HDF5, one growing data set a column.

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace puffin::output {

struct StatsColumn {
  std::string name;  // each '/' becomes '_' in the file
  std::string unit;  // stored as the attribute `unit`
};

/// Data sets /history/NAME, all of one length; attributes of the root: format = "puffin-stats", format_version = 1.
/// Rows are collected and written in blocks.
class StatsFile {
 public:
  /// Throws OutputError if the file cannot be written.
  StatsFile(const std::filesystem::path& file, const std::vector<StatsColumn>& columns);
  ~StatsFile();
  StatsFile(StatsFile&&) noexcept;
  StatsFile& operator=(StatsFile&&) noexcept;

  /// One value a column. Throws std::invalid_argument on a wrong number of values, OutputError if the disk refuses.
  void append(std::span<const double> row);
  /// Writes what is collected and hands it to the operating system.
  void flush();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Which columns there are. Throws OutputError if the file is none of this format.
std::vector<std::string> stats_names(const std::filesystem::path& file);
/// A column read back. Throws OutputError if it is not there.
std::vector<double> read_stats(const std::filesystem::path& file, const std::string& column);

}  // namespace puffin::output
