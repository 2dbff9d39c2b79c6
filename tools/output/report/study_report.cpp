// The report of a study: its cases beside each other, beside the given values and the experiments.

#include <algorithm>
#include <cmath>

#include "tools/output/csv_file.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/report.hpp"
#include "tools/output/report/chart.hpp"
#include "tools/output/report/html.hpp"
#include "tools/output/report/study_sections.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/output/study_results.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

std::string with_given(const StudyCaseResult& c, const std::string& quantity, double factor = 1.0) {
  const Estimate* e = c.find(quantity);
  const ReferenceValue* given = c.given("thesis", quantity);
  if (!given) given = c.given("reference", quantity);
  return with_interval(e, factor) +
         (given ? " <span class=soft>(" + significant(given->given * factor) + ")</span>" : "");
}

/// "; in brackets: the thesis" where a case gives values that with_given() puts there.
std::string brackets(const StudyResults& results) {
  const auto any = [&](const char* source) {
    return std::any_of(results.cases.begin(), results.cases.end(),
                       [&](const StudyCaseResult& c) { return c.gives(source); });
  };
  const bool thesis = any("thesis"), plain = any("reference");
  if (!thesis && !plain) return "";
  return std::string("; in brackets: the ") + (thesis && plain ? "thesis, or else the reference"
                                               : thesis        ? "thesis"
                                                               : "reference");
}

/// A name of usual length on one line: tables part it at its hyphens.
std::string unbroken(const std::string& name) {
  return name.size() > 32 ? escaped(name) : "<span style=\"white-space:nowrap\">" + escaped(name) + "</span>";
}

bool any_run(const StudyCaseResult& c) { return !c.numbers.empty(); }

std::string overview(const StudyResults& results) {
  Rows rows;
  for (const StudyCaseResult& c : results.cases) {
    int done = 0;
    std::string problems, sets;
    for (const StudyRun& run : c.runs) {
      done += run.state == "done";
      if (run.state == "failed") problems += escaped(run.folder + ": " + run.message) + "<br>";
    }
    for (const auto& [key, value] : c.sets) sets += "<code>" + escaped(key + " = " + value) + "</code><br>";
    rows.push_back({unbroken(c.name), "<div class=left>" + sets + "</div>",
                    std::to_string(done) + " of " + std::to_string(c.runs.size()),
                    with_interval(c.find("simulated_time"), 1e3), with_interval(c.find("wall_clock")),
                    "<div class=left>" + problems + "</div>"});
  }
  return heading("The cases") + table({"case", "<div class=left>changes</div>", "runs done", "simulated [ms]",
                                       "wall-clock [s]", "<div class=left>problems</div>"},
                                      rows);
}

std::string outcome(const StudyResults& results, const std::string& quantity, const std::string& label) {
  BarChart chart{label, {}, 3};
  for (const StudyCaseResult& c : results.cases) {
    BarGroup group{c.name, {}};
    if (const Estimate* e = c.find(quantity)) {
      Bar bar{"this study", e->mean, {}, {}};
      if (e->ci_low) bar.low = std::max(0.0, *e->ci_low), bar.high = e->ci_high;
      group.bars.push_back(bar);
    }
    for (const char* source : {"thesis", "reference", "experiment"})
      if (const ReferenceValue* given = c.given(source, quantity))
        group.bars.push_back({source, given->given, given->low, given->high});
    if (any_run(c) && !group.bars.empty()) chart.groups.push_back(group);
  }
  if (chart.groups.empty()) return "";
  return figure_svg(bar_chart(chart), quantity +
                                          ". Whiskers: 95 % interval of the mean over the replicates (this study); "
                                          "smallest and largest (experiment).");
}

std::string outcomes(const StudyResults& results) {
  std::string out = heading("Where the fines ended");
  const std::string bars = outcome(results, "FFE", "FFE: fines that left the device free, of all") +
                           outcome(results, "FFW", "FFW: fines on the walls, of all") +
                           outcome(results, "FFCR", "FFCR: fines on retained carriers, of all") +
                           outcome(results, "FFCE", "FFCE: fines on emitted carriers, of all") +
                           outcome(results, "RDF", "RDF: retained dose, of all");
  if (bars.empty()) return out + paragraph("No run with fines is done yet.");
  Rows rows;
  for (const StudyCaseResult& c : results.cases)
    if (any_run(c))
      rows.push_back({escaped(c.name), with_given(c, "FFE"), with_given(c, "FFW"), with_given(c, "FFCR"),
                      with_given(c, "FFCE"), with_interval(c.find("in_air")), with_given(c, "RDF"),
                      with_given(c, "retained_fraction"), with_given(c, "by_mechanism.wall"),
                      with_given(c, "by_mechanism.particle")});
  return out + bars +
         table({"case", "FFE", "FFW", "FFCR", "FFCE", "in air", "RDF", "carriers retained", "by walls", "by carriers"},
               rows) +
         paragraph("Mean with the half width of its 95 % interval where there are replicates" + brackets(results) +
                   ".");
}

/// A column over the run's history; of a run that cases share, the values of this case's own scalar. None where
/// stats.h5 does not have them (an earlier program's run, a damaged file): history.csv has those of another case.
std::vector<double> column_of(const StudyRun& run, const fs::path& folder, const std::string& column,
                              const CsvTable& history) {
  if (run.scalar.empty() || !column.starts_with("FF")) return history.numbers(column);
  try {
    return read_stats(folder / "stats.h5", column + "_" + run.scalar);
  } catch (const OutputError&) {
    return {};
  }
}

/// Curves of one column of the first finished run of every case.
std::string curves(const StudyResults& results, const fs::path& study, const std::string& column, bool over_count,
                   const std::string& label, const std::string& caption) {
  LineChart chart;
  chart.x_label = "time [ms]", chart.y_label = label;
  for (const StudyCaseResult& c : results.cases) {
    const auto run =
        std::find_if(c.runs.begin(), c.runs.end(), [](const StudyRun& r) { return r.summary.has_value(); });
    if (run == c.runs.end() || !run->summary->carriers || !fs::exists(study / run->folder / "history.csv")) continue;
    const CsvTable history = read_csv(study / run->folder / "history.csv");
    std::vector<double> time = history.numbers("time"), value = column_of(*run, study / run->folder, column, history);
    if (time.empty() || value.size() != time.size()) continue;
    for (double& t : time) t *= 1e3;
    const auto count = static_cast<double>(std::max<std::int64_t>(1, run->summary->carriers->count));
    for (double& v : value) v /= over_count ? count : 1.0;
    chart.curves.push_back({c.name, time, value});
  }
  if (chart.curves.empty()) return "";
  return figure_svg(line_chart(chart), caption);
}

/// By device, at most seven cases a frame: there are no more colours that can be told apart.
std::string emission(const StudyResults& results, const fs::path& study) {
  constexpr std::size_t most = 7;
  std::vector<StudyResults> frames;
  for (const StudyCaseResult& c : results.cases) {
    const auto room = std::find_if(frames.begin(), frames.end(), [&](const StudyResults& f) {
      return f.cases.front().device == c.device && f.cases.size() < most;
    });
    if (room == frames.end())
      frames.push_back({results.name, {}, {c}});
    else
      room->cases.push_back(c);
  }
  std::string out;
  for (const StudyResults& frame : frames) {
    out += curves(frame, study, "carriers_emitted", true, "carriers emitted, of all",
                  "Carriers that have left (history.csv of the first replicate).");
    out += curves(frame, study, "FFE", false, "fines emitted free (FFE)",
                  "Fines that have left free of a carrier (history.csv, stats.h5); a case whose fines were replayed "
                  "has the curve of its run.");
  }
  return heading("Emission over time") + (out.empty() ? paragraph("No run with carriers is done yet.") : out);
}

std::string times(const StudyResults& results) {
  Rows rows;
  for (const StudyCaseResult& c : results.cases)
    if (c.find("retained_fraction"))
      rows.push_back({escaped(c.name), with_given(c, "first_motion", 1e3), with_given(c, "first_emitted", 1e3),
                      with_given(c, "last_emitted", 1e3)});
  if (rows.empty()) return "";
  return table({"case", "first motion [ms]", "first emitted [ms]", "last emitted [ms]"}, rows);
}

std::string collisions(const StudyResults& results) {
  Rows rows;
  for (const StudyCaseResult& c : results.cases)
    if (c.find("collisions.wall"))
      rows.push_back({escaped(c.name), with_given(c, "collisions.wall"), with_given(c, "collisions.particle"),
                      with_given(c, "median_per_carrier"), with_given(c, "median_per_emitted_carrier"),
                      with_given(c, "mean_wall_energy", 1e12), with_given(c, "mean_particle_energy", 1e12)});
  std::string out = heading("Collisions");
  if (rows.empty()) return out + paragraph("No run with carriers is done yet.");
  return out +
         table({"case", "with walls", "with carriers", "median a carrier", "median an emitted carrier",
                "mean wall energy [pJ]", "mean carrier energy [pJ]"},
               rows) +
         paragraph("Counted per single carrier" + brackets(results) + ".");
}

std::string pressures(const StudyResults& results) {
  Rows rows;
  for (const StudyCaseResult& c : results.cases)
    if (c.find("static_drop") || c.find("total_to_static_drop"))
      rows.push_back(
          {escaped(c.name), with_given(c, "static_drop"), with_given(c, "total_to_static_drop"), flow_rate_of(c)});
  std::string out = heading("Pressure drops");
  if (rows.empty()) return out + paragraph("No run has measured one yet.");
  return out + table({"case", "static [Pa]", "total to static [Pa]", "at a flow rate of [L/min]"}, rows) +
         paragraph(
             "Means over the window of each run (its last tenth unless the case says otherwise)" + brackets(results) +
             ". The interval is that of the mean over the replicates, or, \"over time\", that of one run's mean from "
             "batches of its window: where there is one run, or the seed changes nothing. Drops go with the square of "
             "the flow rate: only those of like flow rates can be compared.");
}

}  // namespace

std::string with_interval(const Estimate* e, double factor) {
  if (!e) return "<span class=soft>none</span>";
  std::string text = significant(e->mean * factor);
  if (e->ci_low) text += " &plusmn; " + significant((*e->ci_high - e->mean) * factor, 2);
  if (e->interval == "batches") text += " <span class=soft>(over time)</span>";
  return text;
}

std::string flow_rate_of(const StudyCaseResult& c) {
  const Estimate* e = c.find("flow_rate");
  return e ? significant(e->mean * 6e4) : "<span class=soft>none</span>";
}

std::string make_study_report(const fs::path& study) {
  const StudyResults results = read_study_results(study);
  return page(results.name,
              "<h1>" + escaped(results.name) + "</h1>\n" + overview(results) + trial_section(results) +
                  warning_section(results) + device_section(results, study) + outcomes(results) +
                  experiment_section(results) + emission(results, study) + times(results) +
                  carrier_section(results, study) + collisions(results) + pressures(results) + effort_section(results) +
                  assumption_section(results) +
                  "<p class=soft>The numbers of this page are in results.csv, results.json and (run by run) runs.csv; "
                  "the curves in the history.csv of each run.</p>\n");
}

}  // namespace puffin::output
