#include "tools/output/events_journal.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t record = sizeof(EventRecord);

std::string head() {
  std::string text = "puffin events journal 1, records of " + std::to_string(record) + " bytes";
  text.resize(63, ' ');
  return text + '\n';
}

}  // namespace

EventsJournal::EventsJournal(fs::path file, std::optional<std::int64_t> keep) : file_(std::move(file)) {
  const std::string wanted = head();
  if (keep) {
    std::string found(wanted.size(), ' ');
    std::ifstream(file_, std::ios::binary).read(found.data(), static_cast<std::streamsize>(found.size()));
    if (!fs::exists(file_))
      throw OutputError(file_.string() +
                        ", the record of the contacts so far, is missing, so the run cannot be resumed; "
                        "start it anew");
    if (found != wanted)
      throw OutputError(file_.string() + " is not of this version, so the run cannot be resumed; start it anew");
    size_ = *keep;
    keep_first(file_, wanted.size() + record * static_cast<std::size_t>(size_));
  } else {
    write_whole(file_, wanted);
  }
  stream_.open(file_, std::ios::app | std::ios::binary);
  check();
}

void EventsJournal::append(std::span<const EventRecord> records) {
  stream_.write(reinterpret_cast<const char*>(records.data()), static_cast<std::streamsize>(records.size_bytes()));
  size_ += static_cast<std::int64_t>(records.size());
  check();
}

void EventsJournal::flush() {
  stream_.flush();
  check();
}

void EventsJournal::sync() {
  flush();
  sync_file(file_);
}

void EventsJournal::write_events(const fs::path& events, std::span<const EventRecord> more,
                                 const ReplayTables* tables) {
  flush();
  const fs::path temporary = events.string() + ".part";
  try {
    {
      EventsFile target(temporary);
      std::ifstream source(file_, std::ios::binary);
      source.seekg(static_cast<std::streamoff>(head().size()));
      std::vector<EventRecord> block(4096);
      for (std::int64_t left = size_; left > 0;) {
        block.resize(static_cast<std::size_t>(std::min<std::int64_t>(left, 4096)));
        source.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(block.size() * record));
        if (!source) throw OutputError("cannot read " + file_.string() + " to its end");
        target.append(block);
        left -= static_cast<std::int64_t>(block.size());
      }
      target.append(more);
      target.flush();
    }
    if (tables) write_replay_tables(temporary, *tables);
    finish_file(temporary, events);
  } catch (const OutputError&) {
    std::error_code error;
    fs::remove(temporary, error);
    throw;
  }
}

void EventsJournal::check() const {
  if (!stream_) {
    throw OutputError("cannot write " + file_.string() + ": " + std::strerror(errno) +
                      "; free some space or choose another folder with --out");
  }
}

}  // namespace puffin::output
