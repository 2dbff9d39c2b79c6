// puffin doctor: is this machine fit, and do the libraries do what is needed of them?

#include <oneapi/tbb/info.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <thread>

#include "cases/read_case.hpp"
#include "cases/search_path.hpp"
#include "lbm/isa.hpp"
#include "tools/output/render.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/output/vtk_series.hpp"
#include "tools/puffin/calibration.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown";
}

std::string instruction_set() {
  const lbm::Isa isa = lbm::detect_isa(), best = lbm::hardware_isa();
  std::string text = lbm::name(isa);
  if (isa != best) text += std::string(" (PUFFIN_ISA; the processor offers ") + lbm::name(best) + ")";
  return text;
}

/// A folder of its own that goes away with it.
class Scratch {
 public:
  Scratch() : path_(std::filesystem::temp_directory_path() / ("puffin-doctor-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Scratch() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes a small block of cells and reads it back.
void test_vtk(const std::filesystem::path& folder) {
  output::FieldFrame frame;
  frame.dx = 1.0;
  frame.size = {2, 2, 2};
  frame.fluid.assign(8, 1);
  frame.pressure = {0, 1, 2, 3, 4, 5, 6, 7};
  output::write_vti(folder / "test.vti", frame);
  if (output::read_field_frame(folder / "test.vti").pressure != frame.pressure)
    throw std::runtime_error("what was read is not what was written");
}

/// Writes a column of a history and reads it back.
void test_hdf5(const std::filesystem::path& folder) {
  {
    output::StatsFile file(folder / "test.h5", {{"time", "s"}, {"value", "1"}});
    for (const double t : {0.0, 1.0, 2.0}) file.append(std::array{t, t * t});
    file.flush();
  }
  if (output::read_stats(folder / "test.h5", "value") != std::vector<double>{0.0, 1.0, 4.0})
    throw std::runtime_error("what was read is not what was written");
}

/// Paints a triangle as the geometry view of a run and looks for a picture.
void test_picture(const std::filesystem::path& folder) {
  output::WallFrame wall;
  wall.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  wall.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  wall.patch = {0, 0, 0, 0};
  wall.patches = {{"wall", false}};
  output::VtkSeries(folder / "vtk", "walls").append(0.0, wall);
  const output::RenderOptions options;
  output::render(folder, output::View::geometry, {}, folder / "test.png", options);
  if (std::filesystem::file_size(folder / "test.png") == 0) throw std::runtime_error("the picture is empty");
}

bool tell(const std::string& name, const std::function<std::string()>& test) {
  try {
    print(name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') + test());
    return true;
  } catch (const std::exception& e) {
    print(name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') + "FAILED: " + e.what());
    return false;
  }
}

/// Room for a run of a device at the default cell and for its files.
constexpr double least_memory = 1e9, least_disk = 1e9;  // [byte]

std::string memory() {
  const double bytes = available_memory();
  if (bytes < least_memory)
    throw std::runtime_error(as_bytes(bytes) + " available; a device at the default cell needs about " +
                             as_bytes(least_memory) + ": end other programs, or take a larger dx");
  return as_bytes(bytes) + " available";
}

std::string disk() {
  const std::filesystem::path here = std::filesystem::current_path();
  if (access(here.c_str(), W_OK) != 0)
    throw std::runtime_error(here.string() + " cannot be written: results need another place, with --out");
  const auto bytes = static_cast<double>(std::filesystem::space(here).available);
  if (bytes < least_disk)
    throw std::runtime_error(as_bytes(bytes) + " free in " + here.string() +
                             "; pictures and checkpoints of a run take " + "up to " + as_bytes(least_disk) +
                             ": free some, or choose another place with --out");
  return as_bytes(bytes) + " free in " + here.string();
}

std::string threads() {
  const int usable = oneapi::tbb::info::default_concurrency();
  const auto present = static_cast<int>(std::thread::hardware_concurrency());
  std::string text = std::to_string(usable);
  if (usable < present) text += " of " + std::to_string(present) + " (taskset or a container holds back the others)";
  return text;
}

int doctor() {
  bool fit = true, well = true;
  std::optional<Scratch> scratch;
  fit &= tell("scratch", [&]() -> std::string {
    try {
      scratch.emplace();
    } catch (const std::filesystem::filesystem_error& e) {
      throw std::runtime_error(std::string(e.code().message()) + ": set TMPDIR to a folder that can be written");
    }
    return scratch->path().parent_path().string() + " can be written";
  });
  well &= tell("processor", processor);
  well &= tell("kernel", instruction_set);
  well &= tell("threads", threads);
  fit &= tell("memory", memory);
  fit &= tell("disk", disk);
  well &= tell("bandwidth", [] { return four_digits(memory_bandwidth() / 1e9) + " GB/s"; });
  well &= tell("lattice", [] {
    cases::Numerics n;
    n.smagorinsky_constant = 0.1;
    n.hrr_sigma = 0.98;
    const double speed = calibrate(n).updates_per_second;
    return four_digits(speed / 1e6) + " million cells a second (rr3, smagorinsky, float)";
  });
  if (!scratch) return resources;  // the libraries are tested by writing
  well &= tell("vtk", [&] { return test_vtk(scratch->path()), "writes and reads"; });
  well &= tell("hdf5", [&] { return test_hdf5(scratch->path()), "writes and reads"; });
  well &= tell("pictures", [&] { return test_picture(scratch->path()), "painted without a display"; });
  well &= tell("micromodels", [] {
    for (const std::string& folder : cases::micromodel_directories())
      if (std::filesystem::is_directory(folder)) return folder;
    throw std::runtime_error("none of the folders of shipped micro-models is there: install Puffin anew, or name " +
                             std::string("micro-model files by their whole path"));
  });
  return !well ? internal_error : fit ? ok : resources;
}

}  // namespace

namespace commands {
Command doctor() {
  return {"doctor", "processor, instruction set, threads, memory, libraries: a self-test",
          [](CLI::App&) -> Action { return [] { return puffin::tools::doctor(); }; }};
}
}  // namespace commands

}  // namespace puffin::tools
