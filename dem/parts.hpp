#pragma once
// Work shared among threads in parts that depend on the work alone. What a part finds is kept apart, so results do not
// depend on who does which part.

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace puffin::dem {

/// Calls work(part, first, last) for `count` things in parts of `size`; one part is done at once.
template <class Work>
void in_parts(std::size_t count, std::size_t size, Work work) {
  const std::size_t parts = (count + size - 1) / size;
  const auto one = [&](std::size_t p) { work(p, p * size, std::min(count, (p + 1) * size)); };
  if (parts == 1) one(0);
  if (parts > 1) tbb::parallel_for(std::size_t{0}, parts, one);
}

}  // namespace puffin::dem
