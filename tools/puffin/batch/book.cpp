#include "tools/puffin/batch/book.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tools/output/experiments.hpp"
#include "tools/output/format_version.hpp"
#include "tools/output/link_out.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/report/html.hpp"
#include "tools/output/summary.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* state_names[] = {"waiting", "running", "done", "failed", "stopped"};

JobState state_of(const std::string& name) {
  for (int n = 0; n < 5; ++n)
    if (name == state_names[n]) return static_cast<JobState>(n);
  return JobState::waiting;
}

std::string dumped(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// How far a run is, from the status that it writes itself.
Json progress_of(const fs::path& run) {
  Json j = Json::object();
  try {
    const output::Status s = output::read_status(run / "status.json");
    j["phase"] = s.phase;
    j["simulated_time"] = s.simulated_time;
    j["end_time"] = s.end_time;
    j["mlups"] = s.mlups;
    j["eta"] = s.eta ? Json(*s.eta) : Json(nullptr);
  } catch (const output::OutputError&) {  // it has not written one yet
  }
  return j;
}

/// A run's name, leading to its page; to its log where it failed before it had one.
std::string link_to(const std::string& id, const fs::path& study) {
  for (const char* file : {"index.html", "run.log"})
    if (fs::exists(study / id / file))
      return "<a href=\"" + output::escaped(id + "/" + file) + "\">" + output::escaped(id) + "</a>";
  return output::escaped(id);
}

std::string page_of(const Json& status, const fs::path& study) {
  std::string body = "<h1>" + output::escaped(status["study"].get<std::string>()) + "</h1><p>" +
                     output::escaped(status["state"].get<std::string>()) + ": " + status["done"].dump() + " of " +
                     status["jobs"].dump() + " runs done, " + status["failed"].dump() + " failed</p>\n";
  std::vector<std::vector<std::string>> rows;
  for (const Json& job : status["runs"]) {
    const double end = job.value("end_time", 0.0), now = job.value("simulated_time", 0.0);
    const bool known = end > 0.0 && job["state"] == "running";
    rows.push_back({link_to(job["id"].get<std::string>(), study), job["state"].get<std::string>(),
                    known ? output::progress_bar(now / end) + " " + output::significant(1e3 * now) + " of " +
                                output::significant(1e3 * end) + " ms"
                          : output::escaped(job.value("message", "")),
                    job.contains("eta") && job["eta"].is_number() && known
                        ? output::significant(job["eta"].get<double>()) + " s to go"
                        : ""});
  }
  std::string html =
      output::page(status["study"].get<std::string>(), body + output::table({"run", "state", "", ""}, rows));
  const bool live = status["state"] == "running";
  if (const auto at = html.find("<head>"); live && at != std::string::npos)
    html.insert(at + 6, "\n<meta http-equiv=\"refresh\" content=\"3\">");
  return html;
}

/// The base's given values stand for a case that is the same device with the same drug: another grid, output or
/// set of micro-models leaves them, any other change keeps only what it gives itself.
Json reference_of(const cases::StudyCase& c) {
  const bool same = std::all_of(c.sets.begin(), c.sets.end(), [](const cases::Override& o) {
    return o.key.starts_with("numerics.") || o.key.starts_with("output.") || o.key.starts_with("reference.") ||
           o.key == "fines.micromodels";  // other laws of the same drug
  });
  Json reference = Json::object();
  const auto given_here = [&](const std::string& name) {
    return std::any_of(c.sets.begin(), c.sets.end(),
                       [&](const cases::Override& o) { return ("reference." + name).starts_with(o.key); });
  };
  try {
    for (const auto& [name, value] : cases::read_case(c.base, c.sets).reference) {
      if (!same && !given_here(name)) continue;
      if (const auto* number = std::get_if<double>(&value)) reference[name] = *number;
      if (const auto* list = std::get_if<std::vector<double>>(&value)) reference[name] = *list;
    }
  } catch (const std::exception&) {  // an invalid case has no reference; its job says why
  }
  return reference;
}

/// The device by the generator's name, or that of the STL file; the same name as in a table of experiments.
std::string device_of(const cases::StudyCase& c) {
  try {
    const cases::Geometry geometry = cases::read_case(c.base, c.sets).geometry;
    if (const auto* made = std::get_if<cases::Generated>(&geometry.source)) return made->kind;
    return fs::path(std::get<cases::StlFile>(geometry.source).file).stem().string();
  } catch (const std::exception&) {  // an invalid case; its job says why
    return "";
  }
}

/// A resolved case but for its name: runs of a study once bore that of their base.
std::string without_name(const std::string& resolved) {
  const std::size_t begin = resolved.find("\nname = ");
  if (begin == std::string::npos) return resolved;
  return resolved.substr(0, begin) + resolved.substr(std::min(resolved.find('\n', begin + 1), resolved.size()));
}

}  // namespace

const char* name_of(JobState state) { return state_names[static_cast<int>(state)]; }

Book::Book(fs::path folder, const cases::Study& study, const Jobs& plan)
    : folder_(std::move(folder)), study_(study), plan_(plan), records_(plan.jobs.size()) {
  std::error_code error;
  fs::create_directories(folder_, error);
  folder_ = fs::absolute(folder_);
  if (!fs::exists(folder_ / "study.json") && fs::exists(folder_ / "status.json"))
    throw output::OutputError(folder_.string() + " holds a run; choose another folder for the study with --out");
  // Got from elsewhere, the folder may hold links; what is written whole replaces them, but these are written through.
  for (const char* name : {".lock", "shared/any", "shared/beds/any", "slurm/any", "slurm/errors.txt"})
    output::refuse_link_out(folder_, folder_ / name);
  for (std::size_t n = 0; n < plan.jobs.size(); ++n) output::refuse_link_out(folder_, log_file(n));
  lock_ = open((folder_ / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0)
    throw output::OutputError("cannot write into " + folder_.string() + "; choose another folder with --out");
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    close(lock_);
    throw output::OutputError("another batch is at work in " + folder_.string() + "; wait for it, or give --out");
  }
  if (!study.experiments.empty()) {
    output::read_experiments(study.experiments);  // its mistakes are told now, not after the runs
    output::write_whole(folder_ / "experiments.csv", output::read_whole(study.experiments));
  }
  const Json before = Json::parse(output::read_whole(folder_ / "study.json"), nullptr, false);
  if (!before.is_object() || !before.contains("jobs")) return;
  for (const Json& j : before["jobs"]) try {
      for (std::size_t n = 0; n < records_.size(); ++n)
        if (plan.jobs[n].id == j.value("id", "")) {
          records_[n] = {state_of(j.value("state", "")), j.value("exit_code", 0), j.value("message", ""),
                         j.value("seconds", 0.0),        j.value("attempts", 0),  j.value("threads", 0)};
          if (records_[n].state == JobState::running) records_[n].state = JobState::stopped;  // that batch was killed
        }
    } catch (const nlohmann::json::exception& e) {
      throw output::OutputError((folder_ / "study.json").string() + " is damaged: " + e.what() +
                                "; remove it, and what is finished is found by its folder");
    }
}

Book::~Book() {
  if (lock_ >= 0) close(lock_);
}

bool Book::finished(std::size_t job) const {
  const fs::path run = run_folder(job);
  if (!fs::exists(run / "summary.json") || output::read_summary(run / "summary.json").state != "finished") return false;
  if (without_name(output::read_whole(run / "case.toml")) == without_name(plan_.jobs[job].resolved)) {
    if (!fs::exists(run / "micromodels.toml") || output::read_whole(run / "micromodels.toml") == plan_.jobs[job].laws)
      return true;
    throw output::OutputError(run.string() +
                              " holds a finished run with other laws than its micro-model file has now; "
                              "give the changed study another folder with --out");
  }
  throw output::OutputError(run.string() + " holds a finished run of another case than the study's " +
                            plan_.jobs[job].id + "; give the changed study another folder with --out");
}

fs::path Book::replay_file(std::size_t job, const Member& member) const {
  return run_folder(job) / ("replay-" + output::folder_name(study_.cases[member.which].name) + ".json");
}

bool Book::resumable(std::size_t job) const {
  const fs::path run = run_folder(job);
  return fs::exists(run / "checkpoints") && !output::list_checkpoints(run).empty();
}

void Book::wait_until_free(std::size_t job) const {
  const int folder = open(run_folder(job).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  for (int tries = 0; tries < 200 && flock(folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  close(folder);
}

void Book::move_aside(std::size_t job) const {
  const fs::path run = run_folder(job);
  if (!fs::exists(run)) return;
  for (int n = 1;; ++n) {
    const fs::path aside = run.string() + ".failed-" + std::to_string(n);
    if (fs::exists(aside)) continue;
    fs::rename(run, aside);
    return;
  }
}

bool Book::set_damaged_aside(std::size_t job) const {
  const fs::path file = run_folder(job) / "summary.json";
  if (!fs::exists(file) || Json::accept(output::read_whole(file))) return false;
  log_warning(plan_.jobs[job].id + ": " + file.string() +
              " is damaged; its folder is moved aside and the run done again");
  move_aside(job);
  return true;
}

void Book::write() const {
  Json cases = Json::array(), jobs = Json::array();
  for (std::size_t n = 0; n < study_.cases.size(); ++n) {
    const cases::StudyCase& c = study_.cases[n];
    Json sets = Json::object(), runs = Json::array();
    for (const cases::Override& o : c.sets) sets[o.key] = o.value;
    for (std::size_t k = 0; k < plan_.jobs.size(); ++k)
      for (const Member& m : plan_.jobs[k].members)
        if (m.which == n)
          runs.push_back({{"replicate", plan_.jobs[k].replicate},
                          {"job", plan_.jobs[k].id},
                          {"scalar", m.scalar},
                          {"replay", m.micromodels.empty() ? "" : replay_file(k, m).filename().string()},
                          {"fines_of_dose", m.fines_of_dose}});
    const Json reference = reference_of(c);
    cases.push_back({{"name", c.name},
                     {"base", c.base.string()},
                     {"device", device_of(c)},
                     {"set", sets},
                     {"swept", c.swept},
                     {"reference", reference},
                     {"runs", runs}});
  }
  for (std::size_t k = 0; k < plan_.jobs.size(); ++k) {
    const JobRecord& r = records_[k];
    jobs.push_back({{"id", plan_.jobs[k].id},
                    {"state", name_of(r.state)},
                    {"exit_code", r.exit_code},
                    {"message", r.message},
                    {"seconds", r.seconds},
                    {"attempts", r.attempts},
                    {"threads", r.threads}});
  }
  output::write_whole(folder_ / "study.json",
                      dumped({{"study", study_.file.string()}, {"cases", cases}, {"jobs", jobs}}));
}

void Book::write_live(const std::string& state, double wall_clock) const {
  Json runs = Json::array();
  int done = 0, failed = 0;
  double cost_done = 0.0, cost_all = 0.0;
  for (std::size_t k = 0; k < plan_.jobs.size(); ++k) {
    const JobRecord& r = records_[k];
    Json j{{"id", plan_.jobs[k].id}, {"state", name_of(r.state)}, {"threads", r.threads}};
    if (!r.message.empty()) j["message"] = r.message;
    if (r.state == JobState::running) j.update(progress_of(run_folder(k)));
    done += r.state == JobState::done;
    failed += r.state == JobState::failed;
    cost_all += plan_.jobs[k].cost;
    if (r.state == JobState::done) cost_done += plan_.jobs[k].cost;
    runs.push_back(j);
  }
  const Json status{{"format", output::format_version},
                    {"study", study_.file.stem().string()},
                    {"state", state},
                    {"jobs", plan_.jobs.size()},
                    {"done", done},
                    {"failed", failed},
                    {"work_done", cost_all > 0.0 ? cost_done / cost_all : 0.0},
                    {"wall_clock", wall_clock},
                    {"runs", runs}};
  output::write_whole(folder_ / "status.json", dumped(status));
  output::write_whole(folder_ / "index.html", page_of(status, folder_));
}

}  // namespace puffin::tools
