#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <numbers>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/events_file.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/tables.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

TEST(Csv, ColumnsAreExactlyThoseOfTheInterface) {
  const Scratch folder;
  const auto header = [&](const std::vector<std::string>& columns) {
    CsvFile(folder / "t.csv", columns).flush();
    return text_of(folder / "t.csv");
  };
  EXPECT_EQ(header(history_columns()),
            "time,dt,flow_rate,static_drop,total_to_static_drop,carriers_in,carriers_emitted,carriers_asleep,FFE,FFW,"
            "FFCR,FFCE,in_air,ledger_error\n");
  EXPECT_EQ(header(probe_columns()), "time,probe,u,v,w,p\n");
  EXPECT_EQ(header(line_columns()), "line,s,x,y,z,u,v,w,p,samples\n");
  EXPECT_EQ(header(plane_columns()), "time,plane,flow_rate,static_pressure,total_pressure\n");
  EXPECT_EQ(header(force_columns()), "time,patch,fx,fy,fz\n");
  EXPECT_EQ(header(track_columns()), "time,id,x,y,z,u,v,w,wx,wy,wz\n");
}

TEST(Csv, EveryMemberOfARowStandsUnderItsOwnName) {
  const Scratch folder;
  {
    CsvFile history(folder / "history.csv", history_columns());
    append(history, HistoryRow{.time = 1,
                               .dt = 2,
                               .flow_rate = 3,
                               .static_drop = 4,
                               .total_to_static_drop = 5,
                               .carriers_in = 6,
                               .carriers_emitted = 7,
                               .carriers_asleep = 8,
                               .FFE = 9,
                               .FFW = 10,
                               .FFCR = 11,
                               .FFCE = 12,
                               .in_air = 13,
                               .ledger_error = 14});
    CsvFile probes(folder / "probes.csv", probe_columns());
    append(probes, ProbeRow{.time = 1, .probe = "p1", .u = 2, .v = 3, .w = 4, .p = 5});
    CsvFile lines(folder / "lines.csv", line_columns());
    append(lines, LineRow{"mid", 1, 2, 3, 4, 5, 6, 7, 8, 9});
    CsvFile planes(folder / "planes.csv", plane_columns());
    append(planes, PlaneRow{1, "out", 2, 3, 4});
    CsvFile forces(folder / "forces.csv", force_columns());
    append(forces, ForceRow{1, "obstacle", {2, 3, 4}});
    CsvFile tracks(folder / "tracks.csv", track_columns());
    append(tracks, TrackRow{1, 2, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}});
  }
  const CsvTable history = read_csv(folder / "history.csv");
  for (std::size_t i = 0; i < history_columns().size(); ++i) {
    EXPECT_EQ(history.numbers(history_columns()[i]).at(0), static_cast<double>(i + 1)) << history_columns()[i];
  }
  EXPECT_EQ(history_units().size(), history_columns().size());
  const auto row = [&](const char* file) { return read_csv(folder / file).rows.at(0); };
  using Row = std::vector<std::string>;
  EXPECT_EQ(row("probes.csv"), (Row{"1", "p1", "2", "3", "4", "5"}));
  EXPECT_EQ(row("lines.csv"), (Row{"mid", "1", "2", "3", "4", "5", "6", "7", "8", "9"}));
  EXPECT_EQ(row("planes.csv"), (Row{"1", "out", "2", "3", "4"}));
  EXPECT_EQ(row("forces.csv"), (Row{"1", "obstacle", "2", "3", "4"}));
  EXPECT_EQ(row("tracks.csv"), (Row{"1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11"}));
}

TEST(Csv, NumbersReadBackToTheLastBit) {
  const Scratch folder;
  const std::vector<double> numbers{0.1, 1.0 / 3.0, std::numbers::pi * 1e-300, -0.0, 5e-324, 1.7976931348623157e308};
  {
    CsvFile file(folder / "n.csv", {"x"});
    for (const double x : numbers) file.append({x});
  }
  const std::vector<double> back = read_csv(folder / "n.csv").numbers("x");
  ASSERT_EQ(back.size(), numbers.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(numbers[i])) << numbers[i];
  }
  EXPECT_EQ(shortest(0.1), "0.1");
}

TEST(Csv, TextWithCommasAndQuotesSurvives) {
  const Scratch folder;
  const std::string name = "plane \"a\", upper";
  CsvFile file(folder / "n.csv", {"time", "plane"});
  file.append({1.0, name});
  file.flush();
  EXPECT_EQ(read_csv(folder / "n.csv").rows.at(0).at(1), name);
}

TEST(Csv, ResumingKeepsTheFirstBytesAndDropsWhatCameLater) {
  const Scratch folder;
  std::uint64_t keep = 0;
  {
    CsvFile file(folder / "h.csv", {"time", "x"});
    for (int i = 0; i < 5; ++i) {
      file.append({0.1 * i, 1.0 * i});
      if (i == 2) keep = file.bytes();
    }
  }
  std::ofstream(folder / "h.csv", std::ios::app) << "0.05";  // killed in the middle of a line
  {
    CsvFile file(folder / "h.csv", {"time", "x"}, keep);
    EXPECT_EQ(file.bytes(), keep);
    file.append({0.25, 7.0});
  }
  EXPECT_EQ(read_csv(folder / "h.csv").numbers("x"), (std::vector<double>{0, 1, 2, 7}));
}

TEST(Csv, AFileThatIsShorterOrHasOtherColumnsCannotBeResumed) {
  const Scratch folder;
  { CsvFile(folder / "h.csv", {"time", "x"}).flush(); }
  EXPECT_THROW(CsvFile(folder / "h.csv", {"time", "x"}, 100), OutputError);
  EXPECT_THROW(CsvFile(folder / "h.csv", {"time", "y"}, 7), OutputError);
  EXPECT_THROW(CsvFile(folder / "none.csv", {"time", "x"}, 7), OutputError);
}

TEST(Csv, AFolderThatCannotBeWrittenIsAnOutputError) {
  // /proc refuses new files for every user, the administrator too.
  EXPECT_THROW(CsvFile("/proc/puffin.csv", {"time"}), OutputError);
}

TEST(Csv, AFullDiskIsAnOutputError) {
  const Scratch folder;
  CsvFile file(folder / "h.csv", {"time"});
  const FullDisk full(64);
  EXPECT_THROW(
      {
        for (int i = 0; i < 100; ++i) file.append({1.0 * i});
        file.flush();
      },
      OutputError);
}

// A pipe without a writer: who opens it waits for ever.
TEST(Readers, NoneOfARunsFilesIsWaitedFor) {
  const Scratch folder;
  const auto pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(read_csv(pipe), OutputError);
  EXPECT_THROW(read_pvd(pipe), OutputError);
  EXPECT_THROW(read_field_frame(pipe), OutputError);
  EXPECT_THROW(read_events(pipe), OutputError);
}

TEST(Csv, AWrongNumberOfCellsIsRefused) {
  const Scratch folder;
  CsvFile file(folder / "h.csv", {"time", "x"});
  EXPECT_THROW(file.append({1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace puffin::output
