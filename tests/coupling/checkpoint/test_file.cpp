// A checkpoint file is whole or recognised as damaged, whatever happened to its bytes.

#include <gtest/gtest.h>

#include <random>
#include <system_error>

#include "coupling/checkpoint/file.hpp"
#include "tests/tools/output/scratch.hpp"

namespace puffin::coupling {
namespace {

using output::FullDisk;
using output::Scratch;
using output::text_of;

constexpr std::size_t plenty = 1 << 20;

Checkpoint sample() {
  Checkpoint checkpoint;
  ByteWriter{checkpoint.renew("numbers")}(std::vector<double>{1.0, 2.0, 3.0}, std::string("text"), true);
  ByteWriter{checkpoint.renew("more")}(std::int64_t{42});
  checkpoint.renew("empty");
  return checkpoint;
}

void spill(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST(CheckpointFile, ReadsBackWhatWasWritten) {
  const Scratch folder;
  const Checkpoint written = sample();
  write_checkpoint(folder / "c", written);
  const Checkpoint read = read_checkpoint(folder / "c", plenty);
  ASSERT_EQ(read.sections.size(), written.sections.size());
  for (std::size_t n = 0; n < read.sections.size(); ++n) {
    EXPECT_EQ(read.sections[n].name, written.sections[n].name);
    EXPECT_EQ(read.sections[n].bytes, written.sections[n].bytes);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "c.part"));
  EXPECT_THROW(read.at("missing"), CheckpointDamaged);
}

TEST(CheckpointFile, ALinkInPlaceOfTheTemporaryFileIsReplacedAndNotFollowed) {
  const Scratch folder;
  spill(folder / "mine", "mine");
  std::filesystem::create_symlink(folder / "mine", folder / "c.part");
  std::filesystem::create_hard_link(folder / "mine", folder / "d.part");
  for (const char* name : {"c", "d"}) {
    write_checkpoint(folder / name, sample());
    EXPECT_EQ(read_checkpoint(folder / name, plenty).sections.size(), sample().sections.size());
  }
  EXPECT_EQ(text_of(folder / "mine"), "mine");
}

TEST(CheckpointFile, EveryFlippedBitIsFound) {
  const Scratch folder;
  write_checkpoint(folder / "c", sample());
  const std::string whole = text_of(folder / "c");
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
      const auto parse = [&] { parse_checkpoint(std::as_bytes(std::span(bytes))); };
      // The eight bytes of order and version are told apart: such a file may be sound elsewhere.
      if (at >= 8 && at < 16)
        EXPECT_THROW(parse(), CheckpointForeign) << at;
      else
        EXPECT_THROW(parse(), CheckpointDamaged) << at;
    }
}

TEST(CheckpointFile, EveryTruncationAndAnyTailIsFound) {
  const Scratch folder;
  write_checkpoint(folder / "c", sample());
  const std::string whole = text_of(folder / "c");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    spill(folder / "cut", whole.substr(0, length));
    EXPECT_THROW(read_checkpoint(folder / "cut", plenty), CheckpointDamaged) << length;
  }
  spill(folder / "long", whole + "x");
  EXPECT_THROW(read_checkpoint(folder / "long", plenty), CheckpointDamaged);
}

TEST(CheckpointFile, RandomBytesBehindASoundBeginningAreFound) {
  const Scratch folder;
  write_checkpoint(folder / "c", sample());
  const std::string whole = text_of(folder / "c");
  std::mt19937 random(1);
  for (int n = 0; n < 20000; ++n) {
    std::string bytes = whole.substr(0, 16 + random() % (whole.size() - 16));
    for (int k = 0; k < 64; ++k) bytes += static_cast<char>(random());
    EXPECT_THROW(parse_checkpoint(std::as_bytes(std::span(bytes))), CheckpointDamaged);
  }
}

TEST(CheckpointFile, OneThatIsTooLongIsNotRead) {
  const Scratch folder;
  write_checkpoint(folder / "c", sample());
  std::filesystem::resize_file(folder / "c", std::uintmax_t{1} << 40);  // sparse: a terabyte of nothing
  EXPECT_THROW(read_checkpoint(folder / "c", plenty), CheckpointDamaged);
}

TEST(CheckpointFile, AFullDiskLeavesTheOldOne) {
  const Scratch folder;
  write_checkpoint(folder / "c", sample());
  const std::string before = text_of(folder / "c");
  Checkpoint large = sample();
  large.renew("large").resize(100000);
  {
    const FullDisk full(1000);
    EXPECT_THROW(write_checkpoint(folder / "c", large), std::system_error);
  }
  EXPECT_EQ(text_of(folder / "c"), before);
  EXPECT_FALSE(std::filesystem::exists(folder / "c.part"));
  EXPECT_THROW(write_checkpoint(folder / "none" / "c", large), std::system_error);
}

TEST(ByteReader, BelievesNoLength) {
  std::vector<std::byte> bytes;
  ByteWriter{bytes}(std::uint64_t{1} << 60);  // a vector of 10^18 numbers that are not there
  std::vector<double> numbers;
  EXPECT_THROW(ByteReader(bytes, "x")(numbers), CheckpointDamaged);
  std::vector<std::string> texts;
  EXPECT_THROW(ByteReader(bytes, "x")(texts), CheckpointDamaged);
  std::map<int, double> map;
  EXPECT_THROW(ByteReader(bytes, "x")(map), CheckpointDamaged);
  EXPECT_THROW(ByteReader(bytes, "x").finish(), CheckpointDamaged);
}

}  // namespace
}  // namespace puffin::coupling
