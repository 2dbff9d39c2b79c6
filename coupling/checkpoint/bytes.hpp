#pragma once
// Values to bytes and back. One list of members serves both ways:
//
//   void fields(auto& archive, Is<Thing> auto& thing) {
//     auto& [a, b, c] = thing;  // names every member: a member that is added and not listed does not compile
//     archive(a, b);            // c is scratch
//   }
//
// Numbers and enumerations are stored as they lie in memory (the file says in which byte order); vectors behind their
// length. A reader believes nothing: every length is checked against the bytes that are left before memory is taken.

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "lbm/scalars/compensated_sum.hpp"

namespace puffin::coupling {

/// The file is torn, truncated or altered: an older one may do.
class CheckpointDamaged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `T` or `const T`.
template <class S, class T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

template <class T>
concept Number = (std::is_arithmetic_v<T> && !std::same_as<T, bool>) || std::is_enum_v<T>;

/// Stored by a plain copy.
template <class T>
inline constexpr bool is_flat = Number<T> || std::same_as<T, Eigen::Vector3d>;

class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

 private:
  template <class T>
  void raw(const T* values, std::size_t count) {
    if (count == 0) return;
    const std::size_t old = bytes_.size();
    bytes_.resize(old + count * sizeof(T));
    std::memcpy(bytes_.data() + old, static_cast<const void*>(values), count * sizeof(T));
  }
  void put(bool value) { put(static_cast<std::uint8_t>(value)); }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    raw(text.data(), text.size());
  }
  void put(const lbm::CompensatedSum& sum) { (*this)(sum.sum(), sum.lost()); }
  template <class T, class A>
  void put(const std::vector<T, A>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    if constexpr (is_flat<T>)
      raw(values.data(), values.size());
    else
      for (const T& value : values) put(value);
  }
  template <class T, std::size_t n>
  void put(const std::array<T, n>& values) {
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class... T>
  void put(const std::tuple<T...>& values) {
    std::apply(*this, values);
  }
  template <class K, class V>
  void put(const std::map<K, V>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    for (const auto& [key, value] : values) (*this)(key, value);
  }
  template <class T>
  void put(const T& value) {
    if constexpr (is_flat<T>)
      raw(&value, 1);
    else
      fields(*this, value);
  }

  std::vector<std::byte>& bytes_;
};

class ByteReader {
 public:
  /// `name` of the section, for messages.
  ByteReader(const std::vector<std::byte>& bytes, std::string name)
      : at_(bytes.data()), end_(bytes.data() + bytes.size()), name_(std::move(name)) {}

  /// Throws CheckpointDamaged if the bytes do not suffice.
  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  /// Throws CheckpointDamaged unless every byte has been read.
  void finish() const {
    if (at_ != end_) fail("has more bytes than its contents need");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw CheckpointDamaged("its section '" + name_ + "' " + what);
  }

 private:
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  template <class T>
  void raw(T* values, std::size_t count) {
    if (count > left() / sizeof(T)) fail("ends too early");
    if (count == 0) return;
    std::memcpy(static_cast<void*>(values), at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }
  std::size_t length(std::size_t least_size) {
    std::uint64_t count = 0;
    raw(&count, 1);
    if (count > left() / least_size) fail("names a length beyond its end");
    return static_cast<std::size_t>(count);
  }
  void get(bool& value) {
    std::uint8_t byte = 0;
    raw(&byte, 1);
    if (byte > 1) fail("holds a yes or no that is neither");
    value = byte == 1;
  }
  void get(std::string& text) {
    text.resize(length(1));
    raw(text.data(), text.size());
  }
  void get(lbm::CompensatedSum& sum) {
    double parts[2];
    raw(parts, 2);
    sum = lbm::CompensatedSum::restored(parts[0], parts[1]);
  }
  template <class T, class A>
  void get(std::vector<T, A>& values) {
    if constexpr (is_flat<T>) {
      values.resize(length(sizeof(T)));
      raw(values.data(), values.size());
    } else {
      const std::size_t count = length(1);
      values.clear();
      for (std::size_t n = 0; n < count; ++n) get(values.emplace_back());  // grows only as far as there are bytes
    }
  }
  template <class T, std::size_t n>
  void get(std::array<T, n>& values) {
    for (T& value : values) get(value);
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool there = false;
    get(there);
    value.reset();
    if (there) get(value.emplace());
  }
  template <class... T>
  void get(std::tuple<T...>& values) {
    std::apply(*this, values);
  }
  template <class K, class V>
  void get(std::map<K, V>& values) {
    const std::size_t count = length(1);
    values.clear();
    for (std::size_t n = 0; n < count; ++n) {
      K key{};
      get(key);
      get(values[key]);
    }
  }
  template <class T>
  void get(T& value) {
    if constexpr (is_flat<T>)
      raw(&value, 1);
    else
      fields(*this, value);
  }

  const std::byte* at_;
  const std::byte* end_;
  std::string name_;
};

}  // namespace puffin::coupling
