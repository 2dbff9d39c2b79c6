// puffin check: configuration, geometry, stability; every problem at once, nothing is run.

#include <CLI/CLI.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "cases/check_boundaries.hpp"
#include "cases/check_places.hpp"
#include "cases/check_tables.hpp"
#include "cases/fill.hpp"
#include "cases/micromodel_file.hpp"
#include "cases/write_case.hpp"
#include "tools/puffin/arguments.hpp"
#include "tools/puffin/assessment_text.hpp"
#include "tools/puffin/case_warnings.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/stored_field.hpp"

namespace puffin::tools {
namespace {

using Problems = std::vector<cases::Problem>;

/// Adds what one stage finds to what others found, so that a user sees all of it. Any other failure waits behind them:
/// mistakes of the case come first.
template <class Stage>
void gather(Problems& problems, const Stage& stage) try {
  stage();
} catch (const cases::CaseError& e) {
  problems.insert(problems.end(), e.problems.begin(), e.problems.end());
} catch (const std::exception&) {
  if (problems.empty()) throw;
  throw cases::CaseError(std::move(problems));
}

void append(Problems& problems, Problems more) {
  problems.insert(problems.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

bool has_places(const cases::Case& c) {
  const bool outputs = !c.output.probes.empty() || !c.output.planes.empty() || !c.output.fields.empty();
  return outputs || (c.carriers && (!c.carriers->list.empty() || c.carriers->fill));
}

/// Places outside the geometry are problems, a dose that does not fit is one.
void check_places(const cases::Case& c, const cases::Surface& surface, const lbm::geometry::TriangleTree& tree,
                  Problems& problems) {
  append(problems, cases::carrier_place_problems(c, tree));
  if (c.carriers && c.carriers->fill) gather(problems, [&] { cases::dose_of(c, surface, tree); });
  if (c.air.model == cases::AirModel::none) return;
  const bool cells = c.numerics.dx || c.numerics.cells;  // a frozen field without fines needs none
  append(problems, cases::output_place_problems(c, tree, cells ? cases::cell_size(c.numerics, surface.volume) : 0.0));
}

int check_case(const CaseArguments& a) {
  const cases::Case c = a.read();
  Problems problems;
  if (c.fines && !c.fines->micromodels.empty())
    gather(problems, [&] { cases::read_micromodels(c.fines->micromodels); });
  cases::Surface surface;
  gather(problems, [&] { surface = cases::load_surface(c, true); });
  gather(problems, [&] { append(problems, cases::boundary_problems(c, surface)); });
  gather(problems, [&] { append(problems, cases::table_problems(c)); });
  if (const auto* run = std::get_if<cases::RunField>(&c.air.frozen); run && c.air.model == cases::AirModel::frozen)
    gather(problems, [&] { cases::from_file(c, "air.field", [&] { return read_stored_field(*run); }); });
  std::optional<lbm::geometry::TriangleTree> tree;
  if (has_places(c)) tree.emplace(surface.mesh);
  if (tree) gather(problems, [&] { check_places(c, surface, *tree, problems); });
  if (!problems.empty()) throw cases::CaseError(std::move(problems));
  cases::Assessment assessment = cases::assess(c, surface);
  if (tree)
    for (auto& w : cases::carrier_place_warnings(c, *tree)) assessment.warnings.push_back(std::move(w));
  warn_of_stability(c, assessment);
  for (auto& w : cases::boundary_warnings(c, surface)) assessment.warnings.push_back(std::move(w));
  for (const lbm::geometry::Defect& d : surface.defects) assessment.warnings.push_back(d.kind + ": " + d.message);
  const std::vector<std::string> assumed = cases::assumptions(c);
  if (a.json) {
    nlohmann::json j = assessment_json(c, assessment);
    j["ok"] = true;
    j["problems"] = nlohmann::json::array();
    j["assumptions"] = assumed;
    print(j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    return ok;
  }
  print(a.file.string() + ": " + c.name + ": ok");
  print_assessment(c, assessment);
  for (const std::string& text : assumed) print("assumed    " + text);
  return ok;
}

}  // namespace

namespace commands {
Command check() {
  return {"check", "configuration, geometry and stability: every problem at once, nothing is run",
          [](CLI::App& app) -> Action {
            auto a = std::make_shared<CaseArguments>();
            a->add_to(app);
            return [a] { return check_case(*a); };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
