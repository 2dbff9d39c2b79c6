// Any bytes as a table: refused by std::invalid_argument, or read as columns of one length.

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "cases/point_field.hpp"
#include "cases/table_file.hpp"
#include "tests/fuzz/bytes_as_file.hpp"

using namespace puffin;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const BytesAsFile file(data, size);
  try {
    const cases::Columns columns = cases::read_columns(file.path());
    for (const auto& [name, values] : columns) demand(values.size() == columns.begin()->second.size());
  } catch (const std::invalid_argument&) {
  }
  try {
    const cases::PointField field = cases::read_point_field(file.path());
    demand(!std::isnan(field.at(cases::Vec3(0.1, 0.2, 0.3))[0]));
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
