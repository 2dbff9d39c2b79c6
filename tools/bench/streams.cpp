#include "tools/bench/streams.hpp"

#include <oneapi/tbb/cache_aligned_allocator.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace puffin::bench {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// The widest vectors that the processor has, chosen when the program is loaded.
#define PUFFIN_WIDEST __attribute__((target_clones("avx512f", "avx2", "default"), optimize("O3")))

PUFFIN_WIDEST void negate(float* p, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) p[k] = -p[k];
}
PUFFIN_WIDEST void negate(double* p, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) p[k] = -p[k];
}
PUFFIN_WIDEST void copy(const double* from, double* to, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) to[k] = from[k];
}

template <class T>
using Array = std::vector<T, oneapi::tbb::cache_aligned_allocator<T>>;

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

template <class T>
double stream(std::size_t cells, double seconds) {
  constexpr std::size_t block = 512, part = 4096;
  std::size_t lines = (cells * sizeof(T) + 63) / 64;
  while (lines % 64 != 5) ++lines;
  const std::size_t stride = lines * 64 / sizeof(T);
  Array<T> f(19 * stride, T(1));
  const std::size_t parts = (cells + part - 1) / part;
  return static_cast<double>(cells) * rate(seconds, [&] {
           oneapi::tbb::parallel_for(
               std::size_t{0}, parts,
               [&](std::size_t p) {
                 const std::size_t end = std::min(cells, (p + 1) * part);
                 for (std::size_t n = p * part; n < end; n += block)
                   for (std::size_t i = 0; i < 19; ++i) negate(f.data() + i * stride + n, std::min(block, end - n));
               },
               oneapi::tbb::static_partitioner());
         });
}

}  // namespace

double stream_updates_per_second(std::size_t cells, std::size_t bytes_each, double seconds) {
  return bytes_each == sizeof(float) ? stream<float>(cells, seconds) : stream<double>(cells, seconds);
}

double copy_bandwidth(std::size_t bytes, double seconds) {
  const std::size_t n = std::max<std::size_t>(1, bytes / (2 * sizeof(double)));
  Array<double> from(n, 1.0), to(n, 0.0);
  constexpr std::size_t part = 8192;
  const double repeats = rate(seconds, [&] {
    oneapi::tbb::parallel_for(
        std::size_t{0}, (n + part - 1) / part,
        [&](std::size_t p) { copy(from.data() + p * part, to.data() + p * part, std::min(part, n - p * part)); },
        oneapi::tbb::static_partitioner());
  });
  return repeats * 2.0 * sizeof(double) * static_cast<double>(n);
}

}  // namespace puffin::bench
