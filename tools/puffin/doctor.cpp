// puffin doctor: is this machine fit, and do the libraries do what is needed of them?

#include <oneapi/tbb/info.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>

#include "cases/read_case.hpp"
#include "cases/search_path.hpp"
#include "lbm/kernel.hpp"
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
  switch (lbm::detect_isa()) {
    case lbm::Isa::avx512:
      return "avx512";
    case lbm::Isa::avx2:
      return "avx2";
    case lbm::Isa::baseline:
      break;
  }
  return "baseline";
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

int doctor() {
  const Scratch scratch;
  bool well = true;
  well &= tell("processor", processor);
  well &= tell("kernel", instruction_set);
  well &= tell("threads", [] { return std::to_string(oneapi::tbb::info::default_concurrency()); });
  well &= tell("memory", [] { return as_bytes(available_memory()) + " available"; });
  well &= tell("bandwidth", [] { return four_digits(memory_bandwidth() / 1e9) + " GB/s"; });
  well &= tell("lattice", [] {
    cases::Numerics n;
    n.smagorinsky_constant = 0.1;
    n.hrr_sigma = 0.98;
    const double speed = calibrate(n).updates_per_second;
    return four_digits(speed / 1e6) + " million cells a second (rr3, smagorinsky, float)";
  });
  well &= tell("vtk", [&] { return test_vtk(scratch.path()), "writes and reads"; });
  well &= tell("hdf5", [&] { return test_hdf5(scratch.path()), "writes and reads"; });
  well &= tell("pictures", [&] { return test_picture(scratch.path()), "painted without a display"; });
  well &= tell("micromodels", [] {
    for (const std::string& folder : cases::micromodel_directories())
      if (std::filesystem::is_directory(folder)) return folder;
    throw std::runtime_error("none of the folders of shipped micro-models is there");
  });
  return well ? ok : internal_error;
}

}  // namespace

namespace commands {
Command doctor() {
  return {"doctor", "processor, instruction set, threads, memory, libraries: a self-test",
          [](CLI::App&) -> Action { return [] { return puffin::tools::doctor(); }; }};
}
}  // namespace commands

}  // namespace puffin::tools
