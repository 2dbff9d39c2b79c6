#include "tools/output/vtk_series.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tools/output/csv_file.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

std::string pvd_text(const std::vector<SeriesEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const auto& e : entries) {
    text += "    <DataSet timestep=\"" + shortest(e.time) + "\" group=\"\" part=\"" + std::to_string(e.part) +
            "\" file=\"" + e.file + "\"/>\n";
  }
  return text + "  </Collection>\n</VTKFile>\n";
}

/// The value of attribute `name` in one XML tag; empty if there is none.
std::string attribute(const std::string& tag, const std::string& name) {
  const std::size_t begin = tag.find(" " + name + "=\"");
  if (begin == std::string::npos) return {};
  const std::size_t value = begin + name.size() + 3;
  return tag.substr(value, tag.find('"', value) - value);
}

}  // namespace

std::vector<SeriesEntry> read_pvd(const fs::path& file) {
  demand_regular(file);
  std::ifstream stream(file);
  if (!stream) throw OutputError("cannot read " + file.string() + "; has this run written such output?");
  std::stringstream buffer;
  buffer << stream.rdbuf();
  const std::string text = buffer.str();
  if (text.find("type=\"Collection\"") == std::string::npos) throw OutputError(file.string() + " is no .pvd file");
  std::vector<SeriesEntry> entries;
  for (std::size_t at = text.find("<DataSet"); at != std::string::npos; at = text.find("<DataSet", at + 1)) {
    const std::string tag = text.substr(at, text.find('>', at) - at);
    entries.push_back({std::strtod(attribute(tag, "timestep").c_str(), nullptr),
                       std::atoi(attribute(tag, "part").c_str()), attribute(tag, "file")});
  }
  return entries;
}

VtkSeries::VtkSeries(fs::path folder, std::string name, std::optional<std::size_t> keep)
    : folder_(std::move(folder)), name_(std::move(name)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw OutputError("cannot create the folder " + folder_.string() + ": " + error.message());
  if (!keep || *keep == 0) return;
  const fs::path pvd = folder_ / (name_ + ".pvd");
  std::vector<SeriesEntry> old = read_pvd(pvd);
  if (old.size() < *keep) {
    throw OutputError(pvd.string() + " is shorter than its checkpoint says (" + std::to_string(old.size()) + " of " +
                      std::to_string(*keep) + " frames), so the run cannot be resumed; start it anew");
  }
  for (std::size_t n = 0; n < old.size(); ++n) {
    if (n >= *keep) {
      fs::remove(folder_ / fs::path(old[n].file).filename(), error);
      continue;
    }
    if (entries_.empty() || entries_.back().time != old[n].time) ++next_number_;
    entries_.push_back(std::move(old[n]));
  }
  write_whole(pvd, pvd_text(entries_));
}

std::string VtkSeries::next_file(double time, int part, const char* extension) {
  if (entries_.empty() || entries_.back().time != time) ++next_number_;
  char number[32];
  std::snprintf(number, sizeof number, "_%06d", next_number_ - 1);
  std::string file = name_ + number;
  if (part > 0) file.append("_").append(std::to_string(part));
  return file + extension;
}

void VtkSeries::commit(double time, int part, const std::string& file) {
  // The same part of the same moment again replaces the first: a final frame may fall on an output time.
  std::erase_if(entries_, [&](const SeriesEntry& e) { return e.time == time && e.part == part; });
  entries_.push_back({time, part, file});
  unsynced_.insert(folder_ / file);
  replace_whole(folder_ / (name_ + ".pvd"), pvd_text(entries_));
}

void VtkSeries::sync() {
  if (unsynced_.empty()) return;
  unsynced_.insert(folder_ / (name_ + ".pvd"));
  for (const fs::path& file : unsynced_)
    if (fs::exists(file)) sync_file(file);  // who takes frames away while it runs may
  unsynced_.clear();
}

void VtkSeries::append(double time, const FieldFrame& frame, int part) {
  const std::string file = next_file(time, part, ".vti");
  write_vti(folder_ / file, frame);
  commit(time, part, file);
}

void VtkSeries::append(double time, const CarrierFrame& frame, int part) {
  const std::string file = next_file(time, part, ".vtp");
  write_vtp(folder_ / file, frame);
  commit(time, part, file);
}

void VtkSeries::append(double time, const WallFrame& frame, int part) {
  const std::string file = next_file(time, part, ".vtp");
  write_vtp(folder_ / file, frame);
  commit(time, part, file);
}

}  // namespace puffin::output
