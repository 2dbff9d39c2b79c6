// Any bytes as a case file: refused by CaseError with at least one problem, or read; what was read is written as a
// resolved case that reads back as the same case.

#include <cstdint>
#include <string_view>
#include <system_error>

#include "cases/read_case.hpp"
#include "cases/write_case.hpp"
#include "tests/fuzz/bytes_as_file.hpp"

using namespace puffin::cases;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Case c;
  try {
    c = parse_case(text, "fuzz.toml");
  } catch (const CaseError& e) {
    demand(!e.problems.empty());
    return 0;
  } catch (const std::system_error&) {  // a base that may not be read
    return 0;
  }
  Case again = parse_case(write_resolved(c), "fuzz.toml");
  again.provenance = c.provenance;  // now every value is given
  demand(again == c);
  return 0;
}
