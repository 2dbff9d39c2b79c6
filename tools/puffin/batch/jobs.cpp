#include "tools/puffin/batch/jobs.hpp"

#include <cmath>
#include <optional>

#include "cases/case_error.hpp"
#include "cases/choices.hpp"
#include "cases/units.hpp"
#include "cases/write_case.hpp"
#include "tools/output/output_folder.hpp"

namespace puffin::tools {
namespace {

/// What must be equal for two cases to run as one: everything but the names and how their scalar spreads.
std::string without_scalar(cases::Case c) {
  c.name = "shared";
  c.reference.clear();
  c.provenance.clear();
  c.fines->scalars[0] = {};
  c.fines->scalars[0].name = "shared";
  return cases::write_resolved(c);
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

Candidate candidate(const cases::Study& study, std::size_t which, int replicate, std::string_view preset) {
  Candidate c;
  const cases::StudyCase& asked = study.cases[which];
  c.job.members = {{which, ""}};
  c.job.replicate = replicate;
  c.job.base = asked.base;
  try {
    c.described = cases::read_study_case(asked, replicate, preset);
    c.job.sets = cases::overrides_of(asked, replicate);
    c.job.resolved = cases::write_resolved(*c.described);
    c.job.cost = cost_of(*c.described);
    if (study.share.scalars && can_share(*c.described)) c.key = without_scalar(*c.described);
  } catch (const std::exception& e) {
    c.job.problem = e.what();
  }
  return c;
}

std::string inline_scalar(const cases::Scalar& s, const std::string& name) {
  return "{ name = \"" + name + "\", diffusion = " + cases::shortest(s.diffusion) + ", scheme = \"" +
         std::string(cases::name_of(s.scheme)) + "\" }";
}

/// The cases with one key as one job.
Job merged(const cases::Study& study, const std::vector<Candidate>& all, const std::vector<std::size_t>& group,
           std::string_view preset) {
  Job job = all[group.front()].job;
  job.members.clear();
  std::string list, name;
  for (const std::size_t n : group) {
    const Candidate& c = all[n];
    const std::string& own = study.cases[c.job.members[0].which].name;
    job.members.push_back({c.job.members[0].which, own});
    list += (list.empty() ? "" : ", ") + inline_scalar(c.described->fines->scalars[0], own);
    name += (name.empty() ? "" : "+") + own;
  }
  std::erase_if(job.sets, [](const cases::Override& o) { return o.key.starts_with("fines.scalar"); });
  job.sets.push_back({"fines.scalar", "[" + list + "]"});
  job.sets.push_back({"name", "\"" + name + "\""});
  const cases::Case c = cases::read_case(job.base, job.sets, preset);
  job.resolved = cases::write_resolved(c);
  job.id = "shared/" + output::folder_name(name);
  return job;
}

std::string listed(const cases::Study& study, const Job& job) {
  std::string text;
  for (const Member& m : job.members) text += (text.empty() ? "" : ", ") + study.cases[m.which].name;
  return text;
}

void explain(const cases::Study& study, const std::vector<Job>& jobs, std::vector<Sharing>& sharings) {
  if (study.share.scalars) {
    bool any = false;
    for (const Job& job : jobs) {
      if (job.members.size() < 2 || job.replicate != 0) continue;
      any = true;
      sharings.push_back(
          {"scalars", true, listed(study, job) + ": one run with a scalar each",
           "air, carriers and contacts are the same to the last bit; of the fines in the air, the number "
           "of transport steps is that of the most diffusive scalar"});
    }
    if (!any)
      sharings.push_back(
          {"scalars", false, "no two cases differ in the diffusion or scheme of their scalar alone", ""});
  }
  if (study.share.geometry)
    sharings.push_back(
        {"geometry", false, "finding the cells takes about a second of a run: not worth a shared file", ""});
  if (study.share.start) sharings.push_back({"start", false, "this version starts every run from air at rest", ""});
  if (study.share.one_way_flow)
    sharings.push_back({"one-way-flow", false, "this version computes the flow of every run", ""});
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
  explain(study, plan.jobs, plan.sharings);
  return plan;
}

}  // namespace puffin::tools
