// Any bytes as a micro-model file: refused by CaseError, or read; whatever was read never takes more fines than there
// are, nor fewer than none.

#include <array>
#include <cmath>
#include <cstdint>
#include <system_error>

#include "cases/case_error.hpp"
#include "cases/micromodel_file.hpp"
#include "tests/fuzz/bytes_as_file.hpp"

using namespace puffin;

namespace {

void demand_bounded(const micromodels::Taken& taken, double left) {
  demand(taken.to_air >= 0.0 && taken.to_wall >= 0.0);
  demand(taken.to_air + taken.to_wall <= left * (1.0 + 1e-12));  // two roundings of shares of `left`
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const BytesAsFile file(data, size);
  try {
    const micromodels::FinesModels models = cases::read_micromodels(file.path());
    constexpr double initial = 2000.0, left = 500.0;
    for (const double speed : {0.0, 1e-6, 0.3, 7.0, 90.0, 1e4}) {
      for (const double angle : {0.0, 33.0, 90.0}) {
        demand_bounded(micromodels::impact_on_wall(models, speed, angle, initial, left), left);
        demand_bounded(micromodels::impact_on_carrier(models, speed, angle, initial, left), left);
      }
      demand_bounded(micromodels::drag(models, speed, 1e-4, initial, left), left);
    }
  } catch (const cases::CaseError& e) {
    demand(!e.problems.empty());
  } catch (const std::system_error&) {  // a table that may not be read
  }
  return 0;
}
