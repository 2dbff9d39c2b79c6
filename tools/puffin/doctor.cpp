// puffin doctor: is this machine fit, and do the libraries do what is needed of them?

#include <oneapi/tbb/info.h>
#include <sys/utsname.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <new>
#include <optional>
#include <thread>

#include "cases/read_case.hpp"
#include "cases/search_path.hpp"
#include "lbm/isa.hpp"
#include "tools/output/render.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/output/vtk_series.hpp"
#include "tools/puffin/available_memory.hpp"
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

std::string system(bool proc) {
  if (!proc)
    throw std::runtime_error(
        "/proc is not mounted: the memory that caches would give back is not counted, the program does not find the " +
        std::string("cases that came with it, and studies do not run: mount -t proc proc /proc"));
  utsname of{};
  return uname(&of) == 0 ? of.sysname + std::string(" ") + of.release : "unknown";
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

/// What the checks came to: the machine lacks something, or the program does.
struct Verdict {
  bool fit = true, well = true;
};

/// Runs a check and prints its line. What fails for want of memory, or a check of a `resource`, speaks against the
/// machine.
void tell(const std::string& name, bool resource, Verdict& verdict, const std::function<std::string()>& test) {
  const std::string label = name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ');
  try {
    print(label + test());
  } catch (const std::bad_alloc&) {
    print(label + "FAILED: not enough memory");
    verdict.fit = false;
  } catch (const std::exception& e) {
    print(label + "FAILED: " + e.what());
    (resource ? verdict.fit : verdict.well) = false;
  }
}

/// Room for a run of a device at the default cell and for its files.
constexpr double least_memory = 1e9, least_disk = 1e9, least_scratch = 1e7;  // [byte]

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
  Verdict v;
  std::optional<Scratch> scratch;
  tell("scratch", true, v, [&]() -> std::string {
    try {
      scratch.emplace();
    } catch (const std::filesystem::filesystem_error& e) {
      throw std::runtime_error(std::string(e.code().message()) + ": set TMPDIR to a folder that can be written");
    }
    const auto bytes = static_cast<double>(std::filesystem::space(scratch->path()).available);
    if (bytes < least_scratch) {
      const std::string where = scratch->path().parent_path();
      scratch.reset();
      throw std::runtime_error(as_bytes(bytes) + " free in " + where + ": set TMPDIR to a folder with more room");
    }
    return scratch->path().parent_path().string() + " can be written";
  });
  const bool proc = std::filesystem::exists("/proc/self/exe");
  tell("system", true, v, [&] { return system(proc); });
  tell("processor", false, v, processor);
  tell("kernel", false, v, instruction_set);
  tell("threads", false, v, threads);
  tell("memory", true, v, memory);
  tell("disk", true, v, disk);
  tell("bandwidth", false, v, [] { return four_digits(memory_bandwidth() / 1e9) + " GB/s"; });
  tell("lattice", false, v, [] {
    cases::Numerics n;
    n.smagorinsky_constant = 0.1;
    n.hrr_sigma = 0.98;
    const double speed = calibrate(n).updates_per_second;
    return four_digits(speed / 1e6) + " million cells a second (rr3, smagorinsky, float)";
  });
  if (!scratch) return resources;  // the libraries are tested by writing
  tell("vtk", false, v, [&] { return test_vtk(scratch->path()), "writes and reads"; });
  tell("hdf5", false, v, [&] { return test_hdf5(scratch->path()), "writes and reads"; });
  tell("pictures", false, v, [&] { return test_picture(scratch->path()), "painted without a display"; });
  tell("micromodels", !proc, v, [] {
    for (const std::string& folder : cases::micromodel_directories())
      if (std::filesystem::is_directory(folder)) return folder;
    throw std::runtime_error("none of the folders of shipped micro-models is there: install Puffin anew, or name " +
                             std::string("micro-model files by their whole path"));
  });
  return !v.well ? internal_error : v.fit ? ok : resources;
}

}  // namespace

namespace commands {
Command doctor() {
  return {"doctor", "processor, instruction set, threads, memory, libraries: a self-test",
          [](CLI::App&) -> Action { return [] { return puffin::tools::doctor(); }; }};
}
}  // namespace commands

}  // namespace puffin::tools
