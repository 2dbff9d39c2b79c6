#include "cases/bed_store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>
#include <type_traits>

#include "coupling/checkpoint/hash.hpp"

namespace puffin::cases {
namespace {

/// Bytes, one value behind the other; only of types without padding.
class Bytes {
 public:
  void add(double value) { append(&value, sizeof value); }
  void add(std::uint64_t value) { append(&value, sizeof value); }
  void add(const Eigen::Vector3d& v) {
    for (int k = 0; k < 3; ++k) add(v[k]);
  }
  std::uint64_t hash() const { return coupling::xxh64(std::as_bytes(std::span(all_))); }
  const std::vector<char>& all() const { return all_; }

 private:
  void append(const void* data, std::size_t size) {
    const char* begin = static_cast<const char*>(data);
    all_.insert(all_.end(), begin, begin + size);
  }
  std::vector<char> all_;
};

void add_contact(const dem::Surfaces& surfaces, Bytes& bytes) {
  std::visit(
      [&](const auto& contact) {
        bytes.add(contact.restitution);
        bytes.add(contact.rolling_friction);
        bytes.add(std::uint64_t{contact.friction.index()});
        if (const auto* constant = std::get_if<dem::ConstantFriction>(&contact.friction)) {
          bytes.add(constant->coefficient);
        } else if (const auto* f = std::get_if<dem::SpeedFriction>(&contact.friction)) {
          for (const double value : {f->stick, f->slip, f->limit, f->slip_speed, f->limit_speed}) bytes.add(value);
        }
      },
      surfaces.contact);
}

/// Held while it lives; another process that wants it waits.
class Lock {
 public:
  explicit Lock(const std::filesystem::path& file)
      : file_(open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644)) {
    if (file_ < 0) throw std::system_error(errno, std::generic_category(), "cannot write " + file.string());
    while (flock(file_, LOCK_EX) != 0)
      if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "cannot lock " + file.string());
  }
  ~Lock() { close(file_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int file_;
};

constexpr std::uint64_t mark = 0x31444542'46465550;  // "PUFFBED1"

// mark, key, number of carriers, time, whether at rest, the positions, XXH64 of all before.
Bytes written(const SettledBed& bed, std::uint64_t key) {
  Bytes bytes;
  bytes.add(mark);
  bytes.add(key);
  bytes.add(std::uint64_t{bed.positions.size()});
  bytes.add(bed.time);
  bytes.add(std::uint64_t{bed.at_rest});
  for (const auto& position : bed.positions) bytes.add(position);
  bytes.add(bytes.hash());
  return bytes;
}

std::optional<SettledBed> read(const std::filesystem::path& file, std::uint64_t key, std::size_t carriers) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<double> words(5 + 3 * carriers + 1);
  static_assert(sizeof(double) == sizeof(std::uint64_t));
  const auto size = static_cast<std::streamsize>(words.size() * sizeof(double));
  if (!stream.read(reinterpret_cast<char*>(words.data()), size) || stream.peek() != std::ifstream::traits_type::eof())
    return {};
  const auto whole = [&](std::size_t n) {
    std::uint64_t value;
    std::memcpy(&value, &words[n], sizeof value);
    return value;
  };
  const std::span content(words.data(), words.size() - 1);
  if (whole(0) != mark || whole(1) != key || whole(2) != carriers ||
      whole(words.size() - 1) != coupling::xxh64(std::as_bytes(content)))
    return {};
  SettledBed bed;
  bed.time = words[3];
  bed.at_rest = whole(4) != 0;
  for (std::size_t n = 0; n < carriers; ++n) bed.positions.emplace_back(&words[5 + 3 * n]);
  return bed;
}

}  // namespace

std::uint64_t bed_key(const dem::Models& models, const lbm::geometry::TriangleMesh& mesh,
                      const std::vector<dem::Carrier>& carriers) {
  Bytes bytes;
  bytes.add(models.gravity);
  bytes.add(std::uint64_t{models.rotation});
  add_contact(models.carrier, bytes);
  add_contact(models.wall, bytes);
  for (const auto& c : carriers) {
    bytes.add(c.position);
    bytes.add(c.radius);
    bytes.add(c.mass);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) bytes.add(mesh.corner(static_cast<int>(t), k));
  return bytes.hash();
}

SettledBed stored_bed(const std::filesystem::path& store, std::uint64_t key, std::size_t carriers,
                      const std::function<SettledBed()>& settle, bool& kept) {
  std::filesystem::create_directories(store);
  char name[32];
  std::snprintf(name, sizeof name, "%016llx", static_cast<unsigned long long>(key));
  const std::filesystem::path file = store / (std::string(name) + ".bed");
  const Lock lock(store / (std::string(name) + ".lock"));
  if (auto bed = read(file, key, carriers)) {
    kept = true;
    return *bed;
  }
  kept = false;
  SettledBed bed = settle();
  const Bytes bytes = written(bed, key);
  const std::filesystem::path part = file.string() + ".part";
  std::filesystem::remove(part);  // what a killed program left; or a link, which is not followed
  std::ofstream stream(part, std::ios::binary);
  stream.write(bytes.all().data(), static_cast<std::streamsize>(bytes.all().size()));
  stream.close();
  if (!stream) throw std::system_error(errno, std::generic_category(), "cannot write " + part.string());
  std::filesystem::rename(part, file);
  return bed;
}

}  // namespace puffin::cases
