#include "tools/output/link_out.hpp"

#include "tools/output/output_error.hpp"

namespace puffin::output {

namespace fs = std::filesystem;

void refuse_link_out(const fs::path& folder, const fs::path& file) {
  fs::path at = folder;
  for (const fs::path& part : file.lexically_relative(folder)) {
    at /= part;
    std::error_code none, error;  // none: there is nothing yet
    if (!fs::is_symlink(fs::symlink_status(at, none))) continue;
    const fs::path real = fs::canonical(at, error);  // an error: a link that leads nowhere would make its file there
    const fs::path rest = error ? fs::path() : real.lexically_relative(fs::canonical(folder));
    if (rest.empty() || *rest.begin() == "..")
      throw OutputError("refused to write " + file.string() + ": the link " + at.string() +
                        " leads it out of the folder " + folder.string() + "; remove the link");
  }
}

}  // namespace puffin::output
