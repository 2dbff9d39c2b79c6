#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <system_error>

#include "cases/micromodel_file.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases {
namespace {

using test::parse;
using test::problems_of;
using test::sample;

TEST(HostileFiles, GiveErrorsAndNoCrash) {
  const std::string deep(100000, '[');
  for (const std::string& text :
       {std::string(), std::string("\0\1\2\377binary", 10),
        std::string("\x7f"
                    "ELF\2\1\1"),
        "a = " + deep, "a = " + std::string(5000, '[') + std::string(5000, ']'),
        std::string("name = \"x\"\nname = \"y\"\n"), std::string("air = 3\ncarriers = [1, 2]\ngeometry = \"box\"\n"),
        std::string("[[air]]\n[[air]]\n"), std::string("[air]\nboundary = [1, {}, \"x\"]\n"),
        std::string("name = 1979-05-27T07:32:00Z\n"), "\"" + std::string(100000, 'k') + "\" = 1\n",
        std::string("= 1\n"), std::string("x = 99999999999999999999\n")})
    EXPECT_FALSE(problems_of(text).empty()) << text.substr(0, 60);
}

TEST(HostileFiles, ImpossibleNumbersAreRefused) {
  for (const char* value : {"nan", "inf", "-inf", "1e999", "'1e999 m'", "true", "[]", "{}", "'many mm'", "-1", "0"})
    EXPECT_FALSE(problems_of(sample, {{"numerics.dx", value}}).empty()) << value;
  for (const char* value : {"9223372036854775807", "-5", "1e300", "nan", "'1000'"})
    EXPECT_FALSE(problems_of(sample, {{"carriers.parcel", value}}).empty()) << value;
}

// Every prefix and many corruptions of a right file either read or give a CaseError; nothing else escapes.
TEST(HostileFiles, TruncatedAndCorruptedFilesNeverEscape) {
  for (std::size_t n = 0; n <= sample.size(); n += 7) problems_of(sample.substr(0, n));
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    std::string text = sample;
    for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random() % 256);
    problems_of(text);
  }
  SUCCEED();
}

TEST(HostileFiles, AFileThatIsNotThereIsAnIOError) {
  EXPECT_THROW(read_case("there/is/no/such/case.toml"), std::system_error);
  EXPECT_THROW(read_case(std::filesystem::temp_directory_path()), std::system_error);
  EXPECT_THROW(read_micromodels("there/is/no/such/file.toml"), std::system_error);
}

}  // namespace
}  // namespace puffin::cases
