#include "tools/puffin/law_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "micromodels/continuity.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

using Named = std::pair<const char*, const std::optional<micromodels::Law>*>;

std::array<Named, 4> named(const micromodels::FinesModels& m) {
  return {{{"wall_detach", &m.wall_detach},
           {"wall_attach", &m.wall_attach},
           {"particle_detach", &m.particle_detach},
           {"drag_detach", &m.drag_detach}}};
}

}  // namespace

double plot_range(const micromodels::FinesModels& models) {
  double fastest = 0.0;
  for (const auto& [name, law] : named(models))
    if (*law && law != &models.drag_detach && std::isfinite(micromodels::valid(**law).high))
      fastest = std::max(fastest, micromodels::valid(**law).high);
  return fastest > 0.0 ? fastest : 40.0;
}

std::vector<output::Curve> law_curves(const micromodels::FinesModels& models, double fastest) {
  std::vector<output::Curve> curves;
  for (const auto& [name, law] : named(models)) {
    if (!*law || law == &models.drag_detach) continue;
    output::Curve curve{name, {}, {}};
    const double end = std::min(fastest, micromodels::valid(**law).high);  // beyond it the law says nothing
    for (int n = 0; n <= 280; ++n) {
      curve.x.push_back(end * n / 280);
      curve.y.push_back(micromodels::fraction(**law, curve.x.back()));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

void write_svg(const std::filesystem::path& file, const output::LineChart& chart) {
  std::string svg = output::line_chart(chart);
  const std::string open = "<svg ";
  svg.replace(svg.find(open), open.size(),
              "<svg xmlns=\"http://www.w3.org/2000/svg\" style=\"background:white\" width=\"760\" height=\"330\" ");
  output::write_whole(file, svg);
}

std::vector<std::string> law_notes(const micromodels::FinesModels& models) {
  std::vector<std::string> notes;
  for (const auto& [name, law] : named(models)) {
    std::string note = std::string(name) + ": ";
    if (!*law) {
      notes.push_back(note + "does not act");
      continue;
    }
    note += micromodels::name(**law);
    const micromodels::Validity& valid = micromodels::valid(**law);
    note += std::isfinite(valid.high) ? ", valid " + four_digits(valid.low) + " to " + four_digits(valid.high) + " m/s"
                                      : ", range of validity not stated";
    const micromodels::Jump jump = micromodels::jump(**law);
    note += jump.height == 0.0 ? ", continuous"
                               : ", jumps by " + four_digits(jump.height) + " at " + four_digits(jump.speed) + " m/s";
    notes.push_back(note);
  }
  return notes;
}

}  // namespace puffin::tools
