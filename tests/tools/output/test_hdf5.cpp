#include <gtest/gtest.h>
#include <hdf5.h>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/events_file.hpp"
#include "tools/output/events_journal.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/stats_file.hpp"

namespace puffin::output {
namespace {

/// A record whose members all differ, so that a swapped pair shows.
EventRecord event(int i) {
  return {.time_start = 0.001 * i,
          .time_end = 0.001 * i + 1e-5,
          .a = 3 * i,
          .b = i % 2 ? -1 : 3 * i + 1,
          .triangle = i % 2 ? 3 * i + 2 : -1,
          .normal_speed = 1.5 + i,
          .tangential_speed = 2.5 + i,
          .energy = 1e-10 * (i + 1),
          .max_force = 1e-3 * (i + 1),
          .max_overlap = 1e-7 * (i + 1),
          .detached = 10.0 + i,
          .attached = 0.25 * i};
}

void expect_same(const EventRecord& a, const EventRecord& b) {
  EXPECT_EQ(a.time_start, b.time_start);
  EXPECT_EQ(a.time_end, b.time_end);
  EXPECT_EQ(a.a, b.a);
  EXPECT_EQ(a.b, b.b);
  EXPECT_EQ(a.triangle, b.triangle);
  EXPECT_EQ(a.normal_speed, b.normal_speed);
  EXPECT_EQ(a.tangential_speed, b.tangential_speed);
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.max_force, b.max_force);
  EXPECT_EQ(a.max_overlap, b.max_overlap);
  EXPECT_EQ(a.detached, b.detached);
  EXPECT_EQ(a.attached, b.attached);
}

TEST(Events, ReadBackInOrderWithEveryMember) {
  const Scratch folder;
  constexpr int n = 10000;  // more than two chunks, so that blocks are joined
  {
    EventsFile file(folder / "events.h5");
    for (int i = 0; i < n; ++i) file.append(std::vector<EventRecord>{event(i)});
    EXPECT_EQ(file.size(), n);
  }
  const std::vector<EventRecord> back = read_events(folder / "events.h5");
  ASSERT_EQ(back.size(), static_cast<std::size_t>(n));
  for (const int i : {0, 1, 4095, 4096, n - 1}) expect_same(back[i], event(i));
}

/// One member of the first record, by its name in the file, as another program would read it.
double member(const std::filesystem::path& file, const char* name) {
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(id, "/events", H5P_DEFAULT);
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(double));
  H5Tinsert(type, name, 0, H5T_NATIVE_DOUBLE);
  double value = -999;
  EXPECT_GE(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value), 0) << name;
  H5Tclose(type);
  H5Dclose(dataset);
  H5Fclose(id);
  return value;
}

TEST(Events, OtherProgramsFindEveryMemberUnderItsName) {
  const Scratch folder;
  EventRecord e{.time_start = 1,
                .time_end = 2,
                .a = 3,
                .b = 4,
                .triangle = 5,
                .normal_speed = 6,
                .tangential_speed = 7,
                .energy = 8,
                .max_force = 9,
                .max_overlap = 10,
                .detached = 11,
                .attached = 12};
  { EventsFile(folder / "events.h5").append({&e, 1}); }
  int expected = 1;
  for (const char* name : {"time_start", "time_end", "a", "b", "triangle", "normal_speed", "tangential_speed", "energy",
                           "max_force", "max_overlap", "detached", "attached"}) {
    EXPECT_EQ(member(folder / "events.h5", name), expected++) << name;
  }
}

TEST(Events, AnEmptyFileReadsBackEmpty) {
  const Scratch folder;
  { EventsFile file(folder / "events.h5"); }
  EXPECT_TRUE(read_events(folder / "events.h5").empty());
}

TEST(EventsJournal, BecomesTheFileOfAnUninterruptedRun) {
  const Scratch folder;
  constexpr int n = 10000;
  {
    EventsJournal journal(folder / "events.journal");
    for (int i = 0; i < n; ++i) journal.append(std::vector<EventRecord>{event(i)});
    EXPECT_EQ(journal.size(), n);
    journal.write_events(folder / "one.h5", std::vector<EventRecord>{event(77)});
  }
  const std::vector<EventRecord> back = read_events(folder / "one.h5");
  ASSERT_EQ(back.size(), static_cast<std::size_t>(n) + 1);
  for (const int i : {0, 4095, 4096, n - 1}) expect_same(back[i], event(i));
  expect_same(back[n], event(77));
  // Killed in the middle of a record, resumed at an earlier one.
  std::ofstream(folder / "events.journal", std::ios::app) << "torn";
  EventsJournal journal(folder / "events.journal", 6000);
  for (int i = 6000; i < n; ++i) journal.append(std::vector<EventRecord>{event(i)});
  journal.write_events(folder / "two.h5", std::vector<EventRecord>{event(77)});
  EXPECT_TRUE(text_of(folder / "one.h5") == text_of(folder / "two.h5"));
}

TEST(EventsJournal, ALinkInPlaceOfTheTemporaryFileIsReplacedAndNotFollowed) {
  const Scratch folder;
  std::filesystem::create_directory(folder / "run");
  std::ofstream(folder / "mine") << "mine";
  std::filesystem::create_symlink(folder / "mine", folder / "run" / "events.h5.part");
  EventsJournal(folder / "run" / "events.journal")
      .write_events(folder / "run" / "events.h5", std::vector<EventRecord>{event(1)});
  EXPECT_EQ(read_events(folder / "run" / "events.h5").size(), 1U);
  EXPECT_EQ(text_of(folder / "mine"), "mine");
}

TEST(EventsJournal, OneThatIsTooShortOrForeignIsAnOutputError) {
  const Scratch folder;
  { EventsJournal(folder / "events.journal").append(std::vector<EventRecord>{event(1)}); }
  EXPECT_THROW(EventsJournal(folder / "events.journal", 2), OutputError);
  std::ofstream(folder / "other") << "something of another program that is long enough to be read";
  EXPECT_THROW(EventsJournal(folder / "other", 0), OutputError);
  EXPECT_THROW(EventsJournal("/proc/events.journal"), OutputError);
}

TEST(EventsJournal, AFullDiskIsAnOutputErrorAndLeavesTheFileBefore) {
  const Scratch folder;
  EventsJournal journal(folder / "events.journal");
  journal.append(std::vector<EventRecord>{event(1)});
  journal.write_events(folder / "events.h5", {});
  const std::string before = text_of(folder / "events.h5");
  const std::vector<EventRecord> some(2000, event(3));
  journal.append(some);
  journal.flush();
  const FullDisk full(1000);
  EXPECT_THROW(journal.write_events(folder / "events.h5", {}), OutputError);
  EXPECT_TRUE(text_of(folder / "events.h5") == before);
  EXPECT_THROW(
      {
        journal.append(some);
        journal.flush();
      },
      OutputError);
}

TEST(Events, WhatIsFlushedCanBeReadBeforeTheFileIsClosed) {
  const Scratch folder;
  EventsFile file(folder / "events.h5");
  file.append(std::vector<EventRecord>{event(1), event(2)});
  file.flush();
  std::filesystem::copy_file(folder / "events.h5", folder / "copy.h5");  // what a kill would leave
  EXPECT_EQ(read_events(folder / "copy.h5").size(), 2u);
}

TEST(Stats, ColumnsReadBack) {
  const Scratch folder;
  {
    StatsFile file(folder / "stats.h5", {{"time", "s"}, {"flow_rate", "m^3/s"}});
    for (int i = 0; i < 3000; ++i) file.append(std::vector<double>{0.1 * i, 1.0 / (i + 1)});
  }
  const std::vector<double> rate = read_stats(folder / "stats.h5", "flow_rate");
  ASSERT_EQ(rate.size(), 3000u);
  EXPECT_EQ(rate[2999], 1.0 / 3000);
  EXPECT_EQ(stats_names(folder / "stats.h5"), (std::vector<std::string>{"flow_rate", "time"}));  // by the alphabet
  EXPECT_THROW(read_stats(folder / "stats.h5", "flow"), OutputError);
}

TEST(Stats, AScalarMayHaveAnyName) {
  const Scratch folder;
  { StatsFile(folder / "stats.h5", {{"FFE_L/D = 2", "1"}}).append(std::vector<double>{0.5}); }
  EXPECT_EQ(read_stats(folder / "stats.h5", "FFE_L/D = 2"), std::vector<double>{0.5});
}

TEST(Hdf5, AnotherFormatOrADamagedFileIsAnOutputError) {
  const Scratch folder;
  { StatsFile file(folder / "stats.h5", {{"time", "s"}}); }
  EXPECT_THROW(read_events(folder / "stats.h5"), OutputError);
  std::ofstream(folder / "bad.h5") << "this is no HDF5";
  EXPECT_THROW(read_events(folder / "bad.h5"), OutputError);
  EXPECT_THROW(read_events(folder / "none.h5"), OutputError);
  EXPECT_THROW(EventsFile("/proc/events.h5"), OutputError);
}

/// The file with another attribute of that name: `count` integers in place of what was there.
void many_for_one(const std::filesystem::path& path, const char* name, hsize_t count) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Adelete(file, name);
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t attribute = H5Acreate2(file, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT);
  const std::vector<int> values(count, 1);
  H5Awrite(attribute, H5T_NATIVE_INT, values.data());
  H5Aclose(attribute), H5Sclose(space), H5Fclose(file);
}

// HDF5 would write them all to the place of one.
TEST(Hdf5, ManyValuesWhereOneBelongsAreDamage) {
  for (const char* name : {"format_version", "format"}) {
    const Scratch folder;
    EventsFile(folder / "e.h5").append(std::vector<EventRecord>{event(1)});
    many_for_one(folder / "e.h5", name, 8000);
    EXPECT_THROW(read_events(folder / "e.h5"), OutputError) << name;
  }
}

// A chunked data set may claim any length and have no byte of it: here 112 GB of contacts.
TEST(Hdf5, NoMoreRoomIsMadeThanTheFileHasBytesFor) {
  const Scratch folder;
  EventsFile(folder / "e.h5").append(std::vector<EventRecord>{event(1)});
  const hid_t file = H5Fopen((folder / "e.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, "events", H5P_DEFAULT);
  const hsize_t claimed = 1'000'000'000;
  H5Dset_extent(dataset, &claimed);
  H5Dclose(dataset), H5Fclose(file);
  EXPECT_THROW(read_events(folder / "e.h5"), OutputError);
}

// As many as deflate packs at best: equal records, chunk after chunk.
TEST(Hdf5, TheDensestFileOfOursIsRead) {
  const Scratch folder;
  const std::vector<EventRecord> equal(100'000);
  EventsFile(folder / "e.h5").append(equal);
  EXPECT_EQ(read_events(folder / "e.h5").size(), equal.size());
}

TEST(Hdf5, AFullDiskIsAnOutputError) {
  const Scratch folder;
  EventsFile file(folder / "events.h5");
  const std::vector<EventRecord> some(2000, event(3));
  file.append(some);
  const FullDisk full(4096);
  EXPECT_THROW(file.flush(), OutputError);
}

}  // namespace
}  // namespace puffin::output
