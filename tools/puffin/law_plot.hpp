#pragma once
// Laws over speed, as a picture and as a table.

#include <filesystem>
#include <string>
#include <vector>

#include "micromodels/fines_models.hpp"
#include "tools/output/report/chart.hpp"

namespace puffin::tools {

/// [m/s], where the laws have something to show: the largest end of a range of validity, else 40.
double plot_range(const micromodels::FinesModels& models);

/// A curve for each impact law: fraction over speed, head on.
std::vector<output::Curve> law_curves(const micromodels::FinesModels& models, double fastest);

/// A file that any browser opens. Throws output::OutputError if it cannot be written.
void write_svg(const std::filesystem::path& file, const output::LineChart& chart);

/// "wall_detach: power, valid 0-8 m/s, jumps by 0.01 at 1.4 m/s", a line each; drag too.
std::vector<std::string> law_notes(const micromodels::FinesModels& models);

}  // namespace puffin::tools
