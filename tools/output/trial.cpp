// Runs that were not their case to its end: with a preset, or until a moment.

#include <cstdio>

#include "tools/output/summary.hpp"

namespace puffin::output {

bool cut_short(const Summary& s) {
  constexpr double rounding = 1e-9;
  if (s.state != "finished" || !s.stop_time || !s.case_stop_time) return false;
  return *s.stop_time < (1.0 - rounding) * *s.case_stop_time && s.simulated_time >= (1.0 - rounding) * *s.stop_time;
}

std::string trial(const Summary& s) {
  std::string text = s.preset.empty() || s.preset == "default" ? "" : "preset " + s.preset;
  if (!cut_short(s)) return text;
  char end[96];
  std::snprintf(end, sizeof end, "ended at %.4g ms of %.4g ms", 1e3 * s.simulated_time, 1e3 * *s.case_stop_time);
  return text + (text.empty() ? "" : ", ") + end;
}

}  // namespace puffin::output
