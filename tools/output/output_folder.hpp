#pragma once
// The folder of one run: made once, never over a finished run, and nothing is written outside it.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace puffin::output {

class OutputFolder {
 public:
  /// Makes the folder `out`, or runs/NAME/TIMESTAMP (local time, YYYYMMDD-HHMMSS) with the link runs/NAME/latest.
  /// - A folder with a finished run is refused, always.
  /// - A folder with an unfinished run is refused if it can be resumed and `resume` is false; one that cannot is
  ///   cleared of a run's own files and used again.
  /// - A folder with files of the same names that are not from a run is refused, and so is that of a study.
  /// - A folder in which another process runs is refused, as long as that lives; resume waits some seconds for one that
  ///   may be writing its last checkpoint. On disks without flock(2), as NFS may be, nobody is kept apart.
  /// - resume: the folder must hold an unfinished run. If that was killed before its first checkpoint, the folder is
  ///   cleared of the run's own files: resumed() is then false, and the run begins anew.
  /// Throws OutputError with the remedy.
  OutputFolder(const std::optional<std::filesystem::path>& out, const std::string& name, bool resume = false);

  const std::filesystem::path& path() const { return path_; }
  /// True if there are checkpoints to go on from.
  bool resumed() const { return resumed_; }
  /// A file inside the folder; its parent folders are made. Throws OutputError if it would lie outside, or if the
  /// folder itself has vanished.
  std::filesystem::path file(const std::filesystem::path& relative) const;
  /// Writes a small text file whole or not at all.
  void write_text(const std::filesystem::path& relative, const std::string& text) const;

 private:
  void hold(bool patient);

  std::filesystem::path path_;
  std::shared_ptr<const int> lock_;  // a descriptor of the folder, locked while this object lives
  bool resumed_ = false;
};

/// The checkpoints of a run's folder, newest first.
std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& run);
/// Name of the checkpoint with a number, relative to the run's folder.
std::filesystem::path checkpoint_name(std::int64_t number);
std::int64_t checkpoint_number(const std::filesystem::path& file);

/// Writes a file whole or not at all: temporary name beside it, sync, rename. Throws OutputError.
void write_whole(const std::filesystem::path& file, const std::string& text);
/// The same without waiting for the disk: readers find it whole, a power failure may still take it until sync_file().
void replace_whole(const std::filesystem::path& file, const std::string& text);
/// The bytes of a file; "" if it cannot be read.
std::string read_whole(const std::filesystem::path& file);
/// Cuts a file behind its first `bytes`. Throws OutputError if it is shorter or cannot be cut.
void keep_first(const std::filesystem::path& file, std::uint64_t bytes);
/// What other programs and a power failure will see is what was written. Throws OutputError.
void sync_file(const std::filesystem::path& file);
/// Gives a temporary file its final name, synced. Throws OutputError.
void finish_file(const std::filesystem::path& temporary, const std::filesystem::path& file);
/// A case name as one folder name: letters, digits, '.', '-' and '_'; everything else becomes '_'.
std::string folder_name(const std::string& name);

}  // namespace puffin::output
