// puffin verify: runs the validation catalogue and compares with its references.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cases/search_path.hpp"
#include "cases/spelling.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/verify_report.hpp"
#include "tools/puffin/verify_run.hpp"

namespace puffin::tools {
namespace {

struct VerifyArguments {
  std::vector<std::string> suites, only, sets;
  std::filesystem::path catalogue, out;
  bool quick = false, resume = false, json = false;
};

/// A folder for the runs: the user's, kept; or a temporary one, removed at the end.
class Workplace {
 public:
  explicit Workplace(const std::filesystem::path& out) : kept_(!out.empty()) {
    path_ = kept_ ? out
                  : std::filesystem::temp_directory_path() /
                        ("puffin-verify-" + std::to_string(static_cast<long>(getpid())));
    std::filesystem::create_directories(path_);
  }
  ~Workplace() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove_all(path_, ignored);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  std::filesystem::path run(const std::string& id, const std::string& name) const { return path_ / "runs" / id / name; }
  /// The fields of a run are large and are not needed once the case is judged.
  void forget(const std::string& id) const {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove_all(path_ / "runs" / id, ignored);
  }

 private:
  std::filesystem::path path_;
  bool kept_;
};

bool matches(const std::string& id, const std::vector<std::string>& wanted) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), id) != wanted.end();
}

/// The checks of a case whose runs are all quick, or all.
std::vector<cases::Check> checks_of(const cases::Verification& v, bool quick) {
  std::vector<cases::Check> list;
  for (const cases::Check& check : v.checks) {
    const std::vector<std::string> needed = cases::runs_of(v, check);
    const bool fast = std::all_of(v.runs.begin(), v.runs.end(), [&](const cases::VerificationRun& run) {
      return run.quick || std::find(needed.begin(), needed.end(), run.name) == needed.end();
    });
    if (fast || !quick) list.push_back(check);
  }
  return list;
}

/// A signal ended a run: the rest is not made.
struct Stopped {
  int code;
};

/// Makes a run; an exception or an exit code other than 0 leaves it without output, and is told. With `resume`, a
/// finished run in the folder is read as it is and an unfinished one goes on.
std::optional<cases::RunOutput> make_run(const cases::VerificationRun& run, const std::vector<cases::Override>& sets,
                                         const std::filesystem::path& folder, const std::string& label, bool resume) {
  RunOptions options;
  options.case_file = run.case_file;
  options.sets = run.sets;
  options.sets.insert(options.sets.end(), sets.begin(), sets.end());
  options.out = folder;
  options.quiet = true;
  options.report = false;
  options.resume = resume && std::filesystem::exists(folder / "status.json");
  try {
    const auto summary = folder / "summary.json";
    if (options.resume && std::filesystem::exists(summary) && output::read_summary(summary).state == "finished")
      return read_run(folder);
    const int code = run_command(options);
    if (code == interrupted || code == stopped) throw Stopped{code};
    if (code == ok) return read_run(folder);
    log_error(label + ": the run ended with exit code " + std::to_string(code));
  } catch (const std::exception& e) {
    log_error(label + ": " + e.what());
  }
  return std::nullopt;
}

std::vector<VerifyRow> verify_case(const cases::Verification& v, const VerifyArguments& a,
                                   const std::vector<cases::Override>& sets, const Workplace& place) {
  const std::vector<cases::Check> checks = checks_of(v, a.quick);
  std::map<std::string, cases::RunOutput> outputs;
  for (const cases::VerificationRun& run : v.runs) {
    const bool needed = std::any_of(checks.begin(), checks.end(), [&](const cases::Check& check) {
      const auto names = cases::runs_of(v, check);
      return std::find(names.begin(), names.end(), run.name) != names.end();
    });
    if (!needed) continue;
    if (auto output = make_run(run, sets, place.run(v.id, run.name), v.id + ", run " + run.name, a.resume))
      outputs[run.name] = *std::move(output);
  }
  set_up_log(false);  // the runs are quiet
  std::vector<VerifyRow> rows;
  for (const cases::Check& check : checks) {
    VerifyRow row{v.id, v.suite, check.quantity, check.source, cases::evaluate(v, check, outputs), check.tolerance,
                  0.0,  0.0};
    for (const std::string& name : cases::runs_of(v, check))
      if (const auto found = outputs.find(name); found != outputs.end()) {
        row.cells = std::max(row.cells, found->second.numbers["cells_fluid"]);
        row.seconds += found->second.numbers["wall_clock"];
      }
    if (!row.outcome.problem.empty()) log_error(v.id + ", " + check.quantity + ": " + row.outcome.problem);
    rows.push_back(row);
  }
  place.forget(v.id);
  return rows;
}

void check_names(const std::vector<cases::Verification>& catalogue, const VerifyArguments& a) {
  std::vector<std::string> ids, suites;
  for (const cases::Verification& v : catalogue) {
    ids.push_back(v.id);
    if (std::find(suites.begin(), suites.end(), v.suite) == suites.end()) suites.push_back(v.suite);
  }
  for (const std::string& suite : a.suites)
    if (!matches(suite, suites))
      throw UsageError("there is no suite '" + suite + "'; the suites are " + cases::join(suites));
  for (const std::string& id : a.only)
    if (!matches(id, ids)) throw UsageError("there is no case '" + id + "'; the cases are " + cases::join(ids));
}

/// What --suite, --only and --quick choose. Throws UsageError if that leaves nothing of a case that was asked for by
/// its name, or nothing at all: a catalogue that nobody ran has not passed.
std::vector<const cases::Verification*> chosen(const std::vector<cases::Verification>& catalogue,
                                               const VerifyArguments& a) {
  std::vector<std::string> of_suites, ids;
  std::vector<const cases::Verification*> list;
  for (const cases::Verification& v : catalogue) {
    if (!matches(v.suite, a.suites)) continue;
    of_suites.push_back(v.id);
    if (checks_of(v, a.quick).empty()) continue;
    ids.push_back(v.id);
    if (matches(v.id, a.only)) list.push_back(&v);
  }
  for (const std::string& id : a.only) {
    if (!matches(id, of_suites))
      throw UsageError("--only " + id + ": --suite leaves it out; its cases are " + cases::join(of_suites));
    if (std::find(ids.begin(), ids.end(), id) == ids.end())
      throw UsageError("--only " + id + ": --quick leaves it out" +
                       (ids.empty() ? std::string() : "; the quick cases are " + cases::join(ids)));
  }
  if (list.empty()) throw UsageError("--suite and --quick leave no case");
  return list;
}

void write_tables(const std::filesystem::path& out, const std::vector<VerifyRow>& rows) {
  write_csv(out / "verify.csv", rows);
  output::write_whole(out / "verify.md", to_markdown(rows));
  output::write_whole(out / "verify.json", to_json(rows) + "\n");
}

int verify(const VerifyArguments& a) try {
  if (a.resume && a.out.empty()) throw UsageError("--resume goes on in the folder of --out, which is not given");
  std::vector<cases::Override> sets;
  for (const std::string& text : a.sets) try {
      sets.push_back(cases::parse_override(text));
    } catch (const std::invalid_argument& e) {
      throw UsageError(e.what());
    }
  const auto catalogue = cases::read_catalogue(a.catalogue.empty() ? cases::verification_directory() : a.catalogue);
  if (catalogue.empty())
    throw UsageError("--catalogue " + a.catalogue.string() + ": no folder in it has a verify.toml");
  check_names(catalogue, a);
  const auto wanted = chosen(catalogue, a);
  const Workplace place(a.out);
  std::vector<VerifyRow> rows;
  if (!a.json) print(heading());
  for (const cases::Verification* v : wanted) {
    for (const VerifyRow& row : verify_case(*v, a, sets, place)) {
      rows.push_back(row);
      if (!a.json) print(to_text(row));
    }
    if (!a.out.empty()) write_tables(a.out, rows);  // after each case: a suite that is stopped keeps what it found
  }
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const VerifyRow& r) { return !r.outcome.pass; });
  if (a.json)
    print(to_json(rows));
  else
    print(std::to_string(rows.size()) + " checks, " + std::to_string(failed) + " out of tolerance");
  return failed == 0 ? ok : out_of_tolerance;
} catch (const Stopped& s) {
  return s.code;
}

}  // namespace

namespace commands {
Command verify() {
  return {"verify", "run the validation catalogue", [](CLI::App& app) -> Action {
            auto a = std::make_shared<VerifyArguments>();
            app.add_option("--suite", a->suites, "flow, scalar, dem, coupling; may be repeated")->type_name("NAME");
            app.add_option("--only", a->only, "one case, like V01; may be repeated")->type_name("ID");
            app.add_flag("--quick", a->quick, "what ends within a minute in all");
            app.add_option("--set", a->sets, "over every case: to see the suite fail")->type_name("KEY=VALUE");
            app.add_option("--catalogue", a->catalogue, "a folder of cases with verify.toml, instead of Puffin's own")
                ->type_name("DIR");
            app.add_option("--out", a->out, "keep the runs here, with verify.csv, verify.json and the table verify.md")
                ->type_name("DIR");
            app.add_flag("--resume", a->resume,
                         "go on in the folder of --out: finished runs there are judged as they are");
            app.add_flag("--json", a->json, "one JSON object on stdout");
            return [a] { return puffin::tools::verify(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
