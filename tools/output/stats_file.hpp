#pragma once
// stats.h5: the history of a run as HDF5, one growing data set a column.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace puffin::output {

struct StatsColumn {
  std::string name;
  std::string unit;  // stored as the attribute `unit`
};

/// Data sets /history/NAME, all of one length; attributes of the root: format = "puffin-stats", format_version = 1.
/// The first column is the time. Rows are collected and written in blocks, and at least every ten seconds as far as
/// rows come.
class StatsFile {
 public:
  /// resume_after: keep an existing file's rows whose first column is at most this number.
  /// Throws OutputError if the file cannot be written or, on resuming, has other columns.
  StatsFile(const std::filesystem::path& file, std::vector<StatsColumn> columns,
            std::optional<double> resume_after = {});
  ~StatsFile();
  StatsFile(StatsFile&&) noexcept;
  StatsFile& operator=(StatsFile&&) noexcept;

  /// One value a column. Throws std::invalid_argument on a wrong number of values, OutputError if the disk refuses.
  void append(std::span<const double> row);
  /// Writes what is collected and hands it to the operating system: a killed run keeps everything flushed.
  void flush();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A column read back. Throws OutputError if it is not there.
std::vector<double> read_stats(const std::filesystem::path& file, const std::string& column);

}  // namespace puffin::output
