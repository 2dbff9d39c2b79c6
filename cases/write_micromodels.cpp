#include "cases/write_micromodels.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "cases/toml_string.hpp"

namespace puffin::cases {
namespace {

using micromodels::LiftOffLaw;
using micromodels::PowerLaw;
using micromodels::TableLaw;
using micromodels::WeibullLaw;

/// The shortest text that reads back as the same number, as TOML wants it.
std::string number(double value) {
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  char text[40];
  for (int digits = 1; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  std::string out = text;
  if (out.find_first_of(".e") == std::string::npos) out += ".0";
  return out;
}

std::string commented(const std::map<std::string, std::string>& comments, const std::string& key) {
  const auto found = comments.find(key);
  if (found == comments.end()) return {};
  std::istringstream lines(found->second);
  std::string out;
  for (std::string line; std::getline(lines, line);) out += (line.empty() ? "#" : "# " + line) + '\n';
  return out;
}

void put(std::string& out, const char* key, double value) { out += std::string(key) + " = " + number(value) + '\n'; }

std::string keys(const PowerLaw& law, const std::string&) {
  std::string out = "A = [";
  for (std::size_t i = 0; i < 5; ++i) out += (i > 0 ? ", " : "") + number(law.constants()[i]);
  return out + "]\n";
}
std::string keys(const TableLaw&, const std::string& file) {
  if (file.empty()) throw std::invalid_argument("a table law needs a CSV file beside the micro-model file");
  return "file = " + toml_string(file) + "\nmay_fall = true\n";
}
std::string keys(const WeibullLaw& law, const std::string&) {
  const auto& c = law.constants();
  std::string out;
  put(out, "limit", c.limit);
  put(out, "energy_ratio", c.energy_ratio);
  put(out, "shape", c.shape);
  put(out, "carrier_mass", c.carrier_mass);
  put(out, "adhesion_energy", c.adhesion_energy);
  return out;
}
std::string keys(const LiftOffLaw& law, const std::string&) {
  const auto& c = law.constants();
  const bool wall = c.partner == micromodels::Partner::wall;
  std::string out = std::string("partner = ") + (wall ? "\"wall\"" : "\"carrier\"") + '\n';
  put(out, "carrier_diameter", c.carrier_diameter);
  put(out, "carrier_mass", c.carrier_mass);
  put(out, "fine_diameter", c.fine_diameter);
  put(out, "fine_density", c.fine_density);
  put(out, "youngs_modulus", c.youngs_modulus);
  put(out, "poisson", c.poisson);
  if (wall) {
    if (std::isinf(c.wall_youngs_modulus))
      out += "wall_youngs_modulus = \"rigid\"\n";
    else
      put(out, "wall_youngs_modulus", c.wall_youngs_modulus);
    put(out, "wall_poisson", c.wall_poisson);
  }
  put(out, "surface_energy", c.surface_energy);
  put(out, "spread", c.spread);
  put(out, "limit", c.limit);
  return out;
}

}  // namespace

std::string name(micromodels::Label label) {
  switch (label) {
    case micromodels::Label::derived:
      return "derived";
    case micromodels::Label::calibrated:
      return "calibrated";
    case micromodels::Label::surrogate:
      return "surrogate";
    case micromodels::Label::given:
      return "given";
  }
  return "given";
}

std::string write_micromodels(const micromodels::FinesModels& models,
                              const std::map<std::string, std::string>& comments,
                              const std::map<std::string, std::string>& table_files) {
  std::string out = commented(comments, "");
  if (!out.empty()) out += '\n';
  out += "label = " + toml_string(name(models.label)) + "\nsource = " + toml_string(models.source) + '\n';
  if (models.surface_energy > 0.0) put(out, "surface_energy", models.surface_energy);
  const std::pair<const char*, const std::optional<micromodels::Law>*> mechanisms[] = {
      {"wall_detach", &models.wall_detach},
      {"wall_attach", &models.wall_attach},
      {"particle_detach", &models.particle_detach},
      {"drag_detach", &models.drag_detach}};
  for (const auto& [key, law] : mechanisms) {
    if (!*law) {
      if (comments.count(key) > 0) out += '\n' + commented(comments, key);
      continue;
    }
    const auto file = table_files.find(key);
    out += '\n' + commented(comments, key) + '[' + key + "]\nlaw = " + toml_string(micromodels::name(**law)) + '\n';
    out += std::visit([&](const auto& l) { return keys(l, file == table_files.end() ? std::string() : file->second); },
                      **law);
    const micromodels::Validity& valid = micromodels::valid(**law);
    if (std::isfinite(valid.high)) out += "valid = [" + number(valid.low) + ", " + number(valid.high) + "]\n";
  }
  return out;
}

}  // namespace puffin::cases
