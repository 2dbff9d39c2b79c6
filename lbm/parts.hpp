#pragma once
// Chunks of work in parts, one a thread, each worked through in order, so that every step a thread meets the memory it
// met in the last. Who is done with his part helps from the end of the others': a core that is slower or busy with
// somebody else's work, as half of them are on a shared machine, holds up one chunk and not the step. Nothing may
// depend on who does a chunk.

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace puffin::lbm {

/// The chunks of a part that are left: [next, end), taken by its owner from the front and by others from the back.
class Part {
 public:
  void set(int next, int end) { left_.store(pack(next, end), std::memory_order_relaxed); }
  /// The next chunk of the owner, or -1.
  int take_first() {
    return take([](std::uint32_t next, std::uint32_t end) { return std::pair(pack(next + 1, end), next); });
  }
  /// The last chunk, for another, or -1.
  int take_last() {
    return take([](std::uint32_t next, std::uint32_t end) { return std::pair(pack(next, end - 1), end - 1); });
  }

 private:
  static std::uint64_t pack(std::uint32_t next, std::uint32_t end) {
    return static_cast<std::uint64_t>(next) << 32U | end;
  }
  template <class Choose>
  int take(const Choose& choose) {
    std::uint64_t left = left_.load(std::memory_order_relaxed);
    while (true) {
      const auto next = static_cast<std::uint32_t>(left >> 32U), end = static_cast<std::uint32_t>(left);
      if (next >= end) return -1;
      const auto [rest, taken] = choose(next, end);
      // Chunks are handed over by nothing but their number, so no other memory need be ordered here.
      if (left_.compare_exchange_weak(left, rest, std::memory_order_relaxed)) return static_cast<int>(taken);
    }
  }

  alignas(64) std::atomic<std::uint64_t> left_{0};
};

/// body(chunk, begin) for each of the chunks [0, count). All chunks from `begin` to this one were done before by the
/// same thread, in order.
template <class Body>
void for_each_in_parts(int count, const Body& body) {
  const int parts = std::min(count, oneapi::tbb::this_task_arena::max_concurrency());
  const auto begin_of = [&](int part) { return static_cast<int>(static_cast<std::int64_t>(count) * part / parts); };
  std::vector<Part> left(static_cast<std::size_t>(parts));
  for (int p = 0; p < parts; ++p) left[p].set(begin_of(p), begin_of(p + 1));
  const auto work = [&](int own) {
    const int begin = begin_of(own);
    for (int c = left[own].take_first(); c >= 0; c = left[own].take_first()) body(c, begin);
    for (int k = 1; k < parts; ++k)
      for (int c = left[(own + k) % parts].take_last(); c >= 0; c = left[(own + k) % parts].take_last()) body(c, c);
  };
  oneapi::tbb::parallel_for(0, parts, work, oneapi::tbb::static_partitioner());
}

}  // namespace puffin::lbm
