#include "cases/micromodel_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "cases/format/toml_fields.hpp"
#include "cases/format/toml_file.hpp"
#include "cases/table_file.hpp"

namespace puffin::cases {
namespace {

using format::Fields;
using format::otherwise;
using format::Range;
using format::required;
using micromodels::FinesModels;
using micromodels::Law;
using micromodels::Validity;

constexpr Unit mass_unit{{1, 0, 0}, "a mass", "kg", "2.84e-10 kg"};

std::vector<double> sorted_values(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// Rows in any order; with angles, every pair of a speed and an angle must be there once.
micromodels::TableLaw read_table(const std::string& file, bool may_fall, Validity valid) {
  const auto columns = read_columns(file);
  const auto speed = columns.find("speed"), angle = columns.find("angle");
  const auto value = columns.count("fraction") ? columns.find("fraction") : columns.find("rate");
  if (speed == columns.end() || value == columns.end())
    throw std::invalid_argument(file + ": needs the columns speed, fraction (or rate), and, if wanted, angle");
  const std::vector<double> speeds = sorted_values(speed->second);
  const std::vector<double> angles = angle == columns.end() ? std::vector<double>{} : sorted_values(angle->second);
  const std::size_t width = std::max<std::size_t>(1, angles.size());
  std::vector<double> values(speeds.size() * width, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < speed->second.size(); ++row) {
    const std::size_t i = std::lower_bound(speeds.begin(), speeds.end(), speed->second[row]) - speeds.begin();
    const std::size_t j =
        angles.empty() ? 0 : std::lower_bound(angles.begin(), angles.end(), angle->second[row]) - angles.begin();
    values[i * width + j] = value->second[row];
  }
  if (speed->second.size() != values.size() ||
      std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
    throw std::invalid_argument(file + ": needs each pair of a speed and an angle exactly once");
  if (value->first == "fraction" && *std::max_element(values.begin(), values.end()) > 1.0)
    throw std::invalid_argument(file + ": a fraction above 1 would take more fines than there are");
  return micromodels::TableLaw(speeds, angles, values, may_fall, valid);
}

/// The law that `make` makes; what it refuses is a mistake at `key`.
template <class Make>
Law law_of(Fields& io, const char* key, Validity valid, const Make& make) {
  try {
    return make();
  } catch (const std::invalid_argument& e) {
    io.problem(key, e.what());
    return micromodels::PowerLaw({}, valid);
  }
}

Law power_law(Fields& io, Validity valid) {
  std::vector<double> a(5, 0.0);
  io.numbers("A", a, 5, unit::number, required);
  std::array<double, 5> constants{};
  std::copy_n(a.begin(), std::min<std::size_t>(a.size(), 5), constants.begin());
  return law_of(io, "A", valid, [&] { return micromodels::PowerLaw(constants, valid); });
}

Law table_law(Fields& io, Validity valid) {
  std::string file;
  bool may_fall = false;
  io.file("file", file, {});
  io.flag("may_fall", may_fall, otherwise(false));
  if (file.empty()) return micromodels::PowerLaw({}, valid);  // reported: the file is missing
  return law_of(io, "file", valid, [&] { return read_table(file, may_fall, valid); });
}

Law weibull_law(Fields& io, Validity valid) {
  micromodels::WeibullLaw::Constants c;
  io.number("limit", c.limit, unit::number, Range::fraction, otherwise(1.0));
  io.number("energy_ratio", c.energy_ratio, unit::number, Range::positive, required);
  io.number("shape", c.shape, unit::number, Range::positive, required);
  io.number("carrier_mass", c.carrier_mass, mass_unit, Range::positive, required);
  io.number("adhesion_energy", c.adhesion_energy, unit::energy, Range::positive, required);
  return micromodels::WeibullLaw(c, valid);
}

Law lift_off_law(Fields& io, Validity valid, double surface_energy) {
  micromodels::LiftOffLaw::Constants c;
  static constexpr std::array partners{Choice{0, "wall", true}, Choice{1, "carrier", true}};
  c.partner = static_cast<micromodels::Partner>(io.pick("partner", partners, 0, otherwise(0)));
  io.number("carrier_diameter", c.carrier_diameter, unit::length, Range::positive, required);
  io.number("carrier_mass", c.carrier_mass, mass_unit, Range::positive, required);
  io.number("fine_diameter", c.fine_diameter, unit::length, Range::positive, required);
  io.number("fine_density", c.fine_density, unit::density, Range::positive, required);
  io.number("youngs_modulus", c.youngs_modulus, unit::pressure, Range::positive, required);
  io.number("poisson", c.poisson, unit::number, Range::non_negative, required);
  if (c.partner == micromodels::Partner::wall || io.has("wall_youngs_modulus", false)) {
    if (io.word("wall_youngs_modulus", {"rigid"}, -1, -1) == 0)
      c.wall_youngs_modulus = std::numeric_limits<double>::infinity();
    else
      io.number("wall_youngs_modulus", c.wall_youngs_modulus, unit::pressure, Range::positive, required);
    io.number("wall_poisson", c.wall_poisson, unit::number, Range::non_negative, required);
  }
  io.number("surface_energy", c.surface_energy, unit::surface_energy, Range::positive,
            surface_energy > 0.0 ? otherwise(surface_energy) : format::Fallback<double>{});
  io.number("spread", c.spread, unit::number, Range::non_negative, otherwise(0.0));
  io.number("limit", c.limit, unit::number, Range::fraction, otherwise(0.5));
  return micromodels::LiftOffLaw(c, valid);
}

Law read_law(Fields& io, double surface_energy) {
  static constexpr std::array laws{Choice{0, "power", true}, Choice{1, "table", true}, Choice{2, "weibull", true},
                                   Choice{3, "lift-off", true}};
  const int law = io.pick("law", laws, 0, required);
  Validity valid;
  if (io.has("valid", false)) {
    std::vector<double> range{0.0, 0.0};
    io.numbers("valid", range, 2, unit::velocity, required);
    if (!(range[0] >= 0.0 && range[0] < range[1])) io.problem("valid", "give [low, high] in m/s, with 0 <= low < high");
    valid = {range[0], range[1]};
  }
  if (law == 1) return table_law(io, valid);
  if (law == 2) return weibull_law(io, valid);
  if (law == 3) return lift_off_law(io, valid, surface_energy);
  return power_law(io, valid);
}

void describe(Fields& io, FinesModels& models, const format::Findings& findings) {
  static constexpr std::array labels{Choice{0, "derived", true}, Choice{1, "calibrated", true},
                                     Choice{2, "surrogate", true}, Choice{3, "given", true}};
  models.label = static_cast<micromodels::Label>(io.pick("label", labels, 3, required));
  io.text("source", models.source, otherwise<std::string>(""));
  io.number("surface_energy", models.surface_energy, unit::surface_energy, Range::non_negative, otherwise(0.0));
  const std::array<std::pair<const char*, std::optional<Law>*>, 4> mechanisms{
      {{"wall_detach", &models.wall_detach},
       {"wall_attach", &models.wall_attach},
       {"particle_detach", &models.particle_detach},
       {"drag_detach", &models.drag_detach}}};
  for (const auto& [key, law] : mechanisms) {
    if (!io.has(key, false)) continue;
    io.section(key, [&, name = key, target = law](Fields& f) {
      try {
        *target = read_law(f, models.surface_energy);
      } catch (
          const std::invalid_argument& e) {  // a law refuses its constants: say so unless a key is reported already
        if (!findings.broken(name)) f.problem("law", e.what());
      }
    });
  }
}

}  // namespace

FinesModels read_micromodels(const std::filesystem::path& file) {
  const std::string text = format::read_text(file);
  const toml::table root = format::parse_toml(text, file.string());
  format::Findings findings(file.string(), text);
  FinesModels models;
  format::TomlFields fields(root, "", findings, file.parent_path());
  describe(fields, models, findings);
  fields.finish();
  if (findings.problems().empty()) try {
      micromodels::check(models);
    } catch (const std::invalid_argument& e) {
      findings.problem("", e.what());
    }
  if (!findings.problems().empty()) throw CaseError(findings.sorted_problems());
  return models;
}

std::string micromodels_with_tables(const std::filesystem::path& file) {
  std::string all = format::read_text(file);
  const toml::table root = format::parse_toml(all, file.string());
  for (const auto& [mechanism, node] : root) {
    const auto name = node.is_table() ? node.as_table()->get_as<std::string>("file") : nullptr;
    if (!name) continue;
    std::string table;
    try {
      table = format::read_text(file.parent_path() / name->get());
    } catch (const std::exception&) {  // read_micromodels says what is wrong with it
      continue;
    }
    all += "\n# " + name->get() + "\n";
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) all += "# " + line + "\n";
  }
  return all;
}

}  // namespace puffin::cases
