// puffin micromodel derive: impacts of one coated carrier, resolved; a fitted set of laws with plot and table.

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "cases/units.hpp"
#include "cases/write_micromodels.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/arguments.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/derived_mechanism.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/law_plot.hpp"
#include "tools/puffin/micromodel.hpp"

namespace puffin::tools {
namespace {

using micromodels::Partner;
using namespace micromodels::derivation;
using nlohmann::json;

struct DeriveArguments {
  std::string energy, carrier_diameter = "70 um", fine_diameter = "1.9 um", carrier_density = "1520 kg/m^3",
                      fine_density = "1520 kg/m^3", modulus = "24 GPa", wall_modulus = "2.5 GPa", gap = "0.4 nm",
                      yield = "0.9 GPa", wall_yield = "0.15 GPa";
  double poisson = 0.3, wall_poisson = 0.35, restitution = 0.7, friction = 0.3, spread = 0.0;
  int fines = 2000, patches = 0, impacts = 200, elsewhere = 60, threads = 0;
  std::uint64_t seed = 1;
  std::vector<double> speeds, angles{90.0}, slips{20.0, 40.0, 60.0, 80.0};
  std::vector<std::string> targets{"wall", "carrier"};
  std::filesystem::path out;
  std::string law = "power";
  bool full = false, as_json = false;
};

/// "none": elastic at any pressure.
double yield_pressure(const std::string& text, const char* option) {
  return text == "none" ? std::numeric_limits<double>::infinity()
                        : positive_quantity(text, cases::unit::pressure, option);
}

/// Both laws have five constants, and their points stand in the order of the speeds.
void check_speeds(const std::vector<double>& speeds) {
  if (speeds.empty()) return;
  if (speeds.size() < 5 || !std::is_sorted(speeds.begin(), speeds.end(), std::less_equal<>()))
    throw UsageError(
        "--speeds: the law fitted to them (beside a table too) has five constants: give at least 5 speeds that rise, "
        "or none for the "
        "default ones around the threshold");
}

Scene scene_of(const DeriveArguments& a, Partner target) {
  Scene s;
  s.carrier_diameter = positive_quantity(a.carrier_diameter, cases::unit::length, "--carrier-diameter");
  s.fine_diameter = positive_quantity(a.fine_diameter, cases::unit::length, "--fine-diameter");
  s.carrier_density = positive_quantity(a.carrier_density, cases::unit::density, "--carrier-density");
  s.fine_density = positive_quantity(a.fine_density, cases::unit::density, "--fine-density");
  s.surface.grains = {positive_quantity(a.modulus, cases::unit::pressure, "--modulus"), a.poisson,
                      yield_pressure(a.yield, "--yield-pressure")};
  s.surface.wall = {positive_quantity(a.wall_modulus, cases::unit::pressure, "--wall-modulus"), a.wall_poisson,
                    yield_pressure(a.wall_yield, "--wall-yield-pressure")};
  s.surface.surface_energy = positive_quantity(a.energy, cases::unit::surface_energy, "--surface-energy");
  s.surface.cutoff_gap = positive_quantity(a.gap, cases::unit::length, "--cutoff-gap");
  s.surface.restitution = a.restitution;
  s.surface.friction = a.friction;
  s.fines = a.fines, s.patches = a.patches, s.spread = a.spread;
  s.target = target;
  check(s);
  return s;
}

/// Of the surrogate: fines between carrier and wall soften the contact and shift it upwards.
double bare_threshold(const Scene& s) {
  micromodels::LiftOffLaw::Constants c;
  c.partner = s.target;
  c.carrier_diameter = s.carrier_diameter;
  c.carrier_mass = carrier_mass(s) + s.fines * fine_mass(s);
  c.fine_diameter = s.fine_diameter, c.fine_density = s.fine_density;
  c.youngs_modulus = s.surface.grains.youngs_modulus, c.poisson = s.surface.grains.poisson;
  c.wall_youngs_modulus = s.surface.wall.youngs_modulus, c.wall_poisson = s.surface.wall.poisson;
  c.surface_energy = s.surface.surface_energy;
  return micromodels::LiftOffLaw(c).threshold();
}

std::vector<double> default_speeds(double threshold) {
  std::vector<double> speeds;
  for (const double part :
       {0.3, 0.5, 0.7, 0.9, 1.1, 1.25, 1.4, 1.55, 1.7, 1.85, 2.0, 2.2, 2.45, 2.8, 3.3, 4.0, 5.0, 6.5})
    speeds.push_back(part * threshold);
  return speeds;
}

DerivedMechanism derive(const DeriveArguments& a, Partner target) {
  DerivedMechanism m;
  m.scene = scene_of(a, target);
  const double bare = bare_threshold(m.scene);
  const std::vector<double> speeds = a.speeds.empty() ? default_speeds(bare) : a.speeds;
  for (const double angle : a.angles)
    for (const double speed : speeds) {
      const bool steep = angle == a.angles.front() && speed > 1.05 * bare && speed < 2.5 * bare;
      m.points.push_back(derive_point(m.scene, speed, angle, steep ? a.impacts : std::min(a.impacts, a.elsewhere),
                                      a.seed, a.full ? Resolve::all : Resolve::contact));
      const DerivedPoint& p = m.points.back();
      char line[200];
      std::snprintf(line, sizeof line,
                    "%s %6.3f m/s %4.0f deg: detached %.4f +- %.4f, on the wall %.5f, overlap %.2f R_f, %.1f s",
                    target == Partner::wall ? "wall   " : "carrier", speed, angle, p.detached, p.detached_error,
                    p.attached, p.deepest, p.seconds);
      log_info(line);
      if (angle == a.angles.front() && sound(p, m.scene)) m.fitted.push_back(p);
    }
  m.detach = fit_power(detached_points(m.fitted, m.scene.fines));
  if (target == Partner::wall) m.attach = fit_power(attached_points(m.fitted, m.scene.fines));
  m.half = half_predicts_half(m.fitted, m.scene.fines);
  return m;
}

std::string drag_comment(const DeriveArguments& a, const Scene& s, json& rows) {
  std::string out = "Drag does not act: a carrier held in air (1.204 kg/m^3, 1.82e-5 Pa s), parts of its fines:";
  for (const double slip : a.slips) {
    const HeldOutcome h = held_in_flow(s, slip, 1.204, 1.82e-5, a.seed);
    char line[160];
    std::snprintf(line, sizeof line, "\n%5.1f m/s: lifted %.4f, sliding %.4f, rolling %.4f", slip,
                  h.lifted / double(s.fines), h.sliding / double(s.fines), h.rolling / double(s.fines));
    out += line;
    rows.push_back({{"slip", slip},
                    {"lifted", h.lifted / double(s.fines)},
                    {"sliding", h.sliding / double(s.fines)},
                    {"rolling", h.rolling / double(s.fines)}});
  }
  return out + "\nSliding and rolling fines move along the carrier; none is lifted off it.";
}

std::string provenance(const DeriveArguments& a) {
  char head[600];
  std::snprintf(head, sizeof head,
                "Derived by puffin micromodel derive: %d fines of %s on a carrier of %s, %s, surface energy %s,\n"
                "E = %s, nu = %g, yield pressure %s; wall E = %s, nu = %g, yield pressure %s;\n"
                "restitution %g, friction %g, spread of the adhesion %g, seed %llu.",
                a.fines, a.fine_diameter.c_str(), a.carrier_diameter.c_str(),
                a.patches > 0 ? "in patches" : "uniformly spread", a.energy.c_str(), a.modulus.c_str(), a.poisson,
                a.yield.c_str(), a.wall_modulus.c_str(), a.wall_poisson, a.wall_yield.c_str(), a.restitution,
                a.friction, a.spread, static_cast<unsigned long long>(a.seed));
  return head;
}

/// A table of its own beside the micro-model file.
std::filesystem::path beside(std::filesystem::path out, const std::string& name) {
  return out.replace_filename(out.stem().string() + "-" + name + ".csv");
}

int derive_set(const DeriveArguments& a) {
  check_speeds(a.speeds);
  std::optional<tbb::global_control> limit;
  if (a.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(a.threads));
  const bool tables = a.law == "table";
  if (tables && a.out.empty()) throw std::invalid_argument("--law table needs --out: tables stand beside the file");
  micromodels::FinesModels models;
  models.label = micromodels::Label::derived;
  models.source = "resolved impacts of one coated carrier (docs/micromodels.md)";
  std::map<std::string, std::string> comments{{"", provenance(a)}}, files;
  std::vector<output::Curve> data;
  json j;
  std::optional<Scene> scene;
  for (const std::string& target : a.targets) {
    const bool wall = target == "wall";
    const DerivedMechanism m = derive(a, wall ? Partner::wall : Partner::carrier);
    scene = m.scene;
    models.surface_energy = m.scene.surface.surface_energy;
    const auto add_law = [&](const std::string& key, const PowerFit& fit, const Fraction& fraction,
                             std::optional<micromodels::Law>& law) {
      const micromodels::Validity valid{0.0, m.fitted.back().speed};
      if (tables) {
        law = tabulate(m, a.angles, fraction, valid, beside(a.out, key));
        files[key] = beside(a.out, key).filename().string();
      } else {
        law = micromodels::PowerLaw(fit.law().constants(), valid);
      }
    };
    const Fraction detached{&DerivedPoint::detached, &DerivedPoint::detached_error};
    if (wall) {
      add_law("wall_detach", m.detach, detached, models.wall_detach);
      comments["wall_detach"] = detach_comment(m, a.impacts);
      comments["wall_attach"] = attach_comment(m, a.impacts);
      add_law("wall_attach", m.attach, {&DerivedPoint::attached, &DerivedPoint::attached_error}, models.wall_attach);
    } else {
      comments["particle_detach"] = detach_comment(m, a.impacts);
      add_law("particle_detach", m.detach, detached, models.particle_detach);
    }
    if (!a.out.empty()) write_points(beside(a.out, target), m);
    output::Curve curve{target + ", resolved", {}, {}};
    for (const auto& p : m.fitted) curve.x.push_back(p.speed), curve.y.push_back(p.detached);
    data.push_back(curve);
    j[target] = as_json(m);
  }
  json drag = json::array();
  comments["drag_detach"] = drag_comment(a, *scene, drag);
  j["held_in_flow"] = drag;
  const std::string text = cases::write_micromodels(models, comments, files);
  if (!a.out.empty()) {
    output::write_whole(a.out, text);
    auto curves = law_curves(models, plot_range(models));
    std::erase_if(curves, [](const output::Curve& c) { return c.name == "wall_attach"; });
    curves.insert(curves.end(), data.begin(), data.end());
    auto plot = a.out;
    write_svg(plot.replace_extension(".svg"), {"impact speed [m/s]", "fraction of the initial fines", curves, {}});
  }
  print(a.as_json ? j.dump(2) : text);
  return ok;
}

}  // namespace

Action micromodel_derive(CLI::App& app) {
  auto a = std::make_shared<DeriveArguments>();
  app.add_option("--surface-energy", a->energy, "of one surface")->required()->type_name("ENERGY");
  app.add_option("--target", a->targets, "what is hit: wall, carrier (default both)")
      ->check(CLI::IsMember({"wall", "carrier"}));
  app.add_option("--speeds", a->speeds, "[m/s]; default: around the threshold")->check(CLI::PositiveNumber);
  app.add_option("--angles", a->angles, "between velocity and surface [degrees]; the first one is fitted")
      ->check(CLI::Range(1.0, 90.0));
  app.add_option("--slip-speeds", a->slips, "of a carrier held in a flow [m/s]")->check(CLI::PositiveNumber);
  app.add_option("--impacts", a->impacts, "seeded impacts a point")->check(CLI::Range(2, 100000));
  app.add_option("--impacts-elsewhere", a->elsewhere, "where the law is flat, and at other angles than the first")
      ->check(CLI::Range(2, 100000));
  app.add_option("--fines", a->fines, "on the carrier")->check(CLI::Range(1, 20000));
  app.add_option("--patches", a->patches, "0: a uniform coat")->check(CLI::NonNegativeNumber);
  app.add_option("--spread", a->spread, "standard deviation of ln(adhesion of a fine)")->check(CLI::NonNegativeNumber);
  app.add_option("--carrier-diameter", a->carrier_diameter)->type_name("LENGTH");
  app.add_option("--fine-diameter", a->fine_diameter)->type_name("LENGTH");
  app.add_option("--carrier-density", a->carrier_density)->type_name("DENSITY");
  app.add_option("--fine-density", a->fine_density)->type_name("DENSITY");
  app.add_option("--modulus", a->modulus, "Young's modulus of carrier and fines, the material's own")
      ->type_name("PRESSURE");
  app.add_option("--poisson", a->poisson);
  app.add_option("--wall-modulus", a->wall_modulus)->type_name("PRESSURE");
  app.add_option("--wall-poisson", a->wall_poisson);
  app.add_option("--yield-pressure", a->yield, "of carrier and fines: largest mean pressure of a contact, or none")
      ->type_name("PRESSURE");
  app.add_option("--wall-yield-pressure", a->wall_yield, "likewise of the wall")->type_name("PRESSURE");
  app.add_option("--cutoff-gap", a->gap)->type_name("LENGTH");
  app.add_option("--restitution", a->restitution);
  app.add_option("--friction", a->friction);
  app.add_option("--seed", a->seed);
  app.add_option("--threads", a->threads);
  app.add_option("--law", a->law, "power (fitted) or table: the points themselves, with every angle")
      ->check(CLI::IsMember({"power", "table"}));
  app.add_flag("--full", a->full, "resolve every fine: slow, for small coats");
  app.add_option("--out", a->out, "the micro-model file; a plot and tables are put beside it")->type_name("FILE.toml");
  app.add_flag("--json", a->as_json, "one JSON object on stdout");
  return [a] {
    try {
      return derive_set(*a);
    } catch (const std::invalid_argument& e) {
      throw UsageError(e.what());
    }
  };
}

}  // namespace puffin::tools
