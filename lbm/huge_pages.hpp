#pragma once
// Memory for the large arrays, in pages of 2 MB where the system gives them.
//
// A sweep walks along 19 arrays at once; with pages of 4 KB an air of 200,000 cells has 6,000 of them, more than the
// processor's table of addresses holds, and each row of cells would wait for several look-ups. Whether huge pages are
// given is the system's choice (Linux: transparent huge pages, `madvise` or `always`); without them all is as before.

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

namespace puffin::lbm {

/// For std::vector. Values are left as the memory is when a vector grows without a value (so that the thread that will
/// use them may touch them first).
template <class T>
struct HugePages {
  using value_type = T;
  static constexpr std::size_t page = std::size_t{2} << 20, line = 64;

  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) {}

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / (2 * sizeof(T))) throw std::bad_alloc();
    const bool large = count * sizeof(T) >= page;
    const std::size_t unit = large ? page : line, bytes = (count * sizeof(T) + unit - 1) / unit * unit;
    void* memory = std::aligned_alloc(unit, bytes);
    if (memory == nullptr) throw std::bad_alloc();
    if (large) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: refusal changes nothing but the speed
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }

  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    if constexpr (sizeof...(Args) == 0 && std::is_trivially_default_constructible_v<U>)
      ::new (static_cast<void*>(place)) U;
    else
      ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
  friend bool operator==(const HugePages&, const HugePages&) { return true; }
};

}  // namespace puffin::lbm
