#include "tools/puffin/law_limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>

#include "coupling/carry_fines.hpp"
#include "micromodels/law.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

constexpr const char* subject_of_all = "micro-models: an impact ";
constexpr const char* before_time = "(t = ";

double fastest_valid(const std::optional<micromodels::Law>& law) {
  return law ? micromodels::valid(*law).high : std::numeric_limits<double>::infinity();
}

}  // namespace

void warn_beyond_laws(const cases::Simulation& s, std::vector<std::string>& warnings) {
  const std::optional<double> begin = coupling::counted_from(s.models, s.state);
  if (!s.models.fines || !begin) return;
  const micromodels::FinesModels& laws = *s.models.fines;
  const double on_wall = std::min(fastest_valid(laws.wall_detach), fastest_valid(laws.wall_attach));
  const double between = fastest_valid(laws.particle_detach);
  const auto say = [&](const char* kind, double speed, double limit, double time) {
    const std::string subject = std::string(subject_of_all) + kind;
    if (std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) { return w.starts_with(subject); }))
      return;
    char text[160];
    std::snprintf(text, sizeof text, ", at %.3g m/s (t = %.9g s), is faster than its law was made for, %.3g m/s", speed,
                  time, limit);
    warnings.push_back(subject + text);
    log_warning(s.description.name + ": " + warnings.back());
  };
  for (const dem::ContactBegun& c : s.state.events.begun) {
    if (c.time < *begin) continue;
    const double speed = c.b < 0 ? c.normal_speed : std::hypot(c.normal_speed, c.tangential_speed);
    if (c.b < 0 && speed > on_wall) say("on a wall", speed, on_wall, c.time);
    if (c.b >= 0 && speed > between) say("between carriers", speed, between, c.time);
  }
}

void forget_beyond_laws(double time, std::vector<std::string>& warnings) {
  std::erase_if(warnings, [&](const std::string& w) {
    const std::size_t at = w.find(before_time);
    return w.starts_with(subject_of_all) && at != std::string::npos &&
           std::strtod(w.c_str() + at + std::strlen(before_time), nullptr) > time;
  });
}

}  // namespace puffin::tools
