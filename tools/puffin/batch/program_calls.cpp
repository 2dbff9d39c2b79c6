#include "tools/puffin/batch/program_calls.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cases/micromodel_file.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/batch/pool.hpp"
#include "tools/puffin/batch/slurm.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/together.hpp"

namespace puffin::tools {
namespace {

/// The list for puffin together.
std::string list_of(const std::vector<std::size_t>& group, const Jobs& plan, const Book& book) {
  nlohmann::json list = nlohmann::json::array();
  for (const std::size_t m : group) {
    nlohmann::json sets = nlohmann::json::array();
    for (const cases::Override& o : plan.jobs[m].sets) sets.push_back(o.key + "=" + o.value);
    list.push_back({{"case", plan.jobs[m].base.string()}, {"out", book.run_folder(m).string()}, {"set", sets}});
  }
  return list.dump(1) + "\n";
}

/// The first problem that a command with --json has printed.
std::string told_in(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  const nlohmann::json::json_pointer first("/problems/0/message");
  return json.is_object() && json.contains(first) && json[first].is_string() ? json[first].get<std::string>()
                                                                             : "it said nothing";
}

}  // namespace

std::vector<std::string> run_arguments(const std::vector<std::size_t>& group, int threads, const std::string& preset,
                                       const Jobs& plan, const Book& book) {
  const std::size_t first = group.front();
  const Job& job = plan.jobs[first];
  const bool together = group.size() > 1;
  std::vector<std::string> arguments;
  if (!job.flow.empty()) std::filesystem::remove(ends_file(book.flow_file(first)));  // of an earlier attempt
  if (together) {
    output::write_whole(book.flow_file(first), list_of(group, plan, book));
    arguments = {"together", book.flow_file(first).string()};
  } else {
    arguments = {"run", job.base.string(), "--out", book.run_folder(first).string()};
  }
  arguments.insert(arguments.end(), {"--threads", std::to_string(threads)});
  if (!preset.empty()) arguments.insert(arguments.end(), {"--preset", preset});
  if (!together)
    for (const cases::Override& o : job.sets) arguments.insert(arguments.end(), {"--set", o.key + "=" + o.value});
  if (std::any_of(group.begin(), group.end(), [&](std::size_t m) { return plan.jobs[m].settles; }))
    arguments.insert(arguments.end(), {"--beds", (book.folder() / "shared" / "beds").string()});
  if (!together && book.resumable(first)) arguments.emplace_back("--resume");
  return arguments;
}

int own_code(std::size_t job, std::size_t starter, int code, const Jobs& plan, const Book& book) {
  if (plan.jobs[job].flow.empty()) return code;
  std::string message;
  const auto ends = read_ends(book.flow_file(job));
  const auto own =
      std::find_if(ends.begin(), ends.end(), [&](const TogetherEnd& end) { return end.out == book.run_folder(job); });
  if (own != ends.end()) {
    code = own->code;
    message = own->message;
  } else if (book.finished(job)) {
    code = ok;
  } else if (job != starter && code != stopped &&
             code != interrupted) {  // the process came to grief before it could tell
    message = last_line(book.log_file(starter));
  }
  if (code != ok && !message.empty()) std::ofstream(book.log_file(job), std::ios::app) << message << "\n";
  return code;
}

bool complete(std::size_t job, const cases::Study& study, const Jobs& plan, const Book& book) {
  const std::string log = book.log_file(job).string(), run = book.run_folder(job).string();
  const auto called = [&](const std::string& arguments, const std::string& out) {
    static const std::string program = shell_quoted(std::filesystem::read_symlink("/proc/self/exe").string());
    return std::system((program + " " + arguments + " > " + shell_quoted(out) + " 2>> " + shell_quoted(log)).c_str());
  };
  bool whole = true;
  for (const Member& m : plan.jobs[job].members) {
    const std::filesystem::path file = book.replay_file(job, m), part = file.string() + ".part";
    if (m.micromodels.empty()) continue;
    const std::filesystem::path kept = std::filesystem::path(file).replace_extension(".toml");
    const std::string laws = cases::micromodels_with_tables(m.micromodels);
    if (std::filesystem::exists(file) && output::read_whole(kept) == laws) continue;
    std::filesystem::remove(file);
    std::filesystem::remove(part);  // a link would be written through
    if (called("replay " + shell_quoted(run) + " --micromodels " + shell_quoted(m.micromodels) + " --json", part) ==
        0) {
      output::finish_file(part, file);
      output::write_whole(kept, laws);
      continue;
    }
    whole = false;
    log_error(study.cases[m.which].name + ": no replay of " + plan.jobs[job].id + ": " + told_in(part));
    std::filesystem::remove(part);
  }
  if (!std::filesystem::exists(run + "/report.html")) called("report " + shell_quoted(run), "/dev/null");
  return whole;
}

}  // namespace puffin::tools
