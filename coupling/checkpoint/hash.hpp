#pragma once
// XXH64: a fast checksum that finds every torn, truncated or altered section. Not a defence against forgery.

#include <cstddef>
#include <cstdint>
#include <span>

namespace puffin::coupling {

/// The 64-bit xxHash of `bytes`. Source: Y. Collet, xxHash fast digest algorithm, specification 0.1.1.
std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace puffin::coupling
