#include "tools/bench/streams.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>

namespace puffin::bench {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// The widest vectors that the processor has, chosen when the program is loaded; with gcc whatever else is optimised
// how.
#if defined(__SANITIZE_THREAD__)  // the choice would run before the sanitizer does
#define PUFFIN_WIDEST
#elif defined(__clang__)
#define PUFFIN_WIDEST __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define PUFFIN_WIDEST __attribute__((target_clones("avx512f", "avx2", "default"), optimize("O3")))
#endif

PUFFIN_WIDEST void negate(float* p, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) p[k] = -p[k];
}
PUFFIN_WIDEST void negate(double* p, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) p[k] = -p[k];
}
PUFFIN_WIDEST void copy(const double* from, double* to, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) to[k] = from[k];
}

/// Repeats `body` until `seconds` have passed, after one warm-up; returns repeats per second.
template <class F>
double rate(double seconds, const F& body) {
  body();
  const auto begin = Clock::now();
  int repeats = 0;
  do {
    body();
    ++repeats;
  } while (seconds_since(begin) < seconds);
  return repeats / seconds_since(begin);
}

std::size_t stride_of(std::size_t cells, std::size_t bytes_each) {
  std::size_t lines = (cells * bytes_each + 63) / 64;
  while (lines % 64 != 5) ++lines;
  return lines * 64 / bytes_each;
}

}  // namespace

BoundStream::BoundStream(std::size_t cells, std::size_t bytes_each) : cells_(cells) {
  const std::size_t size = 19 * stride_of(cells, bytes_each);
  if (bytes_each == sizeof(float))
    f_.emplace<0>(size, 1.0F);
  else
    f_.emplace<1>(size, 1.0);
}

double BoundStream::updates_per_second(double seconds) {
  constexpr std::size_t block = 512, part = 4096;
  return std::visit(
      [&](auto& f) {
        const std::size_t stride = f.size() / 19, parts = (cells_ + part - 1) / part;
        return static_cast<double>(cells_) * rate(seconds, [&] {
                 oneapi::tbb::parallel_for(
                     std::size_t{0}, parts,
                     [&](std::size_t p) {
                       const std::size_t end = std::min(cells_, (p + 1) * part);
                       for (std::size_t n = p * part; n < end; n += block)
                         for (std::size_t i = 0; i < 19; ++i)
                           negate(f.data() + i * stride + n, std::min(block, end - n));
                     },
                     oneapi::tbb::static_partitioner());
               });
      },
      f_);
}

CopyStream::CopyStream(std::size_t bytes)
    : from_(std::max<std::size_t>(1, bytes / (2 * sizeof(double))), 1.0), to_(from_.size(), 0.0) {}

double CopyStream::bandwidth(double seconds) {
  constexpr std::size_t part = 8192;
  const std::size_t n = from_.size();
  const double repeats = rate(seconds, [&] {
    oneapi::tbb::parallel_for(
        std::size_t{0}, (n + part - 1) / part,
        [&](std::size_t p) { copy(from_.data() + p * part, to_.data() + p * part, std::min(part, n - p * part)); },
        oneapi::tbb::static_partitioner());
  });
  return repeats * 2.0 * sizeof(double) * static_cast<double>(n);
}

}  // namespace puffin::bench
