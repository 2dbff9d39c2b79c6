#include "tools/output/events_file.hpp"

#include "tools/output/hdf5_handle.hpp"

namespace puffin::output {
namespace {

constexpr char format[] = "puffin-events";
constexpr hsize_t chunk = 4096;  // records

Hdf5Handle compound() {
  Hdf5Handle type(H5Tcreate(H5T_COMPOUND, sizeof(EventRecord)), H5Tclose);
  const auto real = [&](const char* name, std::size_t at) { H5Tinsert(type, name, at, H5T_NATIVE_DOUBLE); };
  const auto index = [&](const char* name, std::size_t at) { H5Tinsert(type, name, at, H5T_NATIVE_INT32); };
  real("time_start", offsetof(EventRecord, time_start));
  real("time_end", offsetof(EventRecord, time_end));
  index("a", offsetof(EventRecord, a));
  index("b", offsetof(EventRecord, b));
  index("triangle", offsetof(EventRecord, triangle));
  real("normal_speed", offsetof(EventRecord, normal_speed));
  real("tangential_speed", offsetof(EventRecord, tangential_speed));
  real("energy", offsetof(EventRecord, energy));
  real("max_force", offsetof(EventRecord, max_force));
  real("max_overlap", offsetof(EventRecord, max_overlap));
  real("detached", offsetof(EventRecord, detached));
  real("attached", offsetof(EventRecord, attached));
  real("angle", offsetof(EventRecord, angle));
  real("order", offsetof(EventRecord, order));
  real("drag_a", offsetof(EventRecord, drag_a));
  real("drag_b", offsetof(EventRecord, drag_b));
  index("a_loses", offsetof(EventRecord, a_loses));
  index("b_loses", offsetof(EventRecord, b_loses));
  return type;
}

std::vector<EventRecord> read_all(const Hdf5File& file, hid_t dataset) {
  std::vector<EventRecord> records(file.stored_length(dataset));
  const Hdf5Handle type = compound();
  if (!records.empty()) {
    file.good(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, records.data()), "read");
  }
  return records;
}

}  // namespace

struct EventsFile::Impl {
  Hdf5File file;
  Hdf5Handle type;  // in memory
  Hdf5Handle dataset;
  std::vector<EventRecord> collected;
  std::int64_t written = 0;

  void write() {
    file.append(dataset, type, collected.data(), collected.size());
    written += static_cast<std::int64_t>(collected.size());
    collected.clear();
  }
};

EventsFile::EventsFile(const std::filesystem::path& path) {
  impl_ = std::make_unique<Impl>(Impl{Hdf5File(path, format), compound(), {}, {}, 0});
  Impl& d = *impl_;
  const Hdf5Quiet quiet;
  // In the file without the padding that the compiler may put between the members.
  const Hdf5Handle packed(H5Tcopy(d.type), H5Tclose);
  H5Tpack(packed);
  d.dataset = d.file.create_growing(d.file.id(), "events", packed, chunk);
  d.file.flush();
}

EventsFile::~EventsFile() {
  try {
    if (impl_) flush();
  } catch (const OutputError&) {
    // A destructor cannot report; whoever needs to know calls flush() first.
  }
}
EventsFile::EventsFile(EventsFile&&) noexcept = default;
EventsFile& EventsFile::operator=(EventsFile&&) noexcept = default;

void EventsFile::append(std::span<const EventRecord> records) {
  impl_->collected.insert(impl_->collected.end(), records.begin(), records.end());
  if (impl_->collected.size() >= chunk) impl_->write();
}

void EventsFile::flush() {
  impl_->write();
  impl_->file.flush();
}

std::int64_t EventsFile::size() const { return impl_->written + static_cast<std::int64_t>(impl_->collected.size()); }

std::vector<EventRecord> read_events(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::reading(path, format);
  const Hdf5Quiet quiet;
  const Hdf5Handle dataset(file.good(H5Dopen2(file.id(), "events", H5P_DEFAULT), "find /events in"), H5Dclose);
  return read_all(file, dataset);
}

}  // namespace puffin::output
