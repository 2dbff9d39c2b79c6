#pragma once
// Tables as comma-separated text: a header line, then rows. Numbers are the shortest text that reads back exactly.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace puffin::output {

using CsvCell = std::variant<double, std::string>;

class CsvFile {
 public:
  /// Creates the file and writes the header. keep: go on with an existing file after its first so many bytes and drop
  /// the rest. Throws OutputError if the file cannot be written or, on resuming, is shorter or has other columns.
  CsvFile(std::filesystem::path file, const std::vector<std::string>& columns, std::optional<std::uint64_t> keep = {});

  /// Throws std::invalid_argument on a wrong number of cells, OutputError if the disk refuses. Handed to the operating
  /// system at least once a second, as far as rows come.
  void append(std::span<const CsvCell> cells);
  void append(std::initializer_list<CsvCell> cells) { append(std::span(cells.begin(), cells.size())); }
  void flush();
  /// flush(), and onto the disk.
  void sync();
  /// Length with all rows so far, flushed or not; for `keep`.
  std::uint64_t bytes() const { return bytes_; }

 private:
  void check() const;

  std::filesystem::path file_;
  std::size_t columns_;
  std::uint64_t bytes_ = 0;
  std::ofstream stream_;
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

/// A table read back: cells as text, in rows.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// Index of a column, or -1.
  int find(const std::string& column) const;
  /// A column as numbers (NaN where the text is none); empty if there is no such column.
  std::vector<double> numbers(const std::string& column) const;
};

/// Throws OutputError if the file cannot be read.
CsvTable read_csv(const std::filesystem::path& file);

/// The shortest decimal text that reads back as the same double; "nan" and "inf" for those.
std::string shortest(double value);

}  // namespace puffin::output
