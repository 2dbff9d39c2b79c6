// What the runs of a study say of themselves: warnings and assumptions, each text once, with the cases it is of.

#include <algorithm>
#include <limits>

#include "tools/output/report/html.hpp"
#include "tools/output/report/study_sections.hpp"

namespace puffin::output {
namespace {

constexpr std::ptrdiff_t most_names = std::numeric_limits<std::ptrdiff_t>::max();  // every case is named

struct Remark {
  std::string text;
  std::vector<std::string> who;
};

void remark(std::vector<Remark>& all, const std::string& text, const std::string& who) {
  auto found = std::find_if(all.begin(), all.end(), [&](const Remark& one) { return one.text == text; });
  if (found == all.end()) all.push_back({text, {}}), found = all.end() - 1;
  if (std::find(found->who.begin(), found->who.end(), who) == found->who.end()) found->who.push_back(who);
}

/// `everybody`: so many names that they need not be told.
std::string list_of(const std::vector<Remark>& all, std::ptrdiff_t everybody) {
  std::string out = "<ul>\n";
  for (const Remark& one : all) {
    std::string names;
    for (const std::string& name : one.who) names += (names.empty() ? "" : ", ") + name;
    const bool told = static_cast<std::ptrdiff_t>(one.who.size()) < everybody;
    out += "<li>" + escaped(one.text) + (told ? " <span class=soft>(" + escaped(names) + ")</span>" : "") + "</li>\n";
  }
  return out + "</ul>\n";
}

bool warns(const StudyRun& run, const std::string& text) {
  const std::vector<std::string>& told = run.summary->warnings;
  return std::find(told.begin(), told.end(), text) != told.end();
}

/// The case's name for what all its finished runs warn of, else the folders of those that do.
void add_warnings(const StudyCaseResult& c, std::vector<Remark>& all) {
  const auto silent = [](const std::string& text) {
    return [&text](const StudyRun& run) { return run.summary && !warns(run, text); };
  };
  for (const StudyRun& run : c.runs) {
    if (!run.summary) continue;
    for (const std::string& text : run.summary->warnings)
      remark(all, text, std::none_of(c.runs.begin(), c.runs.end(), silent(text)) ? c.name : run.folder);
  }
}

}  // namespace

std::string trial_section(const StudyResults& results) {
  std::vector<Remark> all;
  bool cut = false;
  for (const StudyCaseResult& c : results.cases)
    if (const StudyRun* run = first_done(c)) {
      if (const std::string what = trial(*run->summary); !what.empty()) remark(all, what, c.name);
      cut = cut || cut_short(*run->summary);
    }
  if (all.empty()) return "";
  return "<div class=alarm><b>Trials:</b> these are not the cases as they stand." + list_of(all, most_names) +
         (cut ? "What leaves the device, what it retains and the last emission are those until the end of the run."
              : "") +
         "</div>\n";
}

std::string warning_section(const StudyResults& results) {
  std::vector<Remark> all;
  for (const StudyCaseResult& c : results.cases) add_warnings(c, all);
  if (all.empty()) return "";
  return "<h2>Warnings</h2>\n<div class=alarm>" + list_of(all, most_names) + "</div>\n";
}

std::string assumption_section(const StudyResults& results) {
  std::vector<Remark> all;
  for (const StudyCaseResult& c : results.cases)
    if (const StudyRun* run = first_done(c))
      for (const std::string& text : run->summary->assumptions) remark(all, text, c.name);
  std::string out = "<h2>Assumptions</h2>\n";
  if (all.empty()) return out + "<p>No finished case marks any.</p>\n";
  const auto cases = std::count_if(results.cases.begin(), results.cases.end(),
                                   [](const StudyCaseResult& c) { return first_done(c) != nullptr; });
  return out + list_of(all, cases);
}

}  // namespace puffin::output
