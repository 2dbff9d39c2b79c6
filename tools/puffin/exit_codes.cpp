#include "tools/puffin/exit_codes.hpp"

#include <new>
#include <system_error>

#include "cases/case_error.hpp"
#include "cases/generators/generators.hpp"
#include "cases/room.hpp"
#include "coupling/checkpoint/file.hpp"
#include "coupling/state.hpp"
#include "lbm/geometry/stl.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/render.hpp"

namespace puffin::tools {
namespace {

template <class E>
bool is(const std::exception& error) {
  return dynamic_cast<const E*>(&error) != nullptr;
}

}  // namespace

ExitCode exit_code(const std::exception& error) {
  if (is<UsageError>(error) || is<output::NotStored>(error)) return usage;
  if (is<cases::CaseError>(error)) return case_invalid;
  if (is<lbm::geometry::StlFileError>(error)) return input_output;
  if (is<lbm::geometry::GeometryError>(error) || is<lbm::geometry::StlError>(error)) return geometry_invalid;
  if (is<cases::GeneratorError>(error)) return geometry_invalid;
  if (is<coupling::Diverged>(error)) return diverged;
  if (is<ResourceError>(error) || is<cases::TooLarge>(error) || is<std::bad_alloc>(error)) return resources;
  if (is<coupling::CheckpointForeign>(error) || is<coupling::CheckpointDamaged>(error)) return input_output;
  if (is<output::OutputError>(error) || is<std::system_error>(error)) return input_output;
  return internal_error;
}

}  // namespace puffin::tools
