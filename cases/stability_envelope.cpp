#include "cases/stability_envelope.hpp"

#include <toml++/toml.h>
#include <cstdio>
#include <stdexcept>

#include "cases/choices.hpp"
#include "cases/format/toml_file.hpp"

namespace puffin::cases {
namespace {

/// Relaxation time above which the map says nothing: viscosity damps whatever the settings. Two relaxation times hold a
/// shear wave in a periodic box at 0.5116 and ruin it, without an end, at 0.5087.
double viscous(Collision collision) { return collision == Collision::trt ? 0.512 : 0.505; }

[[noreturn]] void refuse(const std::filesystem::path& file, const toml::node& at, const std::string& text) {
  throw std::runtime_error(file.string() + ":" + std::to_string(at.source().begin.line) + ": " + text);
}

template <class Enum>
Enum word(const std::filesystem::path& file, const toml::table& table, const char* key) {
  const auto text = table[key].value<std::string>();
  for (const Choice& choice : choices<Enum>())
    if (text && choice.name == *text) return static_cast<Enum>(choice.value);
  refuse(file, table, std::string("'") + key + "' is missing or no word of the case file");
}

double number(const std::filesystem::path& file, const toml::table& table, const char* key) {
  if (const auto value = table[key].value<double>()) return *value;
  refuse(file, table, std::string("needs '") + key + "', a number");
}

/// "rr3, smagorinsky 0.1, bouzidi"
std::string settings_of(Collision collision, Les les, double constant, WallScheme wall) {
  std::string text = std::string(name_of(collision)) + ", ";
  if (les == Les::none) {
    text += "les none";
  } else {
    char number[32];
    std::snprintf(number, sizeof number, "%g", constant);
    text += std::string(name_of(les)) + " " + number;
  }
  return text + ", " + std::string(name_of(wall));
}

double constant_of(const Case& c) { return c.numerics.les == Les::none ? 0.0 : c.numerics.smagorinsky_constant; }

/// The row of the case's words with the largest constant that is not above its own; nullptr: none.
const EnvelopeRow* row_of(const Case& c, const std::vector<EnvelopeRow>& rows) {
  const EnvelopeRow* best = nullptr;
  for (const EnvelopeRow& r : rows) {
    if (r.collision != c.numerics.collision || r.les != c.numerics.les || r.wall != c.numerics.wall) continue;
    if (r.smagorinsky_constant > constant_of(c) * (1.0 + 1e-9)) continue;
    if (best == nullptr || r.smagorinsky_constant > best->smagorinsky_constant) best = &r;
  }
  return best;
}

}  // namespace

std::vector<EnvelopeRow> read_envelope(const std::filesystem::path& file) {
  const toml::table toml = format::parse_toml(format::read_text(file), file.string());
  const auto* list = toml["setting"].as_array();
  if (list == nullptr) refuse(file, toml, "needs [[setting]]");
  std::vector<EnvelopeRow> rows;
  for (const auto& item : *list) {
    if (!item.is_table()) refuse(file, item, "[[setting]] is a table");
    const toml::table& t = *item.as_table();
    EnvelopeRow r;
    r.collision = word<Collision>(file, t, "collision");
    r.les = word<Les>(file, t, "les");
    r.wall = word<WallScheme>(file, t, "wall");
    r.smagorinsky_constant = number(file, t, "smagorinsky_constant");
    r.runs = number(file, t, "runs");
    r.heals = number(file, t, "heals");
    r.tried = number(file, t, "tried");
    r.failure = t["failure"].value_or(std::string());
    rows.push_back(std::move(r));
  }
  return rows;
}

std::string write_envelope(const std::vector<EnvelopeRow>& rows) {
  std::string text =
      "# What ran in the maps of `puffin bench stability --out DIR`, which writes this file there: per collision, "
      "eddy\n"
      "# viscosity and wall the largest numerics.lattice_speed up to which every scene ran to its end (runs), or at "
      "least\n"
      "# went on with smaller steps (heals), of those tried. `puffin check` reads it.\n";
  char line[256];
  for (const EnvelopeRow& r : rows) {
    std::snprintf(line, sizeof line,
                  "\n[[setting]]\ncollision = \"%s\"\nles = \"%s\"\nsmagorinsky_constant = %g\nwall = \"%s\"\n"
                  "runs = %g\nheals = %g\ntried = %g\n",
                  std::string(name_of(r.collision)).c_str(), std::string(name_of(r.les)).c_str(),
                  r.smagorinsky_constant, std::string(name_of(r.wall)).c_str(), r.runs, r.heals, r.tried);
    text += line;
    if (!r.failure.empty()) text += "failure = \"" + r.failure + "\"\n";
  }
  return text;
}

std::string outside_envelope(const Case& c, double tau, double lattice_speed, const std::vector<EnvelopeRow>& rows) {
  if (tau > viscous(c.numerics.collision) || rows.empty()) return {};
  const std::string settings = settings_of(c.numerics.collision, c.numerics.les, constant_of(c), c.numerics.wall);
  const EnvelopeRow* row = row_of(c, rows);
  if (row == nullptr)
    return settings + " at so small a viscosity is not in the map of stability (puffin bench stability)";
  const double speed = lattice_speed * (1.0 - 1e-9);
  char text[320];
  if (speed > row->tried) {
    std::snprintf(text, sizeof text, "a lattice_speed of %.3g is beyond the map of stability, which ends at %.3g",
                  lattice_speed, row->tried);
  } else if (speed > row->heals) {
    std::snprintf(text, sizeof text, "%s diverged in the map of stability (%s): expect retreats or exit code 5; %s",
                  settings.c_str(), row->failure.c_str(),
                  row->heals > 0.0 ? "a lower lattice_speed ran" : "collision rr3 with smagorinsky runs");
  } else if (speed > row->runs) {
    std::snprintf(text, sizeof text,
                  "%s needed smaller steps in the map of stability (%s); the run takes them by itself",
                  settings.c_str(), row->failure.c_str());
  } else {
    return {};
  }
  return text;
}

}  // namespace puffin::cases
