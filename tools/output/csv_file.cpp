#include "tools/output/csv_file.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"

namespace puffin::output {
namespace {

/// A cell as it stands in the file: quoted only if it holds a comma, a quote or a line break (RFC 4180).
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::string as_text(const CsvCell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return shortest(*number);
  return quoted(std::get<std::string>(cell));
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (const auto& cell : cells) {
    if (!line.empty()) line += ',';
    line += quoted(cell);
  }
  line += '\n';
  return line;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (inside) {
      if (c != '"') {
        cells.back() += c;
      } else if (i + 1 < line.size() && line[i + 1] == '"') {
        cells.back() += line[++i];
      } else {
        inside = false;
      }
    } else if (c == '"') {
      inside = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

double as_number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::numeric_limits<double>::quiet_NaN();
  return value;
}

}  // namespace

std::string shortest(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return error == std::errc() ? std::string(text, end) : "nan";
}

CsvFile::CsvFile(std::filesystem::path file, const std::vector<std::string>& columns, std::optional<std::uint64_t> keep)
    : file_(std::move(file)), columns_(columns.size()) {
  const std::string header = joined(columns);
  if (keep) {
    std::string begin(header.size(), ' ');
    std::ifstream(file_, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
    if (begin != header || *keep < header.size()) {
      throw OutputError(file_.string() +
                        ": its columns are not those of this version, so the run cannot be resumed; start it anew");
    }
    keep_first(file_, *keep);
  } else {
    write_whole(file_, header);
  }
  bytes_ = keep.value_or(header.size());
  stream_.open(file_, std::ios::app | std::ios::binary);
  check();
}

void CsvFile::append(std::span<const CsvCell> cells) {
  if (cells.size() != columns_) {
    throw std::invalid_argument(file_.string() + ": a row of " + std::to_string(cells.size()) + " cells for " +
                                std::to_string(columns_) + " columns");
  }
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    line += as_text(cells[i]);
  }
  stream_ << line << '\n';
  bytes_ += line.size() + 1;
  if (std::chrono::steady_clock::now() - flushed_ > std::chrono::seconds(1)) {
    flush();
  } else {
    check();
  }
}

void CsvFile::flush() {
  stream_.flush();
  flushed_ = std::chrono::steady_clock::now();
  check();
}

void CsvFile::sync() {
  flush();
  sync_file(file_);
}

void CsvFile::check() const {
  if (!stream_) {
    throw OutputError("cannot write " + file_.string() + ": " + std::strerror(errno) +
                      "; free some space or choose another folder with --out");
  }
}

int CsvTable::find(const std::string& column) const {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == column) return static_cast<int>(i);
  }
  return -1;
}

std::vector<double> CsvTable::numbers(const std::string& column) const {
  const int index = find(column);
  std::vector<double> out;
  if (index < 0) return out;
  for (const auto& row : rows) {
    out.push_back(static_cast<std::size_t>(index) < row.size() ? as_number(row[index])
                                                               : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

CsvTable read_csv(const std::filesystem::path& file) {
  demand_regular(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw OutputError("cannot read " + file.string() + ": " + std::strerror(errno));
  CsvTable table;
  std::string line;
  if (std::getline(stream, line)) table.columns = split(line);
  while (std::getline(stream, line)) {
    if (!line.empty()) table.rows.push_back(split(line));
  }
  return table;
}

}  // namespace puffin::output
