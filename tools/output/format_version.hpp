#pragma once
// The number of the format of everything that a run writes (docs/formats.md). It changes when a reader of the old files
// would misread the new ones; what is only added changes nothing.

#include <string>

#include "tools/output/output_error.hpp"

namespace puffin::output {

inline constexpr int format_version = 1;

/// Throws OutputError unless this program reads that format.
inline void check_format_version(const std::string& file, int version) {
  if (version == format_version) return;
  throw OutputError(file + " has format " + std::to_string(version) + ", this program reads format " +
                    std::to_string(format_version) + "; take the Puffin that wrote it");
}

}  // namespace puffin::output
