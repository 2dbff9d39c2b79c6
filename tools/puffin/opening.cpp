#include "tools/puffin/opening.hpp"

#include <stdexcept>
#include <utility>

#include "cases/case_error.hpp"
#include "cases/check_places.hpp"
#include "cases/micromodel_file.hpp"
#include "cases/write_case.hpp"
#include "tools/puffin/available_memory.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/sampling.hpp"
#include "tools/puffin/stored_field.hpp"

namespace puffin::tools {

double stop_time_of(const cases::Case& c, const std::filesystem::path& case_file,
                    const std::vector<cases::Override>& sets, const std::string& preset) try {
  return preset.empty() ? c.stop.time : cases::read_case(case_file, sets).stop.time;
} catch (const cases::CaseError&) {  // what is set fits the preset alone
  return c.stop.time;
}

std::unique_ptr<cases::Simulation> built(const cases::Case& c, const std::filesystem::path& case_file,
                                         const std::filesystem::path& beds) try {
  return cases::build(c, read_stored_field, available_memory(), beds);
} catch (const std::invalid_argument& e) {
  throw cases::CaseError({{case_file.string(), 0, 0, "", e.what()}});
}

std::vector<std::string> first_warnings(const cases::Simulation& s) {
  std::vector<std::string> list = PointReader(s).check_places(s);
  for (std::string& text : cases::carrier_place_warnings(s.description, *s.tree)) list.push_back(std::move(text));
  list.insert(list.end(), s.warnings.begin(), s.warnings.end());
  return list;
}

void keep_case(const cases::Case& c, const output::OutputFolder& folder) {
  folder.write_text("case.toml", cases::write_resolved(c));
  if (c.fines && !c.fines->micromodels.empty())
    folder.write_text("micromodels.toml", cases::micromodels_with_tables(c.fines->micromodels));
}

void log_beginning(const cases::Simulation& s, int threads, const std::filesystem::path& out) {
  if (s.state.air)
    log_info(s.description.name + ": " + std::to_string(s.state.air->rows.active_cells()) + " cells of " +
             as_length(s.dx) + ", " + std::to_string(threads) + " threads, " + lbm::name(lbm::detect_isa()) +
             "; output in " + out.string());
  if (s.bed_was_kept) log_info("the dose lies as an earlier run with the same one has left it in " + s.beds.string());
}

}  // namespace puffin::tools
