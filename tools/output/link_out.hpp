#pragma once
// A folder that was got from elsewhere may hold links; none of them may lead what is written out of it.

#include <filesystem>

namespace puffin::output {

/// Throws OutputError, with the remedy, if a link within `folder` leads `file` out of it, or leads nowhere. The file
/// need not be there yet.
void refuse_link_out(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace puffin::output
