#include "cases/check_tables.hpp"

#include <stdexcept>

#include "cases/check_boundaries.hpp"
#include "cases/table_file.hpp"

namespace puffin::cases {

std::vector<Problem> table_problems(const Case& c) {
  std::vector<Problem> problems;
  const auto need = [&](const std::string& key, const std::string& file,
                        std::initializer_list<std::string_view> columns) {
    try {
      read_columns(file, columns);
    } catch (const std::invalid_argument& e) {
      problems.push_back(problem_at(c, key, key + ": " + e.what()));
    }
  };
  for (std::size_t i = 0; i < c.air.boundaries.size(); ++i)
    if (c.air.boundaries[i].profile == Profile::file)
      need("air.boundary[" + std::to_string(i) + "].profile.file", c.air.boundaries[i].profile_file,
           {"x", "y", "z", "u", "v", "w"});
  if (c.air.initial == InitialField::file) need("air.initial.file", c.air.initial_file, {"x", "y", "z", "u", "v", "w"});
  if (const auto* field = std::get_if<FieldFile>(&c.air.frozen); field && c.air.model == AirModel::frozen)
    need("air.field.file", field->file, {"x", "y", "z", "u", "v", "w"});
  if (const auto* force = std::get_if<ForceFile>(&c.air.body_force))
    need("air.body_force.file", force->file, {"time", "fx", "fy", "fz"});
  return problems;
}

}  // namespace puffin::cases
