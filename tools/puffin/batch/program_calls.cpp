#include "tools/puffin/batch/program_calls.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/output/output_folder.hpp"
#include "tools/puffin/batch/pool.hpp"
#include "tools/puffin/batch/slurm.hpp"
#include "tools/puffin/console.hpp"

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

}  // namespace

std::vector<std::string> run_arguments(const std::vector<std::size_t>& group, int threads, const std::string& preset,
                                       const Jobs& plan, const Book& book) {
  const std::size_t first = group.front();
  const Job& job = plan.jobs[first];
  const bool together = group.size() > 1;
  std::vector<std::string> arguments;
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

void replay_members(std::size_t job, const cases::Study& study, const Jobs& plan, const Book& book) {
  const std::filesystem::path log = book.log_file(job);
  for (const Member& m : plan.jobs[job].members) {
    const std::filesystem::path file = book.replay_file(job, m), part = file.string() + ".part";
    if (m.micromodels.empty() || std::filesystem::exists(file)) continue;
    std::filesystem::remove(part);  // a link would be written through
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const int code = std::system((shell_quoted(program) + " replay " + shell_quoted(book.run_folder(job).string()) +
                                  " --micromodels " + shell_quoted(m.micromodels) + " --json > " +
                                  shell_quoted(part.string()) + " 2>> " + shell_quoted(log.string()))
                                     .c_str());
    if (code == 0)
      output::finish_file(part, file);
    else
      log_warning(study.cases[m.which].name + ": no replay of " + plan.jobs[job].id + ": " + last_line(log));
  }
}

}  // namespace puffin::tools
