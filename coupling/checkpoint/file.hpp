#pragma once
// A checkpoint as named sections of bytes, and as one file.
//
// File, in the machine's byte order:
//   "PUFFINCP", u32 0x01020304 (byte order), u32 format version
//   for each section: u32 length of the name, name, u64 length of the bytes, u64 XXH64 of all that of this section,
//                     the bytes, u64 XXH64 of the bytes
//   a section "end" without bytes.
// Written under a temporary name, synced, renamed, the folder synced: a file with its final name is whole unless the
// disk spoils it, and that the checksums find.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "coupling/checkpoint/bytes.hpp"

namespace puffin::coupling {

inline constexpr std::uint32_t checkpoint_format = 6;

/// A sound file, but of something else: another version, case or lattice. An older one will not do either.
class CheckpointForeign : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Section {
  std::string name;  // at most 64 characters
  std::vector<std::byte> bytes;
};

struct Checkpoint {
  std::vector<Section> sections;

  /// The section's bytes, emptied for writing (their memory is kept); the section is added if it is not there.
  std::vector<std::byte>& renew(const std::string& name);
  /// Throws CheckpointDamaged if it is not there.
  const std::vector<std::byte>& at(const std::string& name) const;
  std::size_t size() const;  // [byte]
};

/// Throws std::system_error if the disk refuses; what stood there before is then untouched.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Never takes more memory than the file is long, and refuses files longer than `longest` [byte]. Throws
/// CheckpointDamaged, CheckpointForeign (another format version or byte order), std::system_error if it cannot be read.
Checkpoint read_checkpoint(const std::filesystem::path& file, std::size_t longest);

/// The same of bytes in memory.
Checkpoint parse_checkpoint(std::span<const std::byte> bytes);

}  // namespace puffin::coupling
