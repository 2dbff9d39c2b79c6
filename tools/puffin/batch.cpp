// puffin batch: the runs of a study on this machine; goes on where an earlier batch was stopped or killed.

#include <CLI/CLI.hpp>

#include "cases/presets.hpp"
#include "cases/spelling.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/report.hpp"
#include "tools/output/study_results.hpp"
#include "tools/puffin/batch/study_run.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

/// A pattern that fits no case is most likely misspelt.
void require_a_name(const cases::Study& study, const Jobs& plan, const std::string& pattern) {
  for (const Job& job : plan.jobs)
    if (is_named(study, job, pattern)) return;
  std::vector<std::string> names;
  for (const cases::StudyCase& c : study.cases) names.push_back(c.name);
  throw UsageError("--only " + pattern + ": no case of the study has such a name; there are " + cases::join(names));
}

int batch(const BatchOptions& options) {
  set_up_log(options.quiet);
  const cases::Study study = cases::read_study(options.study);
  const Jobs plan = plan_jobs(study, options.preset);
  require_a_name(study, plan, options.only);
  if (!options.quiet)
    for (const Sharing& s : plan.sharings) log_info("share " + s.name + (s.done ? ": " : ", not done: ") + s.what);
  for (const std::string& text : plan.warnings) log_warning(text);
  Book book(options.out.empty() ? std::filesystem::path("studies") / output::folder_name(options.study.stem().string())
                                : options.out,
            study, plan);
  const int code = run_jobs(options, study, plan, book);
  const output::StudyResults results = output::read_study_results(book.folder());
  output::write_study_tables(results, book.folder());
  try {
    output::write_whole(book.folder() / "report.html", output::make_study_report(book.folder()));
    if (!options.json) print((book.folder() / "report.html").string());
  } catch (const std::exception& e) {  // a page that fails takes no results with it
    log_warning(std::string("no report: ") + e.what());
  }
  if (options.json) print(output::study_results_json(results, code));
  return code;
}

}  // namespace

namespace commands {
Command batch() {
  return {"batch", "run a study: many cases, replicates, sweeps; resumes what is unfinished",
          [](CLI::App& app) -> Action {
            auto o = std::make_shared<BatchOptions>();
            std::vector<std::string> names;
            for (const cases::Preset& p : cases::presets()) names.emplace_back(p.name);
            app.add_option("study", o->study, "the study file")->required()->type_name("STUDY.toml");
            app.add_option("--jobs", o->jobs, "runs at a time; 0: as many as cores")->check(CLI::Range(0, 4096));
            app.add_option("--threads", o->threads, "cores that the runs share; 0: all")->check(CLI::Range(0, 4096));
            app.add_option("--only", o->only, "cases whose name matches, like 'L-*'")->type_name("GLOB");
            app.add_option("--preset", o->preset, "for every run: quick, fast, default, accurate")
                ->check(CLI::IsMember(names))
                ->type_name("NAME");
            app.add_flag("--slurm", o->slurm,
                         "as a job array of Slurm; --threads: cores of each run, --jobs: runs at a time");
            app.add_flag("--retry-failed", o->retry_failed, "try failed runs again");
            app.add_option("--out", o->out, "folder of the study; studies/NAME if not given")->type_name("DIR");
            app.add_flag("--json", o->json, "one JSON object on stdout");
            app.add_flag("--quiet", o->quiet, "warnings only");
            return [o] { return puffin::tools::batch(*o); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
