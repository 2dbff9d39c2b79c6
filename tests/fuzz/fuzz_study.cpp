// Any bytes as a study file: refused by CaseError, or read as a bounded list of cases with different names.

#include <cstdint>
#include <set>
#include <system_error>

#include "cases/case_error.hpp"
#include "cases/study.hpp"
#include "tests/fuzz/bytes_as_file.hpp"

using namespace puffin;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const BytesAsFile file(data, size);
  try {
    const cases::Study study = cases::read_study(file.path());
    std::set<std::string> names;
    for (const cases::StudyCase& c : study.cases) demand(names.insert(c.name).second);
    demand(study.replicates >= 1 && study.cases.size() * static_cast<std::size_t>(study.replicates) <= 100000);
  } catch (const cases::CaseError& e) {
    demand(!e.problems.empty());
  } catch (const std::system_error&) {  // a base that may not be read
  }
  return 0;
}
