// puffin estimate: memory, steps and wall-clock on this machine.

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/puffin/arguments.hpp"
#include "tools/puffin/assessment_text.hpp"
#include "tools/puffin/available_memory.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/rehearsal.hpp"
#include "tools/puffin/signals.hpp"

namespace puffin::tools {
namespace {

constexpr double rehearsed_seconds = 5.0;

int estimate(const CaseArguments& a) {
  const cases::Case c = a.read();
  cases::Assessment assessment = cases::assess(c, cases::load_surface(c));
  if (const double available = available_memory(); assessment.memory > available)
    throw ResourceError("the case needs about " + as_bytes(assessment.memory) + "; " + as_bytes(available) +
                        " are free: raise numerics.dx");
  const Rehearsal rehearsal = rehearse(c, rehearsed_seconds);
  if (const int code = Signals::code(); code != ok) return code;  // interrupted: nothing is known
  assessment.memory = rehearsal.memory;
  const bool counted =  // the steps of the ramp
      !rehearsal.ended && assessment.lattice && c.air.model == cases::AirModel::lbm;
  // How often the rehearsal makes up the run.
  const double rehearsals = rehearsal.ended ? 1.0 : rehearsal.time > 0.0 ? c.stop.time / rehearsal.time : 0.0;
  const double units = counted ? assessment.lattice->steps / rehearsal.step_factor : rehearsal.units * rehearsals;
  const double steps = counted ? units : static_cast<double>(rehearsal.steps) * rehearsals;
  const Forecast f = forecast(c, rehearsal, units);
  const double mlups = rehearsal.air > 0.0 ? 1e-6 * static_cast<double>(assessment.cells_fluid) / rehearsal.air : 0.0;
  if (!rehearsal.failure.empty())
    assessment.warnings.push_back("the rehearsal failed, as a run would (exit code " +
                                  std::to_string(rehearsal.failure_code) + "): " + rehearsal.failure);
  else if (rehearsal.step_factor < 1.0)
    assessment.warnings.push_back("the rehearsal went on with " + four_digits(rehearsal.step_factor) +
                                  " of the time step after retreats; so would a run, and the steps count it");
  const int code = rehearsal.failure.empty() ? ok : rehearsal.failure_code;
  if (a.json) {
    nlohmann::json j = assessment_json(c, assessment);
    j["steps"] = std::llround(steps);
    if (!assessment.lattice && rehearsal.dx > 0.0) {  // cells that carry fines through a frozen field
      j["dx"] = rehearsal.dx;
      j["dt_min"] = j["dt_max"] = rehearsal.dt;
    }
    j["cells_active"] = rehearsal.active;
    j["seconds"] = f.seconds;
    j["seconds_low"] = f.low;
    j["seconds_high"] = f.high;
    j["mlups"] = mlups;
    j["threads"] = rehearsal.threads;
    j["rehearsed_steps"] = rehearsal.steps;
    print(j.dump(2));
    return code;
  }
  print_assessment(c, assessment);
  if (mlups > 0.0)
    print("speed      " + four_digits(mlups) + " million fluid cells a second on " + std::to_string(rehearsal.threads) +
          " threads (air and walls, rehearsed now: " + std::to_string(rehearsal.steps) + " steps)");
  const bool early = rehearsal.ended && rehearsal.time < c.stop.time;
  if (early)
    print("end        when all has left: in the rehearsal after " + std::to_string(rehearsal.steps) + " steps, at " +
          as_time(rehearsal.time));
  print("time       about " + as_time(f.seconds) + (early ? " to that (" : " to stop.time (") + as_time(f.low) +
        " to " + as_time(f.high) + ")");
  return code;
}

}  // namespace

namespace commands {
Command estimate() {
  return {"estimate", "memory, steps and wall-clock on this machine", [](CLI::App& app) -> Action {
            auto a = std::make_shared<CaseArguments>();
            a->add_to(app);
            return [a] { return puffin::tools::estimate(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
