#include "coupling/checkpoint/file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "coupling/checkpoint/hash.hpp"

namespace puffin::coupling {

namespace {

namespace fs = std::filesystem;

constexpr char magic[] = "PUFFINCP";
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::size_t longest_name = 64;
const std::string last_section = "end";

[[noreturn]] void refuse(const fs::path& file, const char* what, int error) {
  throw std::system_error(error, std::generic_category(),
                          std::string("cannot ") + what + " the checkpoint " + file.string() +
                              "; free some space, or choose a folder that can be written with --out");
}

/// An open file that ends as a whole one under its own name, or not at all.
class WholeFile {
 public:
  explicit WholeFile(const fs::path& file) : file_(file), temporary_(file.string() + ".part") {
    unlink(temporary_.c_str());  // what a killed program left; or a link, which is not followed
    descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (descriptor_ < 0) refuse(file_, "write", errno);
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  ~WholeFile() {
    if (descriptor_ < 0) return;
    close(descriptor_);
    unlink(temporary_.c_str());
  }
  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), std::min<std::size_t>(bytes.size(), 1U << 30));
      if (count < 0 && errno != EINTR) refuse(file_, "write", errno);
      if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
  }
  void finish() {
    if (fsync(descriptor_) != 0 && errno != EINVAL) refuse(file_, "write", errno);
    const int closed = close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 || std::rename(temporary_.c_str(), file_.c_str()) != 0) {
      const int error = errno;
      unlink(temporary_.c_str());
      refuse(file_, "write", error);
    }
    // The new name must survive a power failure too. Not every file system can do that; then the rename has to do.
    const int folder = open(file_.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
      fsync(folder);
      close(folder);
    }
  }

 private:
  fs::path file_, temporary_;
  int descriptor_ = -1;
};

std::vector<std::byte> section_head(const std::string& name, std::size_t size) {
  std::vector<std::byte> head;
  ByteWriter writer(head);
  writer(static_cast<std::uint32_t>(name.size()));
  for (const char c : name) writer(c);
  writer(static_cast<std::uint64_t>(size));
  writer(xxh64(head));
  return head;
}

/// Takes values off the front of bytes.
class Front {
 public:
  explicit Front(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::span<const std::byte> take(std::uint64_t count) {
    if (count > bytes_.size()) throw CheckpointDamaged("it ends too early");
    const auto front = bytes_.first(static_cast<std::size_t>(count));
    bytes_ = bytes_.subspan(static_cast<std::size_t>(count));
    return front;
  }
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  bool empty() const { return bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace

std::vector<std::byte>& Checkpoint::renew(const std::string& name) {
  for (Section& section : sections)
    if (section.name == name) {
      section.bytes.clear();
      return section.bytes;
    }
  return sections.emplace_back(Section{name, {}}).bytes;
}

const std::vector<std::byte>& Checkpoint::at(const std::string& name) const {
  for (const Section& section : sections)
    if (section.name == name) return section.bytes;
  throw CheckpointDamaged("its section '" + name + "' is missing");
}

std::size_t Checkpoint::size() const {
  std::size_t sum = 0;
  for (const Section& section : sections) sum += section.bytes.size();
  return sum;
}

void write_checkpoint(const fs::path& file, const Checkpoint& checkpoint) {
  WholeFile whole(file);
  std::vector<std::byte> head;
  ByteWriter writer(head);
  for (const char c : std::string(magic)) writer(c);
  writer(byte_order, checkpoint_format);
  whole.write(head);
  for (const Section& section : checkpoint.sections) {
    whole.write(section_head(section.name, section.bytes.size()));
    whole.write(section.bytes);
    const std::uint64_t sum = xxh64(section.bytes);
    whole.write(std::as_bytes(std::span(&sum, 1)));
  }
  whole.write(section_head(last_section, 0));
  whole.finish();
}

Checkpoint parse_checkpoint(std::span<const std::byte> bytes) {
  Front front(bytes);
  const auto mark = front.take(sizeof magic - 1);
  if (std::memcmp(mark.data(), magic, sizeof magic - 1) != 0) throw CheckpointDamaged("it does not begin as one");
  if (front.number<std::uint32_t>() != byte_order)
    throw CheckpointForeign("it was written by a machine of another byte order");
  if (const auto version = front.number<std::uint32_t>(); version != checkpoint_format)
    throw CheckpointForeign("it has format " + std::to_string(version) + ", this program reads format " +
                            std::to_string(checkpoint_format) + "; finish the run with the program that began it");
  Checkpoint checkpoint;
  for (;;) {
    const auto length = front.number<std::uint32_t>();
    if (length > longest_name) throw CheckpointDamaged("the name of a section is too long");
    const auto text = front.take(length);
    const std::string name(reinterpret_cast<const char*>(text.data()), text.size());
    const auto size = front.number<std::uint64_t>();
    std::vector<std::byte> head = section_head(name, static_cast<std::size_t>(size));
    std::uint64_t sum = 0;
    std::memcpy(&sum, head.data() + head.size() - sizeof sum, sizeof sum);
    if (front.number<std::uint64_t>() != sum) throw CheckpointDamaged("the head of a section is damaged");
    if (name == last_section) break;
    const auto content = front.take(size);
    if (front.number<std::uint64_t>() != xxh64(content))
      throw CheckpointDamaged("its section '" + name + "' has a wrong checksum");
    checkpoint.sections.push_back({name, {content.begin(), content.end()}});
  }
  if (!front.empty()) throw CheckpointDamaged("something follows its end");
  return checkpoint;
}

Checkpoint read_checkpoint(const fs::path& file, std::size_t longest) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw std::system_error(error, "cannot read the checkpoint " + file.string());
  if (size > longest)
    throw CheckpointDamaged("it has " + std::to_string(size) + " bytes; this case needs less than " +
                            std::to_string(longest));
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream || static_cast<std::uintmax_t>(stream.gcount()) != size)
    throw CheckpointDamaged("it cannot be read to its end");
  return parse_checkpoint(bytes);
}

}  // namespace puffin::coupling
