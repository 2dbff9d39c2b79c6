// summary.csv: every number of summary.json as a row, for spreadsheets.

#include "tools/output/csv_file.hpp"
#include "tools/output/json_fields.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {
namespace {

/// The name of a list's element: its own, or its place.
std::string name_of(const Json& item, std::size_t place) {
  for (const char* key : {"name", "patch"})
    if (item.is_object() && item.contains(key) && item[key].is_string()) return item[key].get<std::string>();
  return std::to_string(place);
}

void flatten(const Json& json, const std::string& path, CsvFile& table) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) flatten(value, path.empty() ? key : path + "." + key, table);
  } else if (json.is_array()) {
    for (std::size_t n = 0; n < json.size(); ++n) flatten(json[n], path + "." + name_of(json[n], n), table);
  } else if (json.is_number()) {
    table.append({path, json.get<double>()});
  } else if (json.is_string()) {
    table.append({path, json.get<std::string>()});
  }
}

}  // namespace

void write_summary_table(const std::filesystem::path& run) {
  const std::filesystem::path part = run / "summary.csv.part";
  {
    CsvFile table(part, {"quantity", "value"});
    flatten(read_json(run / "summary.json"), "", table);
    table.flush();
  }
  finish_file(part, run / "summary.csv");
}

}  // namespace puffin::output
