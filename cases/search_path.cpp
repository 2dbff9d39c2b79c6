#include "cases/search_path.hpp"

#include <array>
#include <filesystem>

namespace puffin::cases {

std::span<const std::string> micromodel_directories() {
  static const std::array<std::string, 2> folders = [] {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    return std::array<std::string, 2>{
        (program.parent_path() / "../share/puffin/micromodels").lexically_normal().string(),
        std::string(PUFFIN_CASES_DIR) + "/micromodels"};
  }();
  return folders;
}

std::filesystem::path found_micromodels(const std::filesystem::path& file) {
  std::error_code error;
  if (file.is_absolute() || std::filesystem::exists(file, error)) return file;
  for (const std::string& folder : micromodel_directories())
    if (const auto found = folder / file; std::filesystem::exists(found, error)) return found;
  return file;
}

}  // namespace puffin::cases
