#pragma once
// Tables of numbers beside a case: comma-separated text with a header line.

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace puffin::cases {

using Columns = std::map<std::string, std::vector<double>>;

/// Columns of a CSV file by name; all have the same length. Blank lines and lines that begin with # are skipped; a
/// value may carry its unit ("0.2 mm"); two columns of one name are refused. Throws std::invalid_argument naming file
/// and line, std::system_error if it cannot be read.
Columns read_columns(const std::string& file);

/// The same, with at least one row and all of these columns, every number finite.
Columns read_columns(const std::string& file, std::initializer_list<std::string_view> needed);

}  // namespace puffin::cases
