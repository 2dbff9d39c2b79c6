#include "tools/output/stats_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "tools/output/hdf5_handle.hpp"

namespace puffin::output {
namespace {

constexpr char format[] = "puffin-stats";
constexpr hsize_t chunk = 1024;  // rows

/// HDF5 takes a '/' for a group.
std::string dataset_name(std::string column) {
  std::replace(column.begin(), column.end(), '/', '_');
  return column;
}

std::vector<double> read_column(const Hdf5File& file, hid_t dataset) {
  std::vector<double> values(file.stored_length(dataset));
  if (!values.empty()) {
    file.good(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read");
  }
  return values;
}

}  // namespace

struct StatsFile::Impl {
  Hdf5File file;
  std::vector<Hdf5Handle> datasets;            // one a column
  std::vector<std::vector<double>> collected;  // one a column, not yet written

  void write() {
    for (std::size_t c = 0; c < datasets.size(); ++c) {
      file.append(datasets[c], H5T_NATIVE_DOUBLE, collected[c].data(), collected[c].size());
      collected[c].clear();
    }
  }
};

StatsFile::StatsFile(const std::filesystem::path& path, const std::vector<StatsColumn>& columns) {
  impl_ = std::make_unique<Impl>(Impl{Hdf5File(path, format), {}, {}});
  Impl& d = *impl_;
  d.collected.resize(columns.size());
  const Hdf5Quiet quiet;
  const Hdf5Handle group(H5Gcreate2(d.file.id(), "history", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  d.file.good(group, "write");
  for (const auto& column : columns) {
    d.datasets.push_back(d.file.create_growing(group, dataset_name(column.name), H5T_IEEE_F64LE, chunk));
    d.file.set_text(d.datasets.back(), "unit", column.unit);
  }
  d.file.flush();
}

StatsFile::~StatsFile() {
  try {
    if (impl_) flush();
  } catch (const OutputError&) {
    // A destructor cannot report; whoever needs to know calls flush() first.
  }
}
StatsFile::StatsFile(StatsFile&&) noexcept = default;
StatsFile& StatsFile::operator=(StatsFile&&) noexcept = default;

void StatsFile::append(std::span<const double> row) {
  Impl& d = *impl_;
  if (row.size() != d.collected.size()) {
    throw std::invalid_argument("stats.h5: a row of " + std::to_string(row.size()) + " values for " +
                                std::to_string(d.collected.size()) + " columns");
  }
  for (std::size_t c = 0; c < row.size(); ++c) d.collected[c].push_back(row[c]);
  if (!row.empty() && d.collected.front().size() >= chunk) d.write();
}

void StatsFile::flush() {
  impl_->write();
  impl_->file.flush();
}

std::vector<std::string> stats_names(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::reading(path, format);
  const Hdf5Quiet quiet;
  const Hdf5Handle group(file.good(H5Gopen2(file.id(), "history", H5P_DEFAULT), "find history in"), H5Gclose);
  std::vector<std::string> names;
  const H5L_iterate_t add = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  file.good(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names), "list history of");
  return names;
}

std::vector<double> read_stats(const std::filesystem::path& path, const std::string& column) {
  const Hdf5File file = Hdf5File::reading(path, format);
  const Hdf5Quiet quiet;
  const std::string name = "history/" + dataset_name(column);
  const Hdf5Handle dataset(file.good(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), "find " + name + " in"), H5Dclose);
  return read_column(file, dataset);
}

}  // namespace puffin::output
