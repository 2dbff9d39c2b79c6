// The report of one run, section by section. A section without data says why it is left out.

#include <cmath>

#include "tools/output/csv_file.hpp"
#include "tools/output/picture/decorations.hpp"
#include "tools/output/render.hpp"
#include "tools/output/report.hpp"
#include "tools/output/report/chart.hpp"
#include "tools/output/report/html.hpp"
#include "tools/output/report/run_charts.hpp"
#include "tools/output/report/run_pictures.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

std::string duration(double seconds) {
  if (seconds < 120) return significant(seconds, 3) + " s";
  if (seconds < 7200) return significant(seconds / 60, 3) + " min";
  return significant(seconds / 3600, 3) + " h";
}

std::string tile(const std::string& value, const std::string& name) {
  return "<div class=tile><b>" + value + "</b><span>" + name + "</span></div>\n";
}

std::string head(const RunResults& run) {
  const Summary& s = run.summary;
  const bool known = s.state == "finished" || s.state == "stopped" || s.state == "diverged";
  std::string out = "<h1>" + escaped(s.name) + "<span class=\"state " + (known ? s.state : "stopped") + "\">" +
                    escaped(s.state) + "</span></h1>\n<p class=soft>Puffin " + escaped(s.version) + ", " +
                    std::to_string(s.threads) + " threads" + (s.host.empty() ? "" : ", " + escaped(s.host)) +
                    (s.preset.empty() ? "" : ", preset " + escaped(s.preset)) +
                    (s.stop_time ? ", until " + milliseconds(*s.stop_time) : "") + "</p>\n";
  if (s.state == "diverged") {
    out += "<div class=alarm><b>This run diverged</b> after " + milliseconds(s.simulated_time) +
           " of simulated time. " + escaped(s.message) +
           "<br>What follows is what had been written until then and is no result.</div>\n";
  } else if (!s.message.empty()) {
    out += paragraph(s.message);
  }
  out += "<div class=tiles>\n" + tile(milliseconds(s.simulated_time), "simulated");
  out += tile(duration(s.wall_clock), "wall-clock time");
  if (s.carriers && s.carriers->count > 0) {
    const auto count = static_cast<double>(s.carriers->count);
    out += tile(percent(static_cast<double>(s.carriers->emitted) / count),
                "of " + grouped(s.carriers->count) + " carriers emitted");
  }
  if (!s.fines.empty()) {
    out += tile(percent(s.fines[0].FFE), "fines emitted free (FFE)" + escaped(of_first_scalar(s)));
    out += tile(percent(s.fines[0].FFW), "fines on the walls (FFW)" + escaped(of_first_scalar(s)));
    out += tile(significant(std::abs(s.fines[0].ledger_error), 2),
                "error of the fines' ledger" + escaped(of_first_scalar(s)));
  }
  if (s.pressure && s.pressure->total_to_static_drop.mean) {
    out += tile(significant(*s.pressure->total_to_static_drop.mean, 3) + " Pa", "total-to-static pressure drop");
  }
  out += tile(significant(s.mlups, 3), "million cell updates a second");
  return out + "</div>\n";
}

/// What a trial cannot be compared in.
std::string trial_note(const RunResults& run) {
  const std::string what = trial(run.summary);
  if (what.empty()) return "";
  std::string out = "<div class=alarm><b>A trial:</b> " + escaped(what) + ".";
  if (cut_short(run.summary))
    out +=
        " What would come later is not in it: what leaves the device, what it retains and the last emission are "
        "those until then.";
  return out + "</div>\n";
}

/// What the run warned of, before anything that it came to.
std::string warnings(const RunResults& run) {
  if (run.summary.warnings.empty()) return "";
  std::string out = "<div class=alarm><b>This run warns:</b>\n<ul>\n";
  for (const std::string& text : run.summary.warnings) out += "<li>" + escaped(text) + "</li>\n";
  return out + "</ul></div>\n";
}

/// Beside a time that the end of the run may have cut.
std::string until_the_end(const Summary& s) {
  return cut_short(s) ? " <span class=soft>(until the end of this run)</span>" : "";
}

std::string geometry(const RunResults& run) {
  std::string out = heading("The device");
  if (!can_render(run.folder, View::geometry)) return out + left_out("this run has written no walls (vtk/walls.pvd).");
  return out + embedded(run.folder, geometry_picture_of_run());
}

std::string carriers(const RunResults& run) {
  std::string out = heading("Carriers in flight");
  if (!run.summary.carriers) return out + left_out("this run has no carriers.");
  if (!can_render(run.folder, View::carriers)) {
    return out + left_out("no moments of the carriers are stored; set [output] carriers = \"1 ms\".");
  }
  out += embedded(run.folder, flight_pictures(run.folder, run.summary));
  const CarrierSummary& c = *run.summary.carriers;
  out += table({"", ""}, {{"loaded", grouped(c.count)},
                          {"emitted", grouped(c.emitted)},
                          {"retained", grouped(c.retained) + " (" + percent(c.retained_fraction) + ")"},
                          {"first motion", milliseconds(c.first_motion)},
                          {"first emitted", milliseconds(c.first_emitted)},
                          {"last emitted", milliseconds(c.last_emitted) + until_the_end(run.summary)},
                          {"retained dose fraction (RDF)", significant(c.RDF, 3)}});
  if (c.retained == 0) return out + paragraph("No carrier is left in the device at the end.");
  return out + embedded(run.folder, retained_picture(run.summary));
}

std::string reference(const RunResults& run) {
  std::string out = heading("Beside the given values");
  if (run.summary.reference.empty()) return out + left_out("the case has no [reference] table.");
  const auto late = [](const ReferenceRow& row) { return source_of(row.name).second == "last_emitted"; };
  Rows rows;
  for (const auto& row : run.summary.reference) {
    rows.push_back({"<code>" + escaped(row.name) + "</code>", short_number(row.given),
                    row.low && row.high ? short_number(*row.low) + " to " + short_number(*row.high) : "",
                    significant(row.ours, 4) + (late(row) ? until_the_end(run.summary) : ""),
                    significant(row.difference, 3),
                    row.difference && row.given != 0 ? percent(*row.difference / std::abs(row.given)) : ""});
  }
  return out + table({"quantity", "given", "spread", "this run", "difference", "relative"}, rows) +
         paragraph("Given values are printed for comparison; the solver never uses them. SI units.");
}

std::string collisions(const RunResults& run) {
  std::string out = heading("Collisions");
  if (!run.summary.collisions) return out + left_out("this run has no carriers.");
  const CollisionSummary& c = *run.summary.collisions;
  out += table({"", "walls", "carriers"},
               {{"collisions", grouped(std::llround(c.wall)), grouped(std::llround(c.particle))},
                {"mean energy [J]", significant(c.mean_wall_energy), significant(c.mean_particle_energy)}});
  out +=
      table({"median number of collisions", ""}, {{"of all carriers", significant(c.median_per_carrier)},
                                                  {"of emitted carriers", significant(c.median_per_emitted_carrier)}});
  if (c.largest_overlap)
    out += "<p>Largest overlap of a contact: " + percent(*c.largest_overlap) + " of a diameter.</p>\n";
  return out +
         paragraph("Counted per single carrier: a parcel of ten counts ten times, a contact once for each partner.");
}

std::string wall_map(const RunResults& run) {
  std::string out = heading("What landed on the walls");
  if (!run.summary.carriers) return out + left_out("this run has no carriers.");
  if (!can_render(run.folder, View::wall_map)) return out + left_out("no wall map is stored.");
  RunPicture fines = wall_map_picture_of_run("fines");
  if (const std::string scalar = of_first_scalar(run.summary); !scalar.empty())
    fines.caption = "Fines" + scalar + ". " + fines.caption;
  return out + embedded(run.folder, fines) + embedded(run.folder, wall_map_picture_of_run("hits"));
}

std::string slice(const RunResults& run) {
  std::string out = heading("The air");
  if (!can_render(run.folder, View::slice)) {
    return out + left_out("no fields are stored; add an entry to [output] fields.");
  }
  out += embedded(run.folder, slice_picture_of_run());
  const std::vector<RunPicture> lines = streamline_pictures(run.folder);
  if (lines.empty())
    return out +
           left_out("streamlines: no field of the whole device is stored; set region = \"all\" in [output] fields.");
  return out + embedded(run.folder, lines);
}

std::string work(const RunResults& run) {
  std::string out = heading("Where the time went");
  if (run.summary.phases.empty()) return out + left_out("no times by phase are recorded.");
  BarChart chart{"seconds of wall-clock time", {}, 3};
  for (const auto& phase : run.summary.phases) {
    chart.groups.push_back({phase.name, {{"time", phase.seconds, {}, {}}}});
  }
  out += figure_svg(bar_chart(chart), "Of " + shortest(std::round(run.summary.wall_clock * 10) / 10) + " s in all.");
  if (run.summary.skipped.empty()) return out + paragraph("Nothing was skipped.");
  Rows rows;
  for (const auto& skip : run.summary.skipped) {
    rows.push_back({escaped(skip.name), grouped(skip.times), duration(skip.seconds_saved)});
  }
  return out + "<h3>What was skipped</h3>\n" + table({"", "times", "saved, estimated"}, rows);
}

/// "7 593 (0.0003 % of the cell updates)"
std::string acted(std::int64_t times, const Summary& s) {
  const double updates = static_cast<double>(s.cells_active) * static_cast<double>(s.steps);
  return grouped(times) + (times > 0 && updates > 0
                               ? " (" + percent(static_cast<double>(times) / updates) + " of the cell updates)"
                               : "");
}

std::string numerics(const RunResults& run) {
  const Summary& s = run.summary;
  const std::string title = heading("Numerics");
  if (s.cells_active == 0)  // carriers alone: dx, tau and Mach are of no lattice
    return title +
           table({"", ""}, {{"time steps", grouped(s.steps)},
                            {"time step dt", significant(s.dt_min * 1e6, 3) + " &micro;s"},
                            {"peak memory", significant(s.memory_peak / 1048576, 3) + " MiB"}}) +
           left_out("cell size, relaxation time and Mach number: no air was computed on a lattice.");
  Rows rows{{"cell size dx", significant(s.dx * 1e3, 4) + " mm"},
            {"fluid cells", grouped(s.cells_fluid)},
            {"computed cells", grouped(s.cells_active)},
            {"time steps", grouped(s.steps)},
            {"time step dt", significant(s.dt_min * 1e6, 3) + " to " + significant(s.dt_max * 1e6, 3) + " &micro;s"},
            {"smallest relaxation time tau", significant(s.tau_min, 6)},
            {"largest lattice Mach number", significant(s.mach_max, 3)},
            {"limited: cells that the positivity limiter acted in, over all steps", acted(s.limited, s)},
            {"back-flow cut: cells at outlets, over all steps", acted(s.backflow, s)},
            {"million fluid-cell updates a second", significant(s.mlups, 3)},
            {"million computed-cell updates a second", significant(s.mlups_active, 3)},
            {"peak memory", significant(s.memory_peak / 1048576, 3) + " MiB"}};
  return title + table({"", ""}, rows);
}

std::string assumptions(const RunResults& run) {
  std::string out = heading("Assumptions");
  if (run.summary.assumptions.empty()) return out + paragraph("The case marks none.");
  out += "<ul>\n";
  for (const auto& text : run.summary.assumptions) out += "<li>" + escaped(text) + "</li>\n";
  return out + "</ul>\n";
}

std::string reproduce(const RunResults& run) {
  const std::string until = run.summary.until ? " --until " + shortest(*run.summary.until) + "s" : "";
  return heading("To run this again") + "<p>With Puffin " + escaped(run.summary.version) +
         " and the file <code>case.toml</code> of this run, which holds every value and where it came "
         "from:</p>\n<pre>" +
         "puffin run case.toml --threads " + std::to_string(run.summary.threads) + until + " --out again\n" +
         "puffin compare again " + escaped(run.folder.filename().string()) + "</pre>\n" +
         "<p class=soft>The numbers of this page are in summary.csv (and summary.json) and history.csv; the "
         "pictures are in images/.</p>\n";
}

}  // namespace

std::string make_report(const fs::path& folder) {
  RunResults run;
  run.folder = fs::absolute(folder).lexically_normal();
  if (!run.folder.has_filename()) run.folder = run.folder.parent_path();
  run.summary = read_summary(run.folder / "summary.json");
  if (fs::exists(run.folder / "history.csv")) run.history = read_csv(run.folder / "history.csv");
  write_summary_table(run.folder);
  std::string body = head(run);
  for (const auto section : {trial_note, warnings, geometry, carriers, emission_section, outcome_section, reference,
                             flow_section, slice, collisions, wall_map, work, numerics, assumptions, reproduce}) {
    body += section(run);
  }
  return page(run.summary.name, body);
}

}  // namespace puffin::output
