// puffin estimate: memory, steps and wall-clock on this machine.

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tools/puffin/arguments.hpp"
#include "tools/puffin/assessment_text.hpp"
#include "tools/puffin/calibration.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/rehearsal.hpp"

namespace puffin::tools {
namespace {

int estimate(const CaseArguments& a) {
  const cases::Case c = a.read();
  cases::Assessment assessment = cases::assess(c, cases::load_surface(c));
  const double available = available_memory();
  if (assessment.memory > available)  // a lower bound: what building it would take at least
    throw ResourceError("the case needs about " + as_bytes(assessment.memory) + "; " + as_bytes(available) +
                        " are free: raise numerics.dx");
  const Rehearsal r = rehearse(c, 3.0);
  assessment.memory = r.memory;
  const double steps = assessment.lattice ? assessment.lattice->steps : 0.0;
  const RunTime time = run_time(c, steps, r);
  const double mlups =
      r.seconds_a_step > 0.0 ? 1e-6 * static_cast<double>(assessment.cells_fluid) / r.seconds_a_step : 0.0;
  if (a.json) {
    nlohmann::json j = assessment_json(c, assessment);
    j["seconds"] = time.expected;
    j["seconds_low"] = time.low;
    j["seconds_high"] = time.high;
    j["mlups"] = mlups;
    j["threads"] = r.threads;
    print(j.dump(2));
    return ok;
  }
  print_assessment(c, assessment);
  print("speed      " + four_digits(mlups) + " million cells a second on " + std::to_string(r.threads) +
        " threads (air with its walls, measured now)");
  print("time       about " + as_time(time.expected) + " (" + as_time(time.low) + " to " + as_time(time.high) + ")");
  return ok;
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
