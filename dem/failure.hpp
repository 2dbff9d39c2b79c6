#pragma once
// Why the carriers' motion cannot go on, and whose; or that it shall not go on.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

namespace puffin::dem {

class Failure : public std::runtime_error {
 public:
  /// "dem: carrier ID BEFORE SECONDS s AFTER"
  Failure(std::int64_t carrier, const char* before, double seconds, const char* after = "")
      : std::runtime_error(text(carrier, before, seconds, after)), carrier_(carrier) {}

  std::int64_t carrier() const { return carrier_; }

 private:
  static std::string text(std::int64_t carrier, const char* before, double seconds, const char* after) {
    char all[256];
    std::snprintf(all, sizeof all, "dem: carrier %lld %s %.6g s%s", static_cast<long long>(carrier), before, seconds,
                  after);
    return all;
  }

  std::int64_t carrier_;
};

/// Models::asked_to_stop said so within a step. The carriers are as before it.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "dem: asked to stop within a step"; }
};

}  // namespace puffin::dem
