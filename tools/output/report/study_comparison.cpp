// Simulation beside experiment, and where the time went.

#include <algorithm>

#include "tools/output/report/html.hpp"
#include "tools/output/report/study_sections.hpp"

namespace puffin::output {
namespace {

using Measurements = std::vector<Measurement>;

/// "pressure_drop_kPa" -> "pressure drop [kPa]"
std::string label_of(std::string quantity) {
  for (const char* unit : {"kPa", "Pa", "mg", "ug", "um"}) {
    const std::string tail = std::string("_") + unit;
    if (!quantity.ends_with(tail)) continue;
    quantity = escaped(quantity.substr(0, quantity.size() - tail.size())) + " [" +
               (unit == std::string("ug")   ? "&micro;g"
                : unit == std::string("um") ? "&micro;m"
                                            : unit) +
               "]";
    std::replace(quantity.begin(), quantity.end(), '_', ' ');
    return quantity;
  }
  quantity = escaped(quantity);
  std::replace(quantity.begin(), quantity.end(), '_', ' ');
  return quantity;
}

/// What a case gives of the shown quantities; empty if nothing.
std::vector<std::string> given_row(const StudyCaseResult& c, const std::string& source,
                                   const std::vector<std::string>& shown) {
  std::vector<std::string> row{escaped(c.name) + ", " + source};
  bool any = false;
  for (const std::string& quantity : shown) {
    const auto [name, factor] = counterpart_of(quantity);
    const ReferenceValue* given = c.given(source, name);
    any = any || given;
    row.push_back(given ? significant(given->given * factor) : "");
  }
  return any ? row : std::vector<std::string>{};
}

/// With intervals: one row a source.
std::string beside(const StudyResults& results, const std::string& device) {
  std::vector<std::string> head{""}, shown;
  for (const std::string& quantity : names_of(results.experiments, &Measurement::quantity, device))
    if (!counterpart_of(quantity).first.empty()) shown.push_back(quantity), head.push_back(label_of(quantity));
  const bool flows = std::any_of(shown.begin(), shown.end(), [](const std::string& quantity) {
    return is_pressure(counterpart_of(quantity).first);
  });
  if (flows) head.emplace_back("at a flow rate of [L/min]");
  Rows rows;
  std::string sources = "simulation";
  std::vector<std::string> measured{"experiment, mean &plusmn; standard deviation"}, range{"experiment, range"};
  for (const std::string& quantity : shown) {
    const Spread s = spread_of(results.experiments, device, "", quantity);
    measured.push_back(significant(s.mean) + (s.deviation ? " &plusmn; " + significant(*s.deviation, 2) : "") +
                       " <span class=soft>(n = " + std::to_string(s.tests) + ")</span>");
    range.push_back(significant(s.low) + " to " + significant(s.high));
  }
  rows.push_back(measured), rows.push_back(range);
  for (const StudyCaseResult& c : results.cases) {
    if (!same_device(c.device, device)) continue;
    std::vector<std::string> ours{escaped(c.name) + ", simulation"};
    bool any = false;
    for (const std::string& quantity : shown) {
      const auto [name, factor] = counterpart_of(quantity);
      const Estimate* e = c.find(name);
      any = any || e;
      ours.push_back(e ? with_interval(e, factor) : "");
    }
    if (!any) continue;
    if (flows) ours.push_back(flow_rate_of(c));
    rows.push_back(ours);
    for (const char* source : {"thesis", "reference"}) {
      const std::vector<std::string> theirs = given_row(c, source, shown);
      if (theirs.empty()) continue;
      rows.push_back(theirs);
      if (sources.find(source) == std::string::npos) sources += std::string(", ") + source;
    }
  }
  return "<h3>" + escaped(device) + ": " + sources + " and experiment</h3>\n" + table(head, rows);
}

std::string in_brackets(const std::optional<double>& value) {
  return value ? " <span class=soft>(" + significant(*value, 2) + ")</span>" : "";
}

/// Tables 4.7 to 4.9: copies and all together, mean with the relative standard deviation.
std::string copies(const Measurements& all, const std::string& device) {
  std::vector<std::string> head{"copy", "tests"};
  const auto quantities = names_of(all, &Measurement::quantity, device);
  for (const std::string& q : quantities) head.push_back(label_of(q));
  std::vector<std::string> names = names_of(all, &Measurement::copy, device);
  names.emplace_back();
  Rows rows;
  for (const std::string& copy : names) {
    int tests = 0;
    for (const std::string& q : quantities) tests = std::max(tests, spread_of(all, device, copy, q).tests);
    std::vector<std::string> row{copy.empty() ? "<b>all</b>" : escaped(copy), std::to_string(tests)};
    for (const std::string& q : quantities) {
      const Spread s = spread_of(all, device, copy, q);
      row.push_back(s.tests == 0 ? "" : significant(s.mean) + in_brackets(s.relative_deviation()));
    }
    rows.push_back(row);
  }
  return table(head, rows);
}

std::string tests(const Measurements& all, const std::string& device) {
  std::vector<std::string> head{"copy", "test"};
  const auto quantities = names_of(all, &Measurement::quantity, device);
  for (const std::string& q : quantities) head.push_back(label_of(q));
  Rows rows;
  std::vector<std::string> done;
  for (const Measurement& m : all) {
    if (!same_device(m.device, device) || std::find(done.begin(), done.end(), m.copy + "/" + m.test) != done.end())
      continue;
    done.push_back(m.copy + "/" + m.test);
    std::vector<std::string> row{escaped(m.copy), escaped(m.test)};
    for (const std::string& q : quantities) {
      const auto found = std::find_if(all.begin(), all.end(), [&](const Measurement& other) {
        return same_device(other.device, device) && other.copy == m.copy && other.test == m.test && other.quantity == q;
      });
      row.push_back(found == all.end() ? "" : significant(found->value));
    }
    rows.push_back(row);
  }
  return table(head, rows);
}

}  // namespace

std::string experiment_section(const StudyResults& results) {
  if (results.experiments.empty()) return "";
  std::string out = "<h2>Beside the experiments</h2>\n" + trial_section(results);
  for (const std::string& device : names_of(results.experiments, &Measurement::device)) out += beside(results, device);
  out +=
      "<p>Simulation: mean with the half width of its 95 % interval where there are replicates that "
      "differ (\"over time\": of one run, from batches of its window). The pressure drop of "
      "a simulation is total to static, over the window of its run; drops go with the "
      "square of the flow rate, so only those of like flow rates can be set beside each other. These numbers: "
      "comparison.csv.</p>\n";
  for (const std::string& device : names_of(results.experiments, &Measurement::device))
    out += "<h3>" + escaped(device) + ": the experiments</h3>\n" + copies(results.experiments, device) +
           tests(results.experiments, device);
  return out +
         "<p>Means by copy of the device, in brackets the relative standard deviation; then every test. These numbers: "
         "experiments.csv and experiments-summary.csv.</p>\n";
}

std::string effort_section(const StudyResults& results) {
  std::vector<std::string> phases;
  for (const StudyCaseResult& c : results.cases)
    if (const StudyRun* run = first_done(c))
      for (const PhaseTime& p : run->summary->phases)
        if (std::find(phases.begin(), phases.end(), p.name) == phases.end()) phases.push_back(p.name);
  if (phases.empty()) return "";
  std::vector<std::string> head{"case", "threads", "all [s]"};
  head.insert(head.end(), phases.begin(), phases.end());
  Rows rows, skipped;
  for (const StudyCaseResult& c : results.cases) {
    const StudyRun* run = first_done(c);
    if (!run) continue;
    std::vector<std::string> row{escaped(c.name), std::to_string(run->summary->threads),
                                 significant(run->summary->wall_clock)};
    for (const std::string& name : phases) {
      const auto found = std::find_if(run->summary->phases.begin(), run->summary->phases.end(),
                                      [&](const PhaseTime& p) { return p.name == name; });
      row.push_back(found == run->summary->phases.end() ? "" : significant(found->seconds));
    }
    rows.push_back(row);
    for (const SkippedWork& s : run->summary->skipped)
      skipped.push_back({escaped(c.name), "<div class=left>" + escaped(s.name) + "</div>", grouped(s.times),
                         significant(s.seconds_saved)});
  }
  std::string out = "<h2>Where the time went</h2>\n" + table(head, rows) +
                    "<p>Seconds of the first replicate of each case. These numbers: summary.csv of the runs.</p>\n";
  if (!skipped.empty())
    out += "<h3>What was skipped</h3>\n" + table({"case", "", "times", "saved, estimated [s]"}, skipped);
  return out;
}

}  // namespace puffin::output
