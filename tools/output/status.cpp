#include "tools/output/json_fields.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {
namespace {

template <class Field>
void fields(Status& s, const Field& field) {
  field("name", s.name), field("state", s.state), field("phase", s.phase);
  field("simulated_time", s.simulated_time), field("end_time", s.end_time), field("steps", s.steps);
  field("mlups", s.mlups), field("wall_clock", s.wall_clock), field("eta", s.eta);
  field("ledger_error", s.ledger_error);
  if (s.air_lost || !field.writes) field("air_lost", s.air_lost);
}

}  // namespace

void write_status(const std::filesystem::path& file, const Status& status) {
  Json json = Json::object();
  json["format"] = format_version;
  Status copy = status;
  fields(copy, JsonWriter{json});
  json["warnings"] = status.warnings;
  write_whole(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Status read_status(const std::filesystem::path& file) {
  const Json json = read_json(file);
  Status status;
  fields(status, JsonReader{json});
  for (const auto& text : part(json, "warnings")) {
    if (text.is_string()) status.warnings.push_back(text.get<std::string>());
  }
  return status;
}

}  // namespace puffin::output
