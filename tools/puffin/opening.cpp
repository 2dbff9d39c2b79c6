#include "tools/puffin/opening.hpp"

#include <stdexcept>

#include "cases/case_error.hpp"
#include "tools/puffin/available_memory.hpp"
#include "tools/puffin/stored_field.hpp"

namespace puffin::tools {

std::unique_ptr<cases::Simulation> built(const cases::Case& c, const std::filesystem::path& case_file,
                                         const std::filesystem::path& beds) try {
  return cases::build(c, read_stored_field, available_memory(), beds);
} catch (const std::invalid_argument& e) {
  throw cases::CaseError({{case_file.string(), 0, 0, "", e.what()}});
}

}  // namespace puffin::tools
