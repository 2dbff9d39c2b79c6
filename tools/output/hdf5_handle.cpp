#include "tools/output/hdf5_handle.hpp"

#include <algorithm>
#include <vector>

#include "tools/output/format_version.hpp"
#include "tools/output/output_folder.hpp"

namespace puffin::output {
namespace {

/// HDF5 writes as many values as the file says, whatever room there is.
bool is_single(hid_t attribute) {
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
  return H5Sget_simple_extent_npoints(space) == 1;
}

}  // namespace

hid_t Hdf5File::good(hid_t id, const std::string& what) const {
  if (id < 0) {
    throw OutputError("cannot " + what + " " + path_.string() +
                      ": HDF5 reports an error; check free space and permissions, or choose another folder with --out");
  }
  return id;
}

Hdf5File::Hdf5File(const std::filesystem::path& path, const std::string& format) : path_(path) {
  const Hdf5Quiet quiet;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t growth = 1 << 16;
  H5Pset_fapl_core(access, growth, false);
  file_ = {good(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "write"), H5Fclose};
  set_text(file_, "format", format);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle version(H5Acreate2(file_, "format_version", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
  good(version, "write");
  good(H5Awrite(version, H5T_NATIVE_INT, &format_version), "write");
}

Hdf5File Hdf5File::reading(const std::filesystem::path& path, const std::string& format) {
  demand_regular(path);
  const Hdf5Quiet quiet;
  Hdf5File file;
  file.path_ = path;
  file.file_ = {file.good(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "read"), H5Fclose};
  file.check_format(format);
  return file;
}

Hdf5File Hdf5File::adding(const std::filesystem::path& path, const std::string& format) {
  const Hdf5Quiet quiet;
  Hdf5File file;
  file.path_ = path;
  file.file_ = {file.good(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "write"), H5Fclose};
  file.check_format(format);
  return file;
}

void Hdf5File::check_format(const std::string& format) const {
  int version = 0;
  if (H5Aexists(file_, "format_version") > 0) {
    const Hdf5Handle attribute(H5Aopen(file_, "format_version", H5P_DEFAULT), H5Aclose);
    if (is_single(attribute)) H5Aread(attribute, H5T_NATIVE_INT, &version);
  }
  if (text(file_, "format") != format)
    throw OutputError(path_.string() + " is no " + format + " file; it comes from another program");
  check_format_version(path_.string(), version);
}

Hdf5Handle Hdf5File::create_growing(hid_t parent, const std::string& name, hid_t type, hsize_t chunk) const {
  const Hdf5Quiet quiet;
  const hsize_t none = 0;
  const hsize_t endless = H5S_UNLIMITED;
  const Hdf5Handle space(H5Screate_simple(1, &none, &endless), H5Sclose);
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(properties, 1, &chunk);
  H5Pset_shuffle(properties);
  H5Pset_deflate(properties, 4);
  H5Pset_obj_track_times(properties, false);
  return {good(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), "write"), H5Dclose};
}

hsize_t Hdf5File::length(hid_t dataset) const {
  const Hdf5Handle space(good(H5Dget_space(dataset), "read"), H5Sclose);
  return static_cast<hsize_t>(H5Sget_simple_extent_npoints(space));
}

hsize_t Hdf5File::stored_length(hid_t dataset) const {
  constexpr hsize_t densest = 1032;  // deflate packs no tighter
  const Hdf5Handle type(good(H5Dget_type(dataset), "read"), H5Tclose);
  const hsize_t values = length(dataset), each = std::max<hsize_t>(1, H5Tget_size(type));
  if (values > densest * H5Dget_storage_size(dataset) / each)
    throw OutputError(path_.string() + " is damaged: it claims " + std::to_string(values) +
                      " values, for which it is too short");
  return values;
}

void Hdf5File::append(hid_t dataset, hid_t type, const void* elements, hsize_t n) const {
  if (n == 0) return;
  const Hdf5Quiet quiet;
  const hsize_t old = length(dataset);
  const hsize_t grown = old + n;
  good(H5Dset_extent(dataset, &grown), "write");
  const Hdf5Handle target(H5Dget_space(dataset), H5Sclose);
  H5Sselect_hyperslab(target, H5S_SELECT_SET, &old, nullptr, &n, nullptr);
  const Hdf5Handle source(H5Screate_simple(1, &n, nullptr), H5Sclose);
  good(H5Dwrite(dataset, type, source, target, H5P_DEFAULT, elements), "write");
}

void Hdf5File::flush() const {
  const Hdf5Quiet quiet;
  good(H5Fflush(file_, H5F_SCOPE_GLOBAL), "write");
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  good(size, "write");
  std::string image(static_cast<std::size_t>(size), '\0');
  good(H5Fget_file_image(file_, image.data(), image.size()), "write");
  write_whole(path_, image);
}

void Hdf5File::set_text(hid_t object, const std::string& name, const std::string& text) const {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, text.size() + 1);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  good(attribute, "write");
  good(H5Awrite(attribute, type, text.c_str()), "write");
}

std::string Hdf5File::text(hid_t object, const std::string& name) const {
  if (H5Aexists(object, name.c_str()) <= 0) return {};
  const Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!is_single(attribute)) return {};
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
  std::vector<char> buffer(H5Tget_size(type) + 1, '\0');
  if (H5Tis_variable_str(type) > 0 || H5Aread(attribute, type, buffer.data()) < 0) return {};
  return buffer.data();
}

}  // namespace puffin::output
