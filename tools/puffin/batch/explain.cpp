#include "tools/puffin/batch/explain.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "cases/spelling.hpp"
#include "cases/write_case.hpp"

namespace puffin::tools {

std::string listed(const cases::Study& study, const Job& job) {
  std::string text;
  for (const Member& m : job.members) text += (text.empty() ? "" : ", ") + study.cases[m.which].name;
  return text;
}

std::string bed_key(cases::Case c) {
  if (!c.carriers || !c.carriers->fill || c.carriers->fill->shape != cases::FillShape::settled) return "";
  const cases::Carriers given = *c.carriers;
  cases::Case bed;
  bed.name = "bed";
  bed.geometry = c.geometry;
  bed.numerics.dx = 1.0;
  bed.numerics.seed = c.numerics.seed;
  cases::Carriers& k = bed.carriers.emplace();
  k.count = given.count, k.parcel = given.parcel, k.diameter = given.diameter, k.sizes = given.sizes;
  k.density = given.density, k.fines_each = given.fines_each, k.fine_mass_ratio = given.fine_mass_ratio;
  k.fill = given.fill, k.gravity = given.gravity, k.rotation = given.rotation;
  k.fill->bulk_density.reset();  // the bed is loosened after it has settled
  for (auto [to, from] : {std::pair(&k.contact, &given.contact), std::pair(&k.wall_contact, &given.wall_contact)}) {
    to->restitution = from->restitution;
    to->friction = from->friction;
    to->rolling_friction = from->rolling_friction;
  }
  return cases::write_resolved(bed);
}

void explain(const cases::Study& study, const std::vector<Job>& jobs, std::vector<Sharing>& sharings) {
  for (const Job& job : jobs) {
    if (job.members.size() < 2 || job.replicate != 0) continue;
    std::vector<std::string> scalars;
    for (const Member& m : job.members)
      if (std::find(scalars.begin(), scalars.end(), m.scalar) == scalars.end()) scalars.push_back(m.scalar);
    if (scalars.size() > 1)
      sharings.push_back(
          {"scalars", true, cases::join(scalars) + ": one run with a scalar each",
           "air, carriers and contacts are the same to the last bit; of the fines in the air, the number "
           "of transport steps is that of the most diffusive scalar"});
    for (const Member& m : job.members)
      if (!m.micromodels.empty())
        sharings.push_back(
            {"micromodels", true,
             study.cases[m.which].name + ": the contacts of " + study.cases[job.members[0].which].name +
                 " replayed with " + std::filesystem::path(m.micromodels).filename().string(),
             "FFCR, FFCE and the fines detached and attached are those of a run of its own to rounding; "
             "where airborne fines ended is taken from the run, mechanism by mechanism (a trace: all together)"});
  }
  for (const auto& [wanted, word, what] :
       {std::tuple(study.share.scalars, "scalars",
                   "no two cases differ in the diffusion or scheme of their scalar alone"),
        std::tuple(study.share.micromodels, "micromodels", "no two cases differ in their micro-models alone")})
    if (wanted &&
        std::none_of(sharings.begin(), sharings.end(), [name = word](const Sharing& s) { return s.name == name; }))
      sharings.push_back({word, false, what, ""});
  if (study.share.geometry)
    sharings.push_back(
        {"geometry", false, "finding the cells takes about a second of a run: not worth a shared file", ""});
}

void warn_of_equal_replicates(const cases::Study& study, Jobs& plan) {
  std::string names;
  for (const Job& job : plan.jobs)
    if (job.replicate == 0 && !job.seeded) names += (names.empty() ? "" : ", ") + listed(study, job);
  if (study.replicates < 2 || names.empty()) return;
  plan.warnings.push_back("replicates of " + names +
                          " will all be equal: without carriers and without turbulence at "
                          "an inlet the seed acts on nothing");
}

void explain_beds(const cases::Study& study, std::string_view preset, Jobs& plan) {
  std::map<std::string, std::pair<int, std::string>> beds;  // jobs, and the names of their cases
  for (const Job& job : plan.jobs) {
    if (job.replicate != 0 || !job.settles) continue;
    auto& [jobs, names] = beds[bed_key(cases::read_case(job.base, job.sets, preset))];
    ++jobs;
    names += (names.empty() ? "" : ", ") + listed(study, job);
  }
  bool any = false;
  for (const auto& [key, bed] : beds) {
    if (bed.first < 2) continue;
    any = true;
    plan.sharings.push_back({"start", true, bed.second + ": the dose settles once, in the first run that needs it",
                             "the carriers lie the same to the last bit"});
  }
  if (!any)
    plan.sharings.push_back({"start", false,
                             beds.empty() ? "no dose settles (carriers.fill.shape = \"settled\"), and a stack takes no "
                                            "time; the air of every run begins at rest"
                                          : "no two cases let the same dose settle",
                             ""});
}

}  // namespace puffin::tools
