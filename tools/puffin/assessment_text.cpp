#include "tools/puffin/assessment_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/puffin/console.hpp"

namespace puffin::tools {

using nlohmann::json;

json assessment_json(const cases::Case& c, const cases::Assessment& a) {
  json j{{"name", c.name},         {"volume", a.volume},           {"area", a.area},
         {"memory", a.memory},     {"cells_fluid", a.cells_fluid}, {"cells_active", a.cells_fluid},
         {"warnings", a.warnings}, {"inlets", json::array()},      {"steps", 0}};
  for (const cases::InletNumbers& i : a.inlets)
    j["inlets"].push_back(
        {{"patch", i.patch}, {"area", i.area}, {"largest_mean_speed", i.largest_mean_speed}, {"reynolds", i.reynolds}});
  if (!a.lattice) {  // the names are there all the same: a script asks for them
    for (const char* key : {"dx", "dt_min", "dt_max", "tau_min", "mach_max", "reference_speed", "narrowest_gap"})
      j[key] = nullptr;
    return j;
  }
  j["dx"] = a.lattice->dx;
  j["dt_min"] = a.lattice->dt;
  j["dt_max"] = a.lattice->dt_largest;
  j["tau_min"] = a.lattice->tau;
  j["mach_max"] = a.lattice->mach;
  j["steps"] = std::llround(a.lattice->steps);
  j["reference_speed"] = a.reference_speed;
  j["narrowest_gap"] = std::isfinite(a.narrowest_gap) ? json(a.narrowest_gap) : json(nullptr);
  return j;
}

void print_assessment(const cases::Case& c, const cases::Assessment& a) {
  print("device     " + as_volume(a.volume) + ", " + four_digits(a.area * 1e6) + " mm^2 of surface");
  for (const cases::InletNumbers& i : a.inlets)
    print("inlet      " + i.patch + ": " + four_digits(i.area * 1e6) + " mm^2, up to " +
          four_digits(i.largest_mean_speed) + " m/s, Reynolds " + four_digits(i.reynolds));
  if (a.lattice) {
    print("lattice    " + std::to_string(a.cells_fluid) + " cells of " + as_length(a.lattice->dx) + ", tau " +
          four_digits(a.lattice->tau) + ", Mach " + four_digits(a.lattice->mach));
    print("steps      " + four_digits(a.lattice->steps) + " of " + as_time(a.lattice->dt) + " to " +
          as_time(a.lattice->dt_largest) + ", until " + as_time(c.stop.time));
  }
  if (c.carriers)
    print("dose       " + std::to_string(c.carriers->count) + " carriers in parcels of " +
          std::to_string(c.carriers->parcel) + ", " + four_digits(1e6 * cases::dose_mass(*c.carriers)) + " mg");
  print("memory     about " + as_bytes(a.memory));
  for (const std::string& warning : a.warnings) log_warning(warning);
}

}  // namespace puffin::tools
