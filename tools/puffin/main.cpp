// puffin: the command line. Options of a command are in its own file; here: help, errors, exit codes.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "cases/case_error.hpp"
#include "cases/spelling.hpp"
#include "lbm/isa.hpp"
#include "tools/output/output_error.hpp"
#include "tools/puffin/build_info.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

constexpr const char* exit_code_help =
    "Exit codes: 0 ok; 1 internal error; 2 usage; 3 case file invalid; 4 geometry invalid; 5 diverged; 6 resources;\n"
    "7 input or output; 8 batch ended with failed cases; 9 out of tolerance; 75 stopped, can be resumed; 130 Ctrl-C.\n"
    "stdout holds results, stderr log and progress. NO_COLOR is respected.";

/// On stderr for people; with --json also as the one object on stdout.
int report(const std::exception& error, bool json) {
  const ExitCode code = exit_code(error);
  nlohmann::json problems = nlohmann::json::array();
  if (const auto* case_error = dynamic_cast<const cases::CaseError*>(&error)) {
    for (const cases::Problem& p : case_error->problems) {
      problems.push_back(
          {{"file", p.file}, {"line", p.line}, {"column", p.column}, {"key", p.key}, {"message", p.text}});
      if (!json) std::fprintf(stderr, "%s\n", p.to_string().c_str());
    }
  } else {
    std::string text = dynamic_cast<const std::bad_alloc*>(&error) ? "there is not enough memory" : error.what();
    std::replace_if(  // a hostile name shall not write on the terminal
        text.begin(), text.end(), [](unsigned char c) { return (c < 32 && c != '\n') || c == 127; }, '?');
    problems.push_back({{"message", text}});
    const bool complete = text.starts_with("error: ") || text.find(": error: ") != std::string::npos;
    if (!json && complete) std::fprintf(stderr, "%s\n", text.c_str());
    if (!json && !complete) log_error(text);
  }
  const nlohmann::json object{{"ok", false}, {"exit_code", static_cast<int>(code)}, {"problems", problems}};
  if (json) try {
      print(object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } catch (const output::OutputError& unwritten) {
      log_error(std::string(error.what()) == unwritten.what() ? error.what()
                                                              : error.what() + std::string("; ") + unwritten.what());
    }
  return code;
}

/// Whether the words ask for JSON; known before parsing, so that a usage error can be JSON too.
bool wants_json(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (std::string_view(argv[i]) == "--json") return true;
  return false;
}

/// What is wrong with the words before the options, and what may be meant; "" if all are known. Of "puffin geometry
/// dukt" the parser alone would only say that it misses a subcommand.
std::string unknown_word(const CLI::App& app, const std::vector<std::string>& names, int argc, char** argv) {
  const auto unknown = [](const std::string& word, const std::vector<std::string>& known) {
    return !word.starts_with('-') && std::find(known.begin(), known.end(), word) == known.end();
  };
  if (argc < 2 || argv[1][0] == '-') return "";
  const std::string first = argv[1], second = argc > 2 ? argv[2] : "-";
  if (unknown(first, names)) {
    const std::string near = cases::nearest(first, names);
    return "unknown command '" + first + "'; " +
           (near.empty() ? "the commands are " + cases::join(names) : "did you mean '" + near + "'?");
  }
  std::vector<std::string> known;
  for (const CLI::App* sub : app.get_subcommand(first)->get_subcommands({})) known.push_back(sub->get_name());
  if (!known.empty() && argc == 2) return "'puffin " + first + "' needs one of " + cases::join(known);
  if (known.empty() || !unknown(second, known)) return "";
  return "unknown word '" + second + "' after 'puffin " + first + "'" + cases::did_you_mean_or_known(second, known);
}

int run(int argc, char** argv) {
  const bool json = wants_json(argc, argv);
  set_up_log(false);
  CLI::App app{"Predicts how a dry powder inhaler releases its drug: air, carriers and fines.", "puffin"};
  app.footer(exit_code_help);
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", build_info().version);
  std::map<const CLI::App*, Action> actions;
  std::vector<std::string> names;
  for (const Command& command : all_commands()) {
    names.push_back(command.name);
    CLI::App* sub = app.add_subcommand(command.name, command.summary);
    actions[sub] = command.add(*sub);
  }
  const char* isa = std::getenv("PUFFIN_ISA");
  if (const std::string_view problem = lbm::isa_problem(isa); !problem.empty())
    return report(UsageError("PUFFIN_ISA=" + std::string(isa) + " " + std::string(problem)), json);
  if (const std::string text = unknown_word(app, names, argc, argv); !text.empty())
    return report(UsageError(text), json);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    return report(UsageError(e.what() + std::string("; see puffin --help")), json);
  }
  try {
    if (app.get_subcommands().empty()) throw UsageError("which command? see puffin --help");
    return actions.at(app.get_subcommands().front())();
  } catch (const std::exception& e) {
    return report(e, json);
  }
}

}  // namespace
}  // namespace puffin::tools

int main(int argc, char** argv) { return puffin::tools::run(argc, argv); }
