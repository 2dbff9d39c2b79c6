#include "tools/output/report/live_page.hpp"

#include <cmath>

#include "tools/output/report/chart.hpp"
#include "tools/output/report/html.hpp"

namespace puffin::output {
namespace {

std::string tile(const std::string& value, const std::string& name) {
  return "<div class=tile><b>" + value + "</b><span>" + name + "</span></div>\n";
}

std::string duration(double seconds) {
  if (seconds < 120) return significant(seconds, 2) + " s";
  if (seconds < 7200) return significant(seconds / 60, 2) + " min";
  return significant(seconds / 3600, 2) + " h";
}

std::vector<double> column(const std::vector<HistoryRow>& history, double HistoryRow::*member, double factor = 1.0) {
  std::vector<double> out;
  out.reserve(history.size());
  for (const HistoryRow& row : history) out.push_back(row.*member * factor);
  return out;
}

std::string curves(const std::vector<HistoryRow>& history) {
  if (history.size() < 2) return "";
  const std::vector<double> time = column(history, &HistoryRow::time, 1e3);
  LineChart drop{"time [ms]", "pressure drop [Pa]", {}, {}, 0.0, 520.0};
  drop.curves = {{"static", time, column(history, &HistoryRow::static_drop)},
                 {"total to static", time, column(history, &HistoryRow::total_to_static_drop)}};
  std::string out = "<div class=pair>\n" + figure_svg(line_chart(drop), "Pressure drops from inlet to outlet.");
  if (history.front().carriers_in > 0) {
    LineChart count{"time [ms]", "carriers", {}, {}, 0.0, 520.0};
    count.curves = {{"in the device", time, column(history, &HistoryRow::carriers_in)},
                    {"at rest", time, column(history, &HistoryRow::carriers_asleep)},
                    {"emitted", time, column(history, &HistoryRow::carriers_emitted)}};
    LineChart fines{"time [ms]", "fraction of the fines", {}, {}, 0.0, 520.0};
    fines.curves = {{"FFE", time, column(history, &HistoryRow::FFE)},
                    {"FFW", time, column(history, &HistoryRow::FFW)},
                    {"FFCE", time, column(history, &HistoryRow::FFCE)},
                    {"in_air", time, column(history, &HistoryRow::in_air)}};
    out += figure_svg(line_chart(count), "Single carriers.") +
           figure_svg(line_chart(fines), "Fines emitted free, on the walls, on emitted carriers, and in the air.");
  }
  return out + "</div>\n";
}

}  // namespace

std::string live_page(const Status& s, const std::vector<HistoryRow>& history) {
  const bool running = s.state == "running";
  const double done = s.end_time > 0 ? std::min(1.0, s.simulated_time / s.end_time) : 0.0;
  std::string body = "<h1>" + escaped(s.name) + "<span class=\"state " + (running ? "stopped" : escaped(s.state)) +
                     "\">" + escaped(s.state) + "</span></h1>\n<div>" + progress_bar(done, "style=\"width:100%\"") +
                     "</div>\n<div class=tiles>\n";
  body += tile(significant(1e3 * s.simulated_time, 3) + " of " + significant(1e3 * s.end_time, 3) + " ms", "simulated");
  body += tile(escaped(s.phase), "phase");
  body += tile(duration(s.wall_clock), "since the start");
  if (running && s.eta) body += tile(duration(*s.eta), "to go");
  body += tile(significant(s.mlups, 3), "million cell updates a second");
  if (s.ledger_error) body += tile(significant(std::abs(*s.ledger_error), 2), "error of the fines' ledger");
  body += "</div>\n";
  for (const std::string& warning : s.warnings) body += "<div class=alarm>" + escaped(warning) + "</div>\n";
  const bool reported = s.state == "finished" || s.state == "diverged";
  if (reported) body += "<p>The results: <a href=\"report.html\">report.html</a></p>\n";
  if (!running && !reported) body += "<p>Why: <a href=\"log.txt\">log.txt</a></p>\n";
  std::string html = page(s.name, body + curves(history));
  if (const auto at = html.find("<head>"); running && at != std::string::npos)
    html.insert(at + 6, "\n<meta http-equiv=\"refresh\" content=\"3\">");
  return html;
}

}  // namespace puffin::output
