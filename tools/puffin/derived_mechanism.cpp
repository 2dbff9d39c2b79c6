#include "tools/puffin/derived_mechanism.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "micromodels/continuity.hpp"
#include "tools/output/csv_file.hpp"

namespace puffin::tools {

using namespace micromodels::derivation;
using nlohmann::json;

namespace {

std::string constants_text(const PowerFit& fit) {
  std::string out = "Power law in two branches, fitted to the points head on:\n";
  for (std::size_t k = 0; k < 5; ++k) {
    char line[120];
    std::snprintf(line, sizeof line, "A%zu = %.6g (95 %%: %.4g to %.4g)\n", k, fit.A[k].value, fit.A[k].low,
                  fit.A[k].high);
    out += line;
  }
  char line[120];
  const micromodels::Jump jump = micromodels::jump(fit.law());
  std::snprintf(line, sizeof line, "rms misfit %.2f errors (of the mean, or 2 %% of the value); jump at A2: %.4g",
                fit.rms, jump.height);
  return out + line;
}

/// Of a law: how it was found, and its constants with their intervals.
std::string comment_on(const PowerFit& fit, const DerivedMechanism& m, int impacts) {
  double seconds = 0.0;
  int impacts_in_all = 0;
  for (const auto& p : m.points) seconds += p.seconds, impacts_in_all += p.impacts;
  char line[300];
  std::snprintf(line, sizeof line,
                "%zu speeds head on, %d seeded impacts each where the law is steep; %d impacts in all, %.0f s of wall "
                "clock.\n",
                m.fitted.size(), impacts, impacts_in_all, seconds);
  return line + constants_text(fit);
}

json points_json(const DerivedMechanism& m) {
  json rows = json::array();
  for (const auto& p : m.points)
    rows.push_back({{"speed", p.speed},
                    {"angle", p.angle},
                    {"impacts", p.impacts},
                    {"detached", p.detached},
                    {"detached_error", p.detached_error},
                    {"attached", p.attached},
                    {"attached_error", p.attached_error},
                    {"rolled", p.rolled},
                    {"redeposited", p.redeposited},
                    {"rebound", p.rebound},
                    {"deepest", p.deepest},
                    {"seconds", p.seconds}});
  return rows;
}

json fit_json(const PowerFit& fit) {
  json j{{"A", json::array()}, {"low", json::array()}, {"high", json::array()}, {"rms", fit.rms}};
  for (const auto& e : fit.A) {
    j["A"].push_back(e.value);
    j["low"].push_back(std::isfinite(e.low) ? json(e.low) : json());
    j["high"].push_back(std::isfinite(e.high) ? json(e.high) : json());
  }
  return j;
}

}  // namespace

bool sound(const DerivedPoint& p, const Scene& s) {
  return p.deepest < (std::isfinite(s.surface.wall.yield_pressure) ? 2.0 : 1.0);
}

std::string detach_comment(const DerivedMechanism& m, int impacts) {
  char line[120];
  std::snprintf(line, sizeof line,
                "\nA fit of the even seeds says what the odd seeds found to within %.3f of the largest fraction.",
                m.half);
  return comment_on(m.detach, m, impacts) + line;
}

std::string attach_comment(const DerivedMechanism& m, int impacts) { return comment_on(m.attach, m, impacts); }

void write_points(const std::filesystem::path& file, const DerivedMechanism& m) {
  output::CsvFile csv(file, {"speed", "angle", "fraction", "error", "attached", "attached_error", "rolled",
                             "redeposited", "impacts", "rebound", "deepest", "peak"});
  for (const auto& p : m.points)
    csv.append({p.speed, p.angle, p.detached, p.detached_error, p.attached, p.attached_error, p.rolled, p.redeposited,
                static_cast<double>(p.impacts), p.rebound, p.deepest, p.peak});
  csv.flush();
}

micromodels::TableLaw tabulate(const DerivedMechanism& m, std::vector<double> angles, const Fraction& fraction,
                               micromodels::Validity valid, const std::filesystem::path& file) {
  std::sort(angles.begin(), angles.end());
  std::vector<double> speeds;
  std::vector<DerivedPoint> points;
  for (const DerivedPoint& p : m.points)
    if (sound(p, m.scene)) points.push_back(p);
  std::sort(points.begin(), points.end(),
            [](const auto& x, const auto& y) { return x.speed != y.speed ? x.speed < y.speed : x.angle < y.angle; });
  for (std::size_t k = 0; k + angles.size() <= points.size(); k += angles.size()) {
    if (points[k + angles.size() - 1].speed != points[k].speed) break;  // not sound at every angle: ends here
    speeds.push_back(points[k].speed);
  }
  points.resize(speeds.size() * angles.size());
  output::CsvFile csv(file, {"speed", "angle", "fraction", "error"});
  std::vector<double> values;
  for (const DerivedPoint& p : points) {
    csv.append({p.speed, p.angle, p.*fraction.value, p.*fraction.error});
    values.push_back(p.*fraction.value);
  }
  csv.flush();
  return micromodels::TableLaw(speeds, angles, values, true, valid);
}

json as_json(const DerivedMechanism& m) {
  json j{{"points", points_json(m)}, {"detach", fit_json(m.detach)}, {"half_predicts_half", m.half}};
  if (m.scene.target == micromodels::Partner::wall) j["attach"] = fit_json(m.attach);
  return j;
}

}  // namespace puffin::tools
