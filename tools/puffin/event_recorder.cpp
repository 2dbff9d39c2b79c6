#include "tools/puffin/event_recorder.hpp"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "dem/open_contacts.hpp"
#include "tools/puffin/replay_record.hpp"

namespace puffin::tools {
namespace {

constexpr const char* journal_name = "checkpoints/events.journal";

void add_fines(const OpenContact& contact, output::EventRecord& r) {
  r.detached = contact.taken.air + contact.taken.wall;
  r.attached = contact.taken.wall;
  r.angle = contact.angle;
  r.order = static_cast<double>(contact.order);
  r.drag_a = contact.mark.drag_a;
  r.drag_b = contact.mark.drag_b;
  r.a_loses = contact.mark.a_loses;
  r.b_loses = contact.mark.b_loses;
}

/// What the log holds of a contact; the fines it moved are in `moved` if it moved any.
output::EventRecord record_of(const dem::ContactEnded& c, const MovedFines& moved) {
  output::EventRecord r;
  r.time_start = c.time_start;
  r.time_end = c.time_end;
  r.a = static_cast<std::int32_t>(c.a);
  r.b = static_cast<std::int32_t>(c.b);
  r.triangle = c.triangle;
  r.normal_speed = c.normal_speed;
  r.tangential_speed = c.tangential_speed;
  r.energy = c.energy;
  r.max_force = c.max_force;
  r.max_overlap = c.max_overlap;
  if (const auto found = moved.find({c.a, c.b, c.triangle, c.time_start}); found != moved.end())
    add_fines(found->second, r);
  return r;
}

}  // namespace

EventRecorder::EventRecorder(const output::OutputFolder& folder, const RecorderState* resume) : folder_(folder) {
  journal_.emplace(folder.file(journal_name), resume ? std::optional(resume->events) : std::nullopt);
  if (!resume) return;
  moved_ = resume->moved;
  begun_ = resume->begun;
}

void EventRecorder::take(const cases::Simulation& s) {
  const auto& events = s.state.events;
  const auto& taken = s.state.release.taken();
  const auto& marks = s.state.release.marks();
  for (std::size_t n = 0; n < events.begun.size() && n < taken.size(); ++n) {
    const auto& c = events.begun[n];
    moved_[{c.a, c.b, c.triangle, c.time}] = {taken[n], marks[n], coupling::angle_to_surface(c), begun_++};
  }
  std::vector<output::EventRecord> records;
  for (const dem::ContactEnded& c : events.ended) {
    records.push_back(record_of(c, moved_));
    moved_.erase({c.a, c.b, c.triangle, c.time_start});
  }
  if (!records.empty()) journal_->append(records);
}

void EventRecorder::save(RecorderState& state) const {
  state.moved = moved_;
  state.begun = begun_;
  state.events = journal_->size();
}

void EventRecorder::sync() { journal_->sync(); }

std::vector<output::EventRecord> EventRecorder::open_contacts(const cases::Simulation& s) const {
  std::vector<output::EventRecord> records;
  for (const auto& c : dem::open_contacts(s.state.carriers, s.state.time)) records.push_back(record_of(c, moved_));
  std::sort(records.begin(), records.end(), [](const output::EventRecord& x, const output::EventRecord& y) {
    return std::tie(x.time_start, x.a, x.b, x.triangle) < std::tie(y.time_start, y.a, y.b, y.triangle);
  });
  return records;
}

void EventRecorder::finish(const cases::Simulation& s) {
  const auto tables = replay_tables(s);
  journal_->write_events(folder_.file("events.h5"), open_contacts(s), tables ? &*tables : nullptr);
}

void EventRecorder::forget_journal() {
  journal_.reset();
  std::error_code error;
  std::filesystem::remove(folder_.file(journal_name), error);
}

}  // namespace puffin::tools
