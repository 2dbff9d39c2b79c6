// XXH64 against the published values of its specification and reference implementation.

#include <gtest/gtest.h>

#include <string_view>

#include "coupling/checkpoint/hash.hpp"

namespace puffin::coupling {
namespace {

std::uint64_t hash(std::string_view text) { return xxh64(std::as_bytes(std::span(text.data(), text.size()))); }

TEST(Xxh64, GivesThePublishedValues) {
  EXPECT_EQ(hash(""), 0xEF46DB3751D8E999ULL);
  EXPECT_EQ(hash("a"), 0xD24EC4F1A98C6E5BULL);
  EXPECT_EQ(hash("abc"), 0x44BC2CF5AD770999ULL);
  EXPECT_EQ(hash("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1ULL);  // more than one block of 32
}

TEST(Xxh64, EveryByteCounts) {
  std::string text(100, 'x');
  const std::uint64_t whole = hash(text);
  for (char& c : text) {
    c = 'y';
    EXPECT_NE(hash(text), whole);
    c = 'x';
  }
}

}  // namespace
}  // namespace puffin::coupling
