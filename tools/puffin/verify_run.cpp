#include "tools/puffin/verify_run.hpp"

#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "tools/output/csv_file.hpp"
#include "tools/output/events_file.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/output/tables.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::tools {
namespace {

using cases::Table;

/// Numbers by dotted keys; an item of a list goes by its `name` or `patch`.
void flatten(const nlohmann::json& node, const std::string& key, std::map<std::string, double>& numbers) {
  if (node.is_number()) numbers[key] = node.get<double>();
  const std::string front = key.empty() ? "" : key + ".";
  if (node.is_object())
    for (const auto& [name, value] : node.items()) flatten(value, front + name, numbers);
  if (!node.is_array()) return;
  for (const auto& item : node)
    for (const char* name : {"name", "patch"})
      if (item.is_object() && item.contains(name) && item[name].is_string())
        flatten(item, front + item[name].get<std::string>(), numbers);
}

Table csv_table(const std::filesystem::path& file) {
  const output::CsvTable csv = output::read_csv(file);
  Table table;
  for (std::size_t i = 0; i < csv.columns.size(); ++i) {
    table.numbers[csv.columns[i]] = csv.numbers(csv.columns[i]);
    auto& words = table.words[csv.columns[i]];
    for (const auto& row : csv.rows) words.push_back(row.at(i));
  }
  return table;
}

Table stats_table(const std::filesystem::path& file) {
  Table table;
  for (const std::string& column : output::stats_names(file)) table.numbers[column] = output::read_stats(file, column);
  return table;
}

Table events_table(const std::filesystem::path& file) {
  Table table;
  auto& n = table.numbers;
  for (const output::EventRecord& e : output::read_events(file)) {
    n["time_start"].push_back(e.time_start);
    n["time_end"].push_back(e.time_end);
    n["a"].push_back(e.a);
    n["b"].push_back(e.b);
    n["triangle"].push_back(e.triangle);
    n["normal_speed"].push_back(e.normal_speed);
    n["tangential_speed"].push_back(e.tangential_speed);
    n["energy"].push_back(e.energy);
    n["max_force"].push_back(e.max_force);
    n["max_overlap"].push_back(e.max_overlap);
    n["detached"].push_back(e.detached);
    n["attached"].push_back(e.attached);
  }
  return table;
}

/// The fluid cells of one moment.
Table field_table(const std::filesystem::path& file, double time) {
  const output::FieldFrame frame = output::read_field_frame(file);
  Table table;
  auto& n = table.numbers;
  std::size_t cell = 0;
  for (int k = 0; k < frame.size[2]; ++k)
    for (int j = 0; j < frame.size[1]; ++j)
      for (int i = 0; i < frame.size[0]; ++i, ++cell) {
        if (frame.fluid[cell] == 0) continue;
        n["x"].push_back(frame.origin[0] + frame.dx * i);
        n["y"].push_back(frame.origin[1] + frame.dx * j);
        n["z"].push_back(frame.origin[2] + frame.dx * k);
        n["time"].push_back(time);
        if (!frame.velocity.empty()) {
          n["u"].push_back(frame.velocity[3 * cell]);
          n["v"].push_back(frame.velocity[3 * cell + 1]);
          n["w"].push_back(frame.velocity[3 * cell + 2]);
        }
        if (!frame.pressure.empty()) n["p"].push_back(frame.pressure[cell]);
        for (const auto& scalar : frame.fines) n["fines_" + scalar.name].push_back(scalar.values[cell]);
      }
  return table;
}

Table read_table(const std::filesystem::path& folder, const std::string& name) {
  if (name == "stats.h5") return stats_table(folder / name);
  if (name == "events.h5") return events_table(folder / name);
  Table table = csv_table(folder / name);
  if (name == "tracks.csv") cases::add_first_columns(table, "id");
  if (name == "planes.csv") cases::add_word_columns(table, "time", "plane");
  return table;
}

}  // namespace

cases::RunOutput read_run(const std::filesystem::path& folder) {
  std::ifstream in(folder / "summary.json");
  if (!in) throw output::OutputError("cannot read " + (folder / "summary.json").string());
  cases::RunOutput run;
  flatten(nlohmann::json::parse(in), "", run.numbers);
  const auto kept = std::make_shared<std::map<std::string, Table>>();
  run.table = [folder, kept](const std::string& name) {
    if (!kept->contains(name)) (*kept)[name] = read_table(folder, name);
    return kept->at(name);
  };
  const auto moments = [folder] {
    std::vector<output::SeriesEntry> entries;
    if (std::filesystem::exists(folder / "vtk" / "fields.pvd"))
      for (const auto& e : output::read_pvd(folder / "vtk" / "fields.pvd"))
        if (e.part == 0) entries.push_back(e);
    return entries;
  };
  run.field_times = [moments] {
    std::vector<double> times;
    for (const auto& e : moments()) times.push_back(e.time);
    return times;
  };
  run.field = [folder, moments](std::size_t n) {
    const auto entry = moments().at(n);
    return field_table(folder / "vtk" / entry.file, entry.time);
  };
  return run;
}

}  // namespace puffin::tools
