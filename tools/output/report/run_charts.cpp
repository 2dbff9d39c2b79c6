#include "tools/output/report/run_charts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/output/report/chart.hpp"
#include "tools/output/report/html.hpp"
#include "tools/output/report/run_pictures.hpp"

namespace puffin::output {
namespace {

/// Whether a column holds anything but zeros and gaps.
bool measured(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v) && v != 0.0; });
}

}  // namespace

std::string of_first_scalar(const Summary& s) {
  if (s.fines.size() < 2) return "";
  return " of " + s.fines[0].name + ", the first of " + std::to_string(s.fines.size()) + " scalars";
}

std::string emission_section(const RunResults& run) {
  std::string out = heading("Emission over time");
  if (!run.summary.carriers) return out + left_out("this run has no carriers.");
  if (run.history.rows.empty()) return out + left_out("history.csv holds no rows.");
  const std::vector<double> time = run.column("time", 1e3);
  LineChart count;
  count.x_label = "time [ms]", count.y_label = "carriers";
  count.curves = {{"emitted", time, run.column("carriers_emitted")},
                  {"in the device", time, run.column("carriers_in")}};
  const CarrierSummary& c = *run.summary.carriers;
  if (c.first_motion) count.markers.push_back({*c.first_motion * 1e3, "first motion"});
  if (c.first_emitted) count.markers.push_back({*c.first_emitted * 1e3, "first emitted"});
  out += figure_svg(line_chart(count), "Single carriers (history.csv).");
  if (run.summary.fines.empty()) return out + left_out("the fines: this run has none.");
  LineChart fines;
  fines.x_label = "time [ms]", fines.y_label = "fraction of the fines loaded", fines.y_at_least = 1.0;
  for (const char* name : {"FFE", "FFW", "FFCR", "FFCE", "in_air"}) {
    fines.curves.push_back({name, time, run.column(name)});
  }
  out += figure_svg(line_chart(fines),
                    "Where the fines" + of_first_scalar(run.summary) +
                        " are: FFE left the device free, FFW on the walls, FFCR on carriers in the device, "
                        "FFCE on emitted carriers, in_air still airborne inside. They add up to 1.");
  return out;
}

std::string flow_section(const RunResults& run) {
  std::string out = heading("Flow and pressure");
  if (run.history.rows.empty()) return out + left_out("history.csv holds no rows.");
  const std::vector<double> time = run.column("time", 1e3);
  const std::vector<double> rates = run.column("flow_rate", 6e4);
  const bool flows = measured(rates),
             drops = measured(run.column("static_drop")) || measured(run.column("total_to_static_drop"));
  if (!flows && !drops) return out + left_out("no flow through an opening and no pressure drop were recorded.");
  out += "<div class=pair>\n";
  LineChart rate{"time [ms]", "flow rate [L/min]", {{"flow rate", time, rates}}, {}, 0.0, 520.0};
  if (flows) out += figure_svg(line_chart(rate), "Flow rate through the device.");
  LineChart drop{"time [ms]", "pressure drop [Pa]", {}, {}, 0.0, 520.0};
  drop.curves = {{"static", time, run.column("static_drop")},
                 {"total to static", time, run.column("total_to_static_drop")}};
  if (drops) out += figure_svg(line_chart(drop), "Pressure drops from inlet to outlet.");
  out += "</div>\n";
  if (!drops) out += left_out("the pressure drops: none was recorded.");
  if (!run.summary.pressure) return out;
  const PressureSummary& p = *run.summary.pressure;
  Rows rows;
  const auto add = [&](const char* name, const TimeMean& m) {
    rows.push_back(
        {name, significant(m.mean, 4),
         m.ci_low && m.ci_high ? significant(*m.ci_low, 4) + " to " + significant(*m.ci_high, 4) : "too few batches",
         std::to_string(m.batches)});
  };
  add("static drop [Pa]", p.static_drop);
  add("total-to-static drop [Pa]", p.total_to_static_drop);
  if (p.flow_rate.mean)
    rows.push_back({"at a flow rate of [L/min]", significant(*p.flow_rate.mean * 6e4, 4), "",
                    std::to_string(p.flow_rate.batches)});
  out += table({"mean from " + milliseconds(p.window_begin) + " to " + milliseconds(p.window_end), "mean",
                "95 % interval of the mean", "batches"},
               rows);
  out += paragraph(
      "The total-to-static drop is what a test rig measures against the room: the losses and the speed that leaves. "
      "The interval comes from the means of equal pieces of that time, the batches: longer runs give more.");
  return out;
}

std::string outcome_section(const RunResults& run) {
  std::string out = heading("Where the fines ended");
  if (run.summary.fines.empty()) return out + left_out("this run has no fines.");
  const FinesSummary& f = run.summary.fines[0];
  BarChart chart{"fraction of the fines loaded", {}, 3};
  for (const auto& [name, value] : {std::pair<std::string, double>{"FFE", f.FFE},
                                    {"FFW", f.FFW},
                                    {"FFCR", f.FFCR},
                                    {"FFCE", f.FFCE},
                                    {"in_air", f.in_air}}) {
    BarGroup group{name, {{"this run", value, {}, {}}}};
    for (const auto& row : run.summary.reference) {
      const auto [source, quantity] = source_of(row.name);
      if (quantity == name) group.bars.push_back({source, row.given, row.low, row.high});
    }
    chart.groups.push_back(group);
  }
  out +=
      figure_svg(bar_chart(chart),
                 "The fines" + of_first_scalar(run.summary) +
                     ": FFE free and emitted, FFW on the walls, FFCR on retained carriers, FFCE on emitted carriers, "
                     "in_air still airborne at the end. Whiskers: the spread of the given value.");
  Rows rows;
  for (const auto& one : run.summary.fines) {
    rows.push_back({escaped(one.name), significant(one.FFE), significant(one.FFW), significant(one.FFCR),
                    significant(one.FFCE), significant(one.in_air), percent(one.by_mechanism.wall),
                    percent(one.by_mechanism.particle), percent(one.by_mechanism.drag),
                    significant(one.ledger_error, 2)});
  }
  return out + table({"scalar", "FFE", "FFW", "FFCR", "FFCE", "in_air", "detached by walls", "by carriers", "by drag",
                      "ledger error"},
                     rows);
}

}  // namespace puffin::output
