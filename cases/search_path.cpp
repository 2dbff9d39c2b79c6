#include "cases/search_path.hpp"

#include <array>

namespace puffin::cases {
namespace {

/// share/puffin/cases of the installation that the program runs from.
std::filesystem::path installed() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / "../share/puffin/cases").lexically_normal();
}

/// The folder of that name in the installation, or, where there is none, in cases/ of the source tree.
std::filesystem::path folder_of(const std::string& name) {
  std::error_code error;
  const std::filesystem::path there = installed() / name;
  return std::filesystem::is_directory(there, error) ? there : std::filesystem::path(PUFFIN_CASES_DIR) / name;
}

}  // namespace

std::span<const std::string> micromodel_directories() {
  static const std::array<std::string, 2> folders{(installed() / "micromodels").string(),
                                                  std::string(PUFFIN_CASES_DIR) + "/micromodels"};
  return folders;
}

std::filesystem::path verification_directory() { return folder_of("verify"); }

std::filesystem::path bench_directory() { return folder_of("bench"); }

std::filesystem::path stability_directory() {
  std::error_code error;
  const std::filesystem::path there = installed() / "stability";
  return std::filesystem::is_directory(there, error) ? there : std::filesystem::path(PUFFIN_CASES_DIR) / "stability";
}

std::filesystem::path found_micromodels(const std::filesystem::path& file) {
  std::error_code error;
  if (file.is_absolute() || std::filesystem::exists(file, error)) return file;
  for (const std::string& folder : micromodel_directories())
    if (const auto found = folder / file; std::filesystem::exists(found, error)) return found;
  return file;
}

}  // namespace puffin::cases
