#include "tools/puffin/batch/jobs.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "cases/case_error.hpp"
#include "cases/choices.hpp"
#include "cases/micromodel_file.hpp"
#include "cases/toml_string.hpp"
#include "cases/units.hpp"
#include "cases/write_case.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/batch/explain.hpp"
#include "tools/puffin/together.hpp"

namespace puffin::tools {
namespace {

/// What must be equal for two cases to run as one: everything but the names and what is shared.
std::string without_shared(cases::Case c, const cases::Share& share) {
  c.name = "shared";
  c.reference.clear();
  c.provenance.clear();
  if (share.scalars) c.fines->scalars[0] = {};
  if (share.micromodels) c.fines->micromodels = "shared";
  c.fines->scalars[0].name = "shared";
  return cases::write_resolved(c);
}

/// Mass of the fines over that of carriers and fines.
double fines_of_dose(const cases::Case& c) {
  if (!c.carriers) return 0.0;
  const double ratio = c.carriers->fines_each * c.carriers->fine_mass_ratio;
  return ratio / (1.0 + ratio);
}

bool can_share(const cases::Case& c) {
  return c.fines && c.fines->scalars.size() == 1 && c.fines->boundaries.empty() && !c.fines->scalars[0].initial &&
         c.fines->scalars[0].wall == cases::ScalarWall::reflect;
}

/// Proportional to cells times steps: time/dx for the steps, dx^-3 for the cells of a device of some 3000 mm^3.
double cost_of(const cases::Case& c) {
  const double dx = c.numerics.dx ? *c.numerics.dx : std::cbrt(3e-6 / static_cast<double>(*c.numerics.cells));
  return c.stop.time / std::pow(dx * 1e3, 4);
}

struct Candidate {
  Job job;
  std::optional<cases::Case> described;
  std::string key;  // equal for cases that can share a run; empty: runs alone
};

/// Carriers are placed and sized, and turbulence of an inlet is made, with the seed; nothing else is.
bool seed_acts(const cases::Case& c) {
  return c.carriers || std::any_of(c.air.boundaries.begin(), c.air.boundaries.end(),
                                   [](const cases::Boundary& b) { return b.turbulence > 0.0; });
}

Candidate candidate(const cases::Study& study, std::size_t which, int replicate, std::string_view preset) {
  Candidate c;
  const cases::StudyCase& asked = study.cases[which];
  c.job.members = {{which, "", "", 0.0}};
  c.job.replicate = replicate;
  c.job.base = asked.base;
  try {
    c.described = cases::read_study_case(asked, replicate, preset);
    if (const auto& fines = c.described->fines; fines && !fines->micromodels.empty()) {
      cases::read_micromodels(fines->micromodels);  // its mistakes are this case's, whoever it shares a run with
      c.job.laws = cases::micromodels_with_tables(fines->micromodels);
    }
    c.job.sets = cases::overrides_of(asked, replicate);
    c.job.resolved = cases::write_resolved(*c.described);
    c.job.settles = study.share.start && !bed_key(*c.described).empty();
    c.job.seeded = seed_acts(*c.described);
    c.job.cost = cost_of(*c.described);
    c.job.members[0].fines_of_dose = fines_of_dose(*c.described);
    if ((study.share.scalars || study.share.micromodels) && can_share(*c.described))
      c.key = without_shared(*c.described, study.share);
  } catch (const std::exception& e) {
    c.job.problem = e.what();
  }
  return c;
}

std::string inline_scalar(const cases::Scalar& s, const std::string& name) {
  return "{ name = " + cases::toml_string(name) + ", diffusion = " + cases::shortest(s.diffusion) + ", scheme = \"" +
         std::string(cases::name_of(s.scheme)) + "\" }";
}

/// The cases with one key as one job. One whose fines are replayed takes from the run where airborne fines ended: from
/// the scalar of a case with the same diffusion and scheme, else from one whose name says whose micro-models it shows.
Job merged(const cases::Study& study, const std::vector<Candidate>& all, const std::vector<std::size_t>& group,
           std::string_view preset) {
  Job job = all[group.front()].job;
  job.members.clear();
  std::string list, name;
  for (const std::size_t n : group) {
    const Candidate& c = all[n];
    Member member = c.job.members[0];
    if (const std::string& set = c.described->fines->micromodels;
        set != all[group.front()].described->fines->micromodels)
      member.micromodels = set;
    job.members.push_back(member);
    name += (name.empty() ? "" : "+") + study.cases[member.which].name;
  }
  std::vector<std::pair<std::string, std::string>> carried;  // how, and the name of the scalar
  for (const bool replayed : {false, true})
    for (std::size_t k = 0; k < group.size(); ++k) {
      Member& member = job.members[k];
      if (member.micromodels.empty() == replayed) continue;
      const cases::Scalar& own = all[group[k]].described->fines->scalars[0];
      const std::string how = inline_scalar(own, "");
      const auto like = std::find_if(carried.begin(), carried.end(), [&](const auto& c) { return c.first == how; });
      member.scalar = study.cases[member.which].name;
      if (replayed && like != carried.end()) {
        member.scalar = like->second;
        continue;
      }
      if (replayed) member.scalar += "-with-micromodels-of-" + study.cases[job.members[0].which].name;
      carried.emplace_back(how, member.scalar);
      list += (list.empty() ? "" : ", ") + inline_scalar(own, member.scalar);
    }
  std::erase_if(job.sets, [](const cases::Override& o) { return o.key.starts_with("fines.scalar"); });
  job.sets.push_back({"fines.scalar", "[" + list + "]"});
  std::erase_if(job.sets, [](const cases::Override& o) { return o.key == "name"; });
  job.sets.push_back({"name", cases::toml_string(name)});
  const cases::Case c = cases::read_case(job.base, job.sets, preset);
  job.resolved = cases::write_resolved(c);
  constexpr std::size_t longest = 200;  // some systems take no more than 255
  job.id = "shared/" + output::folder_name(name).substr(0, longest);
  if (name.size() > longest) job.id += "-and-more-" + std::to_string(group.size());
  return job;
}

/// Gives jobs of one replicate that can feel the same flow its name, and makes them one-way.
void share_flows(const cases::Study& study, std::string_view preset, Jobs& plan) {
  std::map<std::string, std::vector<Job*>> groups;
  for (Job& job : plan.jobs) {
    if (!job.problem.empty()) continue;
    const std::string key = flow_key(cases::read_case(job.base, job.sets, preset));
    if (!key.empty()) groups[std::to_string(job.replicate) + "\n" + key].push_back(&job);
  }
  int number = 0;
  bool any = false;
  for (auto& [key, jobs] : groups) {
    if (jobs.size() < 2) continue;
    ++number;
    std::string names;
    for (Job* job : jobs) {
      job->flow = "flow-";
      job->flow += std::to_string(number);
      job->sets.push_back({"carriers.two_way", "false"});
      job->resolved = cases::write_resolved(cases::read_case(job->base, job->sets, preset));
      if (!names.empty()) names += ", ";
      names += listed(study, *job);
    }
    any = true;
    if (jobs.front()->replicate == 0)
      plan.sharings.push_back(
          {"one-way-flow", true, names + ": one flow, and carriers that do not act on it",
           "approximate: the carriers' reaction on the air is left out; its size is measured by the "
           "same study without this word (docs/studies.md)"});
  }
  if (!any)
    plan.sharings.push_back({"one-way-flow", false, "no two cases are equal in geometry, air and numerics", ""});
}

}  // namespace

bool is_named(const cases::Study& study, const Job& job, const std::string& pattern) {
  return pattern.empty() || std::any_of(job.members.begin(), job.members.end(), [&](const Member& m) {
           return fnmatch(pattern.c_str(), study.cases[m.which].name.c_str(), 0) == 0;
         });
}

namespace {

/// Names that differ in what no folder can bear would make two cases one.
void require_own_folders(const cases::Study& study, const std::vector<Job>& jobs) {
  std::map<std::string, std::string> owners;
  const auto take = [&](const std::string& place, const std::string& name) {
    const auto [at, fresh] = owners.emplace(place, name);
    if (!fresh)
      throw cases::CaseError({{study.file.string(), 0, 0, "",
                               "the cases '" + at->second + "' and '" + name + "' would share the folder " + place +
                                   "; rename one of them"}});
  };
  for (const Job& job : jobs) {
    take(job.id, listed(study, job));
    if (job.members.size() < 2) continue;
    for (const Member& m : job.members)  // their replays
      take(job.id + "/" + output::folder_name(study.cases[m.which].name), study.cases[m.which].name);
  }
}

}  // namespace

Jobs plan_jobs(const cases::Study& study, std::string_view preset) {
  Jobs plan;
  for (int replicate = 0; replicate < study.replicates; ++replicate) {
    std::vector<Candidate> all;
    for (std::size_t n = 0; n < study.cases.size(); ++n) all.push_back(candidate(study, n, replicate, preset));
    std::vector<char> taken(all.size(), 0);
    for (std::size_t n = 0; n < all.size(); ++n) {
      if (taken[n]) continue;
      std::vector<std::size_t> group{n};
      for (std::size_t m = n + 1; m < all.size() && !all[n].key.empty(); ++m)
        if (!taken[m] && all[m].key == all[n].key) group.push_back(m), taken[m] = 1;
      Job job = group.size() > 1 ? merged(study, all, group, preset) : all[n].job;
      if (job.id.empty()) job.id = output::folder_name(study.cases[n].name);
      job.id += "/seed-" + std::to_string(replicate + 1);
      plan.jobs.push_back(std::move(job));
    }
  }
  require_own_folders(study, plan.jobs);
  explain(study, plan.jobs, plan.sharings);
  warn_of_equal_replicates(study, plan);
  if (study.share.start) explain_beds(study, preset, plan);
  if (study.share.one_way_flow) share_flows(study, preset, plan);
  return plan;
}

}  // namespace puffin::tools
