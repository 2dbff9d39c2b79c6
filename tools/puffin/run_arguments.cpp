// puffin run: its options. What they ask for is done in run.cpp.

#include <CLI/CLI.hpp>

#include "tools/puffin/arguments.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/run.hpp"

namespace puffin::tools {
namespace {

struct RunArguments {
  CaseArguments common;
  std::string until, walltime;
  RunOptions options;
};

int run(RunArguments a) {
  RunOptions& o = a.options;
  o.case_file = a.common.file;
  o.preset = a.common.preset;
  o.sets = a.common.overrides();
  o.json = a.common.json;
  if (!a.until.empty()) o.until = positive_quantity(a.until, cases::unit::time, "--until");
  if (!a.walltime.empty()) o.walltime = positive_quantity(a.walltime, cases::unit::time, "--walltime");
  set_up_log(o.quiet);
  return run_command(o);
}

}  // namespace

namespace commands {
Command run() {
  return {"run", "simulate a case", [](CLI::App& app) -> Action {
            auto a = std::make_shared<RunArguments>();
            a->common.add_to(app);
            app.add_option("--out", a->options.out, "folder of the results; runs/NAME/TIMESTAMP if not given")
                ->type_name("DIR");
            app.add_option("--threads", a->options.threads, "0: as the case says")->check(CLI::Range(0, 4096));
            app.add_option("--until", a->until, "stop at this simulated time, like 80ms")->type_name("TIME");
            app.add_flag("--resume", a->options.resume, "go on from the newest checkpoint in --out");
            app.add_option("--walltime", a->walltime, "stop cleanly (exit code 75) after this time")->type_name("TIME");
            app.add_option("--beds", a->options.beds,
                           "settled beds are kept here, and taken from here by runs with the same dose")
                ->type_name("DIR");
            app.add_flag("!--no-report", a->options.report, "no pictures and no report.html at the end");
            app.add_flag("--quiet", a->options.quiet, "no progress, warnings only");
            return [a] { return puffin::tools::run(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
