#pragma once
// The folder of one run: made once, never over a finished run, and nothing is written outside it.

#include <filesystem>
#include <optional>
#include <string>

namespace puffin::output {

class OutputFolder {
 public:
  /// Makes the folder `out`, or runs/NAME/TIMESTAMP (local time, YYYYMMDD-HHMMSS) with the link runs/NAME/latest.
  /// - A folder with a finished run is refused, always.
  /// - A folder with an unfinished run is refused if it can be resumed and `resume` is false; one that cannot is
  ///   cleared of a run's own files and used again.
  /// - A folder with files of the same names that are not from a run is refused.
  /// - resume: the folder must hold an unfinished run with checkpoints.
  /// Throws OutputError with the remedy.
  OutputFolder(const std::optional<std::filesystem::path>& out, const std::string& name, bool resume = false);

  const std::filesystem::path& path() const { return path_; }
  /// A file inside the folder; its parent folders are made. Throws OutputError if it would lie outside.
  std::filesystem::path file(const std::filesystem::path& relative) const;
  /// Writes a small text file whole or not at all.
  void write_text(const std::filesystem::path& relative, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

/// Writes a file whole or not at all: temporary name beside it, sync, rename. Throws OutputError.
void write_whole(const std::filesystem::path& file, const std::string& text);
/// A case name as one folder name: letters, digits, '.', '-' and '_'; everything else becomes '_'.
std::string folder_name(const std::string& name);

}  // namespace puffin::output
