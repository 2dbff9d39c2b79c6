#pragma once
// What memory allows: plain loops without arithmetic, over arrays laid out as populations are.

#include <cstddef>
#include <variant>
#include <vector>

#include "lbm/huge_pages.hpp"

namespace puffin::bench {

/// The least that an in-place D3Q19 step must do: each of 19 arrays of `cells` values is read and written once, in
/// blocks of a few hundred cells. Arrays, threads and pages as the air has them.
class BoundStream {
 public:
  /// bytes_each: 4 or 8.
  BoundStream(std::size_t cells, std::size_t bytes_each);
  /// Cell updates a second [1/s], over at least `seconds`.
  double updates_per_second(double seconds);

 private:
  std::size_t cells_;
  std::variant<std::vector<float, lbm::HugePages<float>>, std::vector<double, lbm::HugePages<double>>> f_;
};

/// A copy between two arrays that together are `bytes` large.
class CopyStream {
 public:
  explicit CopyStream(std::size_t bytes);
  /// Bandwidth [B/s], read and write counted, over at least `seconds`.
  double bandwidth(double seconds);

 private:
  std::vector<double, lbm::HugePages<double>> from_, to_;
};

}  // namespace puffin::bench
