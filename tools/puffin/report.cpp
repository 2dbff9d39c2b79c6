// puffin report

#include "tools/output/report.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "tools/output/output_folder.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

struct ReportOptions {
  std::filesystem::path run, out;
};

int report_command(const ReportOptions& options) {
  const std::filesystem::path out = options.out.empty() ? options.run / "report.html" : options.out;
  output::write_whole(out, output::make_report(options.run));
  print(out.string());
  return 0;
}

}  // namespace

namespace commands {
Command report() {
  return {"report", "one page about a run: pictures, curves, tables, assumptions", [](CLI::App& app) -> Action {
            auto options = std::make_shared<ReportOptions>();
            app.add_option("run", options->run, "the folder of a run that has ended")->required()->type_name("RUNDIR");
            app.add_option("--out", options->out, "the page; default RUNDIR/report.html")->type_name("FILE.html");
            return [options] { return report_command(*options); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
