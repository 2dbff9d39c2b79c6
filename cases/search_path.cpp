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

}  // namespace puffin::cases
