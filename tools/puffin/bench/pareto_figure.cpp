#include "tools/puffin/bench/pareto_figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tools/output/output_folder.hpp"
#include "tools/output/report/scatter.hpp"
#include "tools/output/report/svg.hpp"

namespace puffin::tools {
namespace {

std::vector<const ParetoRow*> front_of(const std::vector<ParetoRow>& rows) {
  std::vector<const ParetoRow*> front;
  for (const ParetoRow& row : rows)
    if (row.on_front) front.push_back(&row);
  std::sort(front.begin(), front.end(), [](const auto* a, const auto* b) { return a->cost < b->cost; });
  return front;
}

output::ScatterPoint point_of(const ParetoRow& row, bool labelled) {
  output::ScatterPoint p;
  p.x = row.cost;
  p.y = row.error;
  if (row.error_half_width > 0.0) p.low = row.error - row.error_half_width, p.high = row.error + row.error_half_width;
  if (labelled) p.label = name_of(row);
  p.marked = row.is_default;
  return p;
}

/// For each setting that is beaten: its error, what its cost buys at best, and the ratio of the two.
std::string equal_cost_text(const std::vector<ParetoRow>& rows) {
  std::vector<const ParetoRow*> beaten;
  for (const ParetoRow& row : rows)
    if (!row.on_front && row.outcome == "ok") beaten.push_back(&row);
  std::sort(beaten.begin(), beaten.end(), [](const auto* a, const auto* b) { return a->cost < b->cost; });
  std::string text = beaten.empty() ? "" : "  at equal cost:       error      the front's  ratio\n";
  for (const ParetoRow* row : beaten) {
    char line[240];
    std::snprintf(line, sizeof line, "    %8.2f s  %12.3g  %11.3g  %5.2f  %s; the front: %s\n", row->cost, row->error,
                  row->front_error, row->error_over_front, name_of(*row).c_str(), row->front_setting.c_str());
    text += line;
  }
  return text;
}

}  // namespace

std::string name_of(const ParetoRow& row) { return row.axis.empty() ? row.setting : row.axis + " " + row.setting; }

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string to_text(const ParetoRow& row, double seconds) {
  char text[240];
  if (row.outcome == "ok")
    std::snprintf(text, sizeof text, "%-4s %-28s %8.2f s  error %-10.3g +- %-9.2g %s", row.case_id.c_str(),
                  name_of(row).c_str(), seconds, row.error, row.error_half_width,
                  row.foreign_load > 0.1 ? "(other work on the machine)" : "");
  else
    std::snprintf(text, sizeof text, "%-4s %-28s %8.2f s  %s: %.120s", row.case_id.c_str(), name_of(row).c_str(),
                  seconds, row.outcome.c_str(), row.problem.c_str());
  return text;
}

nlohmann::json to_json(const ParetoRow& row) {
  nlohmann::json j{{"case", row.case_id},
                   {"axis", row.axis},
                   {"setting", row.setting},
                   {"metric", row.metric},
                   {"outcome", row.outcome},
                   {"problem", row.problem},
                   {"is_default", row.is_default},
                   {"on_front", row.on_front},
                   {"repeats", row.repeats},
                   {"seconds", row.seconds},
                   {"seconds_min", row.seconds_min},
                   {"seconds_max", row.seconds_max},
                   {"processor_seconds", row.processor_seconds},
                   {"cells", row.cells},
                   {"steps", row.steps},
                   {"cell_updates", row.cell_updates},
                   {"memory_peak", row.memory_peak},
                   {"value", row.value},
                   {"value_spread", row.value_spread},
                   {"value_half_width", row.value_half_width},
                   {"reference", row.reference},
                   {"reference_uncertainty", row.reference_uncertainty},
                   {"error", row.error},
                   {"error_half_width", row.error_half_width},
                   {"time_over_front", row.time_over_front},
                   {"time_over_front_certain", row.time_over_front_certain},
                   {"front_setting", row.front_setting},
                   {"front_error", row.front_error},
                   {"error_over_front", row.error_over_front},
                   {"error_over_front_by_updates", row.error_over_front_by_updates},
                   {"foreign_load", row.foreign_load}};
  for (const char* phase :
       {"set-up", "air", "walls and openings", "exchange", "carriers", "fines", "transport", "output", "other"}) {
    const auto found = row.phases.find(phase);
    j["seconds " + std::string(phase)] =
        found == row.phases.end() ? (row.phases.empty() ? not_known : 0.0) : found->second;
  }
  return j;
}

std::string front_text(const std::vector<ParetoRow>& rows) {
  std::string text = "  worth its time, from fast to accurate:\n";
  for (const ParetoRow* row : front_of(rows)) {
    char line[160];
    std::snprintf(line, sizeof line, "    error %-10.3g %8.2f s  %s\n", row->error, row->cost, name_of(*row).c_str());
    text += line;
  }
  for (const ParetoRow& row : rows) {
    if (!row.is_default || row.outcome != "ok") continue;
    char line[200];
    std::snprintf(
        line, sizeof line,
        "  the default takes %.2f times the fastest setting of no larger error, %.2f times the fastest that is "
        "more accurate beyond doubt\n",
        row.time_over_front, row.time_over_front_certain);
    text += line;
  }
  return text + equal_cost_text(rows);
}

void write_figure(const std::vector<ParetoRow>& rows, const std::string& title, bool by_processor,
                  const std::string& folder) {
  output::ScatterChart chart;
  chart.title = rows.front().case_id + "  " + title;
  chart.x_label = by_processor ? "processor time, s" : "run time, s";
  chart.y_label = "error: " + rows.front().metric;
  output::ScatterSeries front{"not beaten", {}, false, true}, others{"beaten", {}, false, false};
  for (const ParetoRow* row : front_of(rows)) front.points.push_back(point_of(*row, true));
  for (const ParetoRow& row : rows)
    if (!row.on_front && row.outcome == "ok") others.points.push_back(point_of(row, row.is_default));
  chart.series = {front, others};
  output::write_whole(std::filesystem::path(folder) / ("pareto-" + rows.front().case_id + ".svg"),
                      output::svg::standalone(output::scatter_chart(chart)));
}

}  // namespace puffin::tools
