#include "cases/table_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "cases/units.hpp"

namespace puffin::cases {

Columns read_columns(const std::string& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    throw std::invalid_argument(file + ": is no regular file, so it may never end");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::system_error(errno, std::generic_category(), "cannot read " + file);
  Columns columns;
  std::vector<std::string> names;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line.erase(std::remove_if(line.begin(), line.end(), [](char c) { return c == ' ' || c == '\t' || c == '\r'; }),
               line.end());
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      for (const std::string& name : names)
        if (!columns.try_emplace(name).second)
          throw std::invalid_argument(
              file + ":" + std::to_string(number) +
              (name.empty() ? ": two columns have no name" : ": two columns are called '" + name + "'"));
      continue;
    }
    if (cells.size() != names.size())
      throw std::invalid_argument(file + ":" + std::to_string(number) + ": " + std::to_string(cells.size()) +
                                  " values under " + std::to_string(names.size()) + " names");
    for (std::size_t i = 0; i < cells.size(); ++i) try {
        columns[names[i]].push_back(parse_quantity(cells[i]).value);
      } catch (const UnitError& e) {
        throw std::invalid_argument(file + ":" + std::to_string(number) + ": " + e.what());
      }
  }
  return columns;
}

Columns read_columns(const std::string& file, std::initializer_list<std::string_view> needed) {
  Columns columns = read_columns(file);
  std::string missing;
  for (const std::string_view name : needed)
    if (columns.count(std::string(name)) == 0) missing += (missing.empty() ? "" : ", ") + std::string(name);
  if (!missing.empty()) throw std::invalid_argument(file + ": lacks the columns " + missing);
  for (const std::string_view name : needed) {
    const auto& values = columns.at(std::string(name));
    if (values.empty()) throw std::invalid_argument(file + ": has no row under its header");
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
      throw std::invalid_argument(file + ": the column " + std::string(name) + " holds a number that is not finite");
  }
  return columns;
}

}  // namespace puffin::cases
