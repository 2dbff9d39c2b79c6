#pragma once
// The pictures of a run as its own page and the page of its study show them.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/output/render.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {

struct RunPicture {
  std::string name;  // of the file images/NAME.png
  View view;
  std::optional<double> time;  // [s]; absent: the last moment
  std::string caption;
  RenderOptions options;
};

/// Four stored moments from just after the start to the end; each once over the whole device and once close up on the
/// pocket (or the patch whose carriers it is about; without such a patch the close-ups are left out). One colour scale.
std::vector<RunPicture> streamline_pictures(const std::filesystem::path& run);
/// Up to four stored moments between the first motion and the last emission, coloured by speed on one scale.
std::vector<RunPicture> flight_pictures(const std::filesystem::path& run, const Summary& summary);
/// What is left in the device at the end; small to stand beside others.
RunPicture retained_picture(const Summary& summary, bool small = false);
RunPicture geometry_picture_of_run();
RunPicture slice_picture_of_run();
RunPicture wall_map_picture_of_run(const std::string& quantity);

/// The figure with the picture inside. Paints images/NAME.png, or takes the one that is there if `kept` and it is no
/// older than the run's summary. Says why if there is none.
std::string embedded(const std::filesystem::path& run, const RunPicture& picture, bool kept = false);
/// Figures side by side.
std::string embedded(const std::filesystem::path& run, const std::vector<RunPicture>& pictures, bool kept = false);

/// "<p>Left out: why</p>"
std::string left_out(const std::string& why);

}  // namespace puffin::output
