// puffin report

#include "tools/output/report.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "tools/output/output_folder.hpp"
#include "tools/output/study_results.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

struct ReportOptions {
  std::filesystem::path run, out;
};

int report_command(const ReportOptions& options) {
  const std::filesystem::path out = options.out.empty() ? options.run / "report.html" : options.out;
  const bool study = std::filesystem::exists(options.run / "study.json");
  if (study) output::write_study_tables(output::read_study_results(options.run), options.run);
  output::write_whole(out, study ? output::make_study_report(options.run) : output::make_report(options.run));
  print(out.string());
  return 0;
}

}  // namespace

namespace commands {
Command report() {
  return {
      "report", "one page about a run or a study: pictures, curves, tables", [](CLI::App& app) -> Action {
        auto options = std::make_shared<ReportOptions>();
        app.add_option("run", options->run, "the folder of a run that has ended, or of a study")
            ->required()
            ->type_name("RUNDIR|STUDYDIR");
        app.add_option("--out", options->out, "the page; default report.html in that folder")->type_name("FILE.html");
        return [options] { return report_command(*options); };
      }};
}
}  // namespace commands

}  // namespace puffin::tools
