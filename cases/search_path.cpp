#include "cases/search_path.hpp"

#include <array>

namespace puffin::cases {
namespace {

/// share/puffin of the installation that the program runs from.
std::filesystem::path installed() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / "../share/puffin").lexically_normal();
}

}  // namespace

std::span<const std::string> micromodel_directories() {
  static const std::array<std::string, 2> folders{(installed() / "micromodels").string(),
                                                  std::string(PUFFIN_CASES_DIR) + "/micromodels"};
  return folders;
}

std::filesystem::path verification_directory() {
  std::error_code error;
  const std::filesystem::path there = installed() / "verify";
  return std::filesystem::is_directory(there, error) ? there : std::filesystem::path(PUFFIN_CASES_DIR) / "verify";
}

}  // namespace puffin::cases
