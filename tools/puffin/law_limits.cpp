#include "tools/puffin/law_limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>

#include "coupling/carry_fines.hpp"
#include "coupling/release_fines.hpp"
#include "micromodels/law.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

constexpr const char* subject_of_all = "micro-models: ";
constexpr const char* before_time = "(t = ";

/// The limit [m/s] of the law beyond which `speed` lies, if the law takes fines off there.
std::optional<double> limit_passed(const std::optional<micromodels::Law>& law, double speed, double angle) {
  if (!law || !std::isfinite(speed)) return std::nullopt;
  const micromodels::Validity& valid = micromodels::valid(*law);
  if (speed > valid.high) return valid.high;
  if (speed >= valid.low || !(micromodels::fraction(*law, speed, angle) > 0.0)) return std::nullopt;
  return valid.low;
}

/// As above for the drag's law and a slip speed.
std::optional<double> slip_limit_passed(const micromodels::Law& law, double slip) {
  if (!std::isfinite(slip)) return std::nullopt;
  const micromodels::Validity& valid = micromodels::valid(law);
  if (slip > valid.high) return valid.high;
  if (slip >= valid.low || !(micromodels::rate(law, slip) > 0.0)) return std::nullopt;
  return valid.low;
}

/// Appends and logs a warning of its subject, faster or slower, if there is none yet.
class Warner {
 public:
  Warner(const cases::Simulation& s, std::vector<std::string>& warnings) : name_(s.description.name), all_(warnings) {}

  void say(const char* what, double speed, const std::optional<double>& limit, double time) {
    if (!limit) return;
    const char* than = speed > *limit ? "is faster" : "is slower";
    const std::string subject = std::string(subject_of_all) + what + ", ", kind = than;
    const auto told = [&](const std::string& w) {
      return w.starts_with(subject) && w.find(kind, subject.size()) != std::string::npos;
    };
    if (std::any_of(all_.begin(), all_.end(), told)) return;
    char text[160];
    std::snprintf(text, sizeof text, "at %.3g m/s (t = %.9g s), %s than its law was made for, %.3g m/s", speed, time,
                  than, *limit);
    all_.push_back(subject + text);
    log_warning(name_ + ": " + all_.back());
  }

 private:
  const std::string& name_;
  std::vector<std::string>& all_;
};

void warn_of_slip(const cases::Simulation& s, Warner& warner) {
  const coupling::State& state = s.state;
  const dem::Carriers& c = state.carriers.carriers;
  // Loads have the places that carriers had before some left in this interval; then the next one is looked at.
  if (!s.models.fines->drag_detach || !state.air || state.loads.size() != c.size()) return;
  std::vector<char> outside(c.size(), 0);
  for (const int p : state.stencils.outside()) outside[static_cast<std::size_t>(p)] = 1;
  double fastest = 0.0, slowest = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < c.size(); ++p) {
    if (outside[p] || c.rest[p] == dem::Rest::held) continue;  // what is held loses nothing
    const double slip = (state.loads[p].air_velocity - c.velocity[p]).norm();
    fastest = std::max(fastest, slip);
    if (slip < slowest && slip_limit_passed(*s.models.fines->drag_detach, slip)) slowest = slip;
  }
  for (const double slip : {fastest, slowest})
    if (std::isfinite(slip))
      warner.say("the drag on a carrier", slip, slip_limit_passed(*s.models.fines->drag_detach, slip), state.time);
}

}  // namespace

void warn_beyond_laws(const cases::Simulation& s, std::vector<std::string>& warnings) {
  if (!s.models.fines) return;
  Warner warner(s, warnings);
  warn_of_slip(s, warner);
  const std::optional<double> begin = coupling::counted_from(s.models, s.state);
  if (!begin) return;
  const micromodels::FinesModels& laws = *s.models.fines;
  for (const dem::ContactBegun& c : s.state.events.begun) {
    if (c.time < *begin) continue;
    const double angle = coupling::angle_to_surface(c);
    if (c.b < 0) {
      for (const auto* law : {&laws.wall_detach, &laws.wall_attach})
        warner.say("an impact on a wall", c.normal_speed, limit_passed(*law, c.normal_speed, angle), c.time);
    } else {
      const double speed = std::hypot(c.normal_speed, c.tangential_speed);
      warner.say("an impact between carriers", speed, limit_passed(laws.particle_detach, speed, angle), c.time);
    }
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
