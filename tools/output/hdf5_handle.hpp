#pragma once
// HDF5's C handles with an owner, and its error codes as OutputError. Only for .cpp files.

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <utility>

#include "tools/output/output_error.hpp"

namespace puffin::output {

/// Closes what it holds.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept { *this = std::move(other); }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Within its scope HDF5 does not print its error stack.
class Hdf5Quiet {
 public:
  Hdf5Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Hdf5Quiet(const Hdf5Quiet&) = delete;
  Hdf5Quiet& operator=(const Hdf5Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// A file with the operations that both writers need.
class Hdf5File {
 public:
  /// Creates a file for writing and stores `format` and format_version. It grows in memory; flush() writes it: HDF5
  /// itself cannot be told of a full disk without crashing when the program ends (1.10.8).
  Hdf5File(const std::filesystem::path& path, const std::string& format);
  /// Opens for reading and checks the format.
  static Hdf5File reading(const std::filesystem::path& path, const std::string& format);

  /// Opens for adding data sets and checks the format.
  static Hdf5File adding(const std::filesystem::path& path, const std::string& format);

  /// A growing one-dimensional data set, chunked, shuffled and deflated; without a time stamp, so that equal contents
  /// give equal bytes.
  Hdf5Handle create_growing(hid_t parent, const std::string& name, hid_t type, hsize_t chunk) const;
  /// Appends n elements of `type` at the end.
  void append(hid_t dataset, hid_t type, const void* elements, hsize_t n) const;
  hsize_t length(hid_t dataset) const;
  /// The length for who makes room to read it all. Throws OutputError if the file has not the bytes for so many values.
  hsize_t stored_length(hid_t dataset) const;
  /// Writes all that there is so far to the file's place.
  void flush() const;
  void set_text(hid_t object, const std::string& name, const std::string& text) const;
  std::string text(hid_t object, const std::string& name) const;

  /// Throws OutputError unless id >= 0; returns it.
  hid_t good(hid_t id, const std::string& what) const;
  hid_t id() const { return file_; }

 private:
  Hdf5File() = default;
  void check_format(const std::string& format) const;

  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace puffin::output
