// puffin estimate: memory, steps and wall-clock on this machine.

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tools/puffin/arguments.hpp"
#include "tools/puffin/assessment_text.hpp"
#include "tools/puffin/calibration.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

// Everything besides the bare lattice (links, exchange with the carriers, contacts, scalars, output) costs 50 % of it;
// the design holds it below that, and small devices and crowded pockets are dearer.
constexpr double besides = 1.5, besides_low = 1.1, besides_high = 3.0;

int estimate(const CaseArguments& a) {
  const cases::Case c = a.read();
  const cases::Assessment assessment = cases::assess(c, cases::load_surface(c));
  const Calibration speed = calibrate(c.numerics);
  const double updates =
      assessment.lattice ? assessment.lattice->steps * static_cast<double>(assessment.cells_fluid) : 0;
  const double bare = updates / speed.updates_per_second;
  const double available = available_memory();
  if (assessment.memory > available)
    throw ResourceError("the case needs about " + as_bytes(assessment.memory) + "; " + as_bytes(available) +
                        " are free: raise numerics.dx");
  if (a.json) {
    nlohmann::json j = assessment_json(c, assessment);
    j["seconds"] = besides * bare;
    j["seconds_low"] = besides_low * bare;
    j["seconds_high"] = besides_high * bare;
    j["mlups"] = speed.updates_per_second / 1e6;
    j["threads"] = speed.threads;
    print(j.dump(2));
    return ok;
  }
  print_assessment(c, assessment);
  print("speed      " + four_digits(speed.updates_per_second / 1e6) + " million cells a second on " +
        std::to_string(speed.threads) + " threads (bare lattice, measured now)");
  if (assessment.lattice)
    print("time       about " + as_time(besides * bare) + " (" + as_time(besides_low * bare) + " to " +
          as_time(besides_high * bare) + ")");
  else
    print("time       without a lattice there is no estimate");
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
