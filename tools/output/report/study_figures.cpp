// Pictures in a study's page: the devices, the air, the carriers, the walls.

#include <algorithm>

#include "tools/output/report/html.hpp"
#include "tools/output/report/run_pictures.hpp"
#include "tools/output/report/study_sections.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

/// Pictures of so many cases make some 15 MB; the rest have theirs in their own reports.
constexpr int most_cases = 14;

std::vector<std::string> devices_of(const StudyResults& results) {
  std::vector<std::string> devices;
  for (const StudyCaseResult& c : results.cases)
    if (std::find(devices.begin(), devices.end(), c.device) == devices.end()) devices.push_back(c.device);
  return devices;
}

/// A run whose files were altered or taken away spoils its own pictures alone.
template <class Section>
std::string or_left_out(const Section& section) try {
  return section();
} catch (const OutputError& e) {
  return left_out(e.what());
}

/// The first case of a device with a finished run that can show a view.
const StudyCaseResult* case_with(const StudyResults& results, const fs::path& study, const std::string& device,
                                 View view) {
  for (const StudyCaseResult& c : results.cases)
    if (const StudyRun* run = first_done(c); c.device == device && run) try {
        if (can_render(study / run->folder, view)) return &c;
      } catch (const OutputError&) {  // its files cannot be read
      }
  return nullptr;
}

std::string case_pictures(const StudyCaseResult& c, const StudyRun& run, const fs::path& study) {
  const fs::path folder = study / run.folder;
  std::vector<RunPicture> pictures = flight_pictures(folder, *run.summary);
  if (run.summary->carriers->retained > 0) pictures.push_back(retained_picture(*run.summary, true));
  std::string out = "<h3>" + escaped(c.name) + "</h3>\n" + embedded(folder, pictures, true);
  if (run.summary->carriers->retained == 0) out += "<p>No carrier is left in the device at the end.</p>\n";
  if (!can_render(folder, View::wall_map)) return out;
  return out + embedded(folder, wall_map_picture_of_run("fines"), true);
}

}  // namespace

const StudyRun* first_done(const StudyCaseResult& c) {
  for (const StudyRun& run : c.runs)
    if (run.summary) return &run;
  return nullptr;
}

std::string device_section(const StudyResults& results, const fs::path& study) {
  std::string out;
  for (const std::string& device : devices_of(results)) {
    const StudyCaseResult* c = case_with(results, study, device, View::geometry);
    if (!c) continue;
    out += "<h2>The " + escaped(device.empty() ? "device" : device) + " and its air</h2>\n" +
           embedded(study / first_done(*c)->folder, geometry_picture_of_run(), true);
    const StudyCaseResult* lines = case_with(results, study, device, View::streamlines);
    if (!lines) {
      out += left_out("streamlines: no case of this device stores a field of the whole device.");
      continue;
    }
    out += "<h3>Streamlines of " + escaped(lines->name) + " at four times</h3>\n" + or_left_out([&] {
             const fs::path run = study / first_done(*lines)->folder;
             return embedded(run, streamline_pictures(run), true);
           });
  }
  return out;
}

std::string carrier_section(const StudyResults& results, const fs::path& study) {
  std::string out = "<h2>Carriers in flight, at the end, and what they left on the walls</h2>\n";
  std::vector<std::string> shown;  // cases that share a run share its pictures
  for (const StudyCaseResult& c : results.cases) {
    const StudyRun* run = first_done(c);
    if (!run || !run->summary->carriers || !can_render(study / run->folder, View::carriers)) continue;
    if (std::find(shown.begin(), shown.end(), run->folder) != shown.end()) {
      out += "<h3>" + escaped(c.name) +
             "</h3>\n<p class=soft>Shares its run, and so its carriers, with a case above.</p>\n";
      continue;
    }
    if (static_cast<int>(shown.size()) == most_cases)
      return out + left_out("pictures of further cases; they are in the report.html of each run.");
    shown.push_back(run->folder);
    out += or_left_out([&] { return case_pictures(c, *run, study); });
  }
  return shown.empty() ? out + "<p>No run with carriers is done yet.</p>\n" : out;
}

}  // namespace puffin::output
