#include "tools/output/summary.hpp"

#include "tools/output/json_fields.hpp"
#include "tools/output/output_folder.hpp"

namespace puffin::output {
namespace {

/// One list of names for both directions: `field(key, member)` writes the member into JSON or fills it from there.
template <class Field>
void fields(TimeMean& m, const Field& field) {
  field("mean", m.mean), field("ci_low", m.ci_low), field("ci_high", m.ci_high), field("batches", m.batches);
}

template <class Field>
void fields(CarrierSummary& c, const Field& field) {
  field("count", c.count), field("emitted", c.emitted), field("retained", c.retained);
  field("retained_fraction", c.retained_fraction);
  field("first_motion", c.first_motion), field("first_emitted", c.first_emitted);
  field("last_emitted", c.last_emitted), field("RDF", c.RDF);
  field("momentum_error", c.momentum_error);
}

template <class Field>
void fields(MechanismShares& m, const Field& field) {
  field("wall", m.wall), field("particle", m.particle), field("drag", m.drag);
}

template <class Field>
void fields(FinesSummary& f, const Field& field) {
  field("FFE", f.FFE), field("FFW", f.FFW), field("FFCR", f.FFCR), field("FFCE", f.FFCE), field("in_air", f.in_air);
  field("ledger_error", f.ledger_error);
}

template <class Field>
void fields(CollisionSummary& c, const Field& field) {
  field("wall", c.wall), field("particle", c.particle);
  field("median_per_carrier", c.median_per_carrier);
  field("median_per_emitted_carrier", c.median_per_emitted_carrier);
  field("mean_wall_energy", c.mean_wall_energy), field("mean_particle_energy", c.mean_particle_energy);
  field("largest_overlap", c.largest_overlap);
}

template <class Field>
void fields(AirMass& m, const Field& field) {
  field("lost", m.lost), field("returned", m.returned), field("missing", m.missing);
  field("corrections", m.corrections);
}

template <class Field>
void fields(SkippedWork& s, const Field& field) {
  field("name", s.name), field("times", s.times), field("seconds_saved", s.seconds_saved);
}

template <class Field>
void fields(ReferenceRow& r, const Field& field) {
  field("name", r.name), field("given", r.given);
  if (r.low || r.high || !field.writes) field("low", r.low), field("high", r.high);
  field("ours", r.ours), field("difference", r.difference);
}

template <class Field>
void fields(Summary& s, const Field& field) {
  field("name", s.name), field("version", s.version), field("state", s.state), field("message", s.message);
  field("simulated_time", s.simulated_time), field("wall_clock", s.wall_clock);
  if (s.until || !field.writes) field("until", s.until);
  field("preset", s.preset), field("stop_time", s.stop_time), field("case_stop_time", s.case_stop_time);
  field("threads", s.threads), field("host", s.host);
  field("cells_fluid", s.cells_fluid), field("cells_active", s.cells_active), field("steps", s.steps);
  field("mlups", s.mlups), field("mlups_active", s.mlups_active);
  field("dx", s.dx), field("dt_min", s.dt_min), field("dt_max", s.dt_max);
  field("tau_min", s.tau_min), field("mach_max", s.mach_max), field("limited", s.limited);
  field("backflow", s.backflow), field("memory_peak", s.memory_peak);
}

template <class T>
Json written(T record) {
  Json json = Json::object();
  fields(record, JsonWriter{json});
  return json;
}

template <class T>
T read(const Json& json) {
  T record;
  fields(record, JsonReader{json});
  return record;
}

Json written_fines(const std::vector<FinesSummary>& fines) {
  Json json = Json::object();
  for (const auto& f : fines) {
    json[f.name] = written(f);
    json[f.name]["by_mechanism"] = written(f.by_mechanism);
  }
  return json;
}

std::vector<FinesSummary> fines_of(const Json& json) {
  std::vector<FinesSummary> fines;
  for (const auto& [name, item] : part(json, "fines").items()) {
    fines.push_back(read<FinesSummary>(item));
    fines.back().name = name;
    fines.back().by_mechanism = read<MechanismShares>(part(item, "by_mechanism"));
  }
  return fines;
}

Summary summary_of(const Json& json) {
  Summary s = read<Summary>(json);
  for (const auto& [name, seconds] : part(json, "phases").items()) {
    if (seconds.is_number()) s.phases.push_back({name, seconds.get<double>()});
  }
  for (const auto& item : part(json, "skipped")) s.skipped.push_back(read<SkippedWork>(item));
  const std::vector<double> window = numbers(part(part(json, "pressure"), "window"));
  if (window.size() == 2) {  // else there was no air between openings
    const Json& p = json["pressure"];
    s.pressure.emplace();
    s.pressure->static_drop = read<TimeMean>(part(p, "static_drop"));
    s.pressure->total_to_static_drop = read<TimeMean>(part(p, "total_to_static_drop"));
    s.pressure->flow_rate = read<TimeMean>(part(p, "flow_rate"));
    s.pressure->window_begin = window[0], s.pressure->window_end = window[1];
  }
  for (const auto& [patch, item] : part(json, "forces").items()) {
    const std::vector<double> force = numbers(item);
    if (force.size() == 3) s.forces.push_back({patch, force[0], force[1], force[2]});
  }
  if (json.contains("air_mass")) s.air_mass = read<AirMass>(json["air_mass"]);
  if (part(json, "carriers").value("count", 0.0) > 0.0) s.carriers = read<CarrierSummary>(json["carriers"]);
  s.fines = fines_of(json);
  if (s.carriers && json.contains("collisions")) s.collisions = read<CollisionSummary>(json["collisions"]);
  for (const auto& text : part(json, "warnings")) s.warnings.push_back(text.get<std::string>());
  for (const auto& text : part(json, "assumptions")) s.assumptions.push_back(text.get<std::string>());
  for (const auto& row : part(json, "reference")) s.reference.push_back(read<ReferenceRow>(row));
  return s;
}

Json to_json(const Summary& s) {
  Json json = Json::object();
  json["format"] = format_version;
  json.update(written(s));
  json["warnings"] = s.warnings;
  json["phases"] = Json::object();
  for (const auto& phase : s.phases) json["phases"][phase.name] = number(phase.seconds);
  json["skipped"] = Json::array();
  for (const auto& skip : s.skipped) json["skipped"].push_back(written(skip));
  // What the case does not have is there too, empty: readers need not ask for each key.
  const PressureSummary pressure = s.pressure.value_or(PressureSummary{});
  json["pressure"] = {
      {"static_drop", written(pressure.static_drop)},
      {"total_to_static_drop", written(pressure.total_to_static_drop)},
      {"flow_rate", written(pressure.flow_rate)},
      {"window", s.pressure ? Json{number(pressure.window_begin), number(pressure.window_end)} : Json(nullptr)}};
  json["forces"] = Json::object();
  for (const auto& f : s.forces) json["forces"][f.patch] = {number(f.fx), number(f.fy), number(f.fz)};
  if (s.air_mass) json["air_mass"] = written(*s.air_mass);
  json["carriers"] = written(s.carriers.value_or(CarrierSummary{}));
  if (!s.carriers) json["carriers"]["retained_fraction"] = nullptr;  // of none
  json["fines"] = written_fines(s.fines);
  json["collisions"] = written(s.collisions.value_or(CollisionSummary{}));
  json["assumptions"] = s.assumptions;
  json["reference"] = Json::array();
  for (const auto& row : s.reference) json["reference"].push_back(written(row));
  return json;
}

}  // namespace

std::string summary_json(const Summary& summary) {
  return to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}
std::string fines_json(const std::vector<FinesSummary>& fines) {
  return written_fines(fines).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const std::filesystem::path& file, const Summary& summary) {
  write_whole(file, summary_json(summary));
}

std::vector<FinesSummary> read_fines(const std::filesystem::path& file) {
  const Json json = read_json(file);
  try {
    return fines_of(json);
  } catch (const nlohmann::json::exception& error) {
    throw OutputError(file.string() + " is damaged: " + error.what());
  }
}

Summary read_summary(const std::filesystem::path& file) {
  const Json json = read_json(file);
  if (!json.contains("state") || !json["state"].is_string())
    throw OutputError(file.string() + " is damaged: it does not say how the run ended ('state')");
  try {
    return summary_of(json);
  } catch (const nlohmann::json::exception& error) {
    throw OutputError(file.string() + " is damaged: " + error.what());
  }
}

}  // namespace puffin::output
