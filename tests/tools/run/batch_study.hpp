#pragma once
// A folder with a small case, in which tests run `puffin batch`.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>

namespace puffin::test {

namespace fs = std::filesystem;

/// 320 cells and some 100 steps: a run of milliseconds.
inline constexpr const char* duct = R"toml(
schema = 1
name = "duct"
[geometry]
generator = "duct"
[geometry.duct]
length = "10 mm"
width = "2 mm"
height = "2 mm"
[air]
density = 1.2
viscosity = 1.8e-5
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
velocity = "5 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.5 mm"
[stop]
time = "1 ms"
[output]
statistics = "0.1 ms"
[reference.thesis]
static_drop = 100
)toml";

class BatchStudy : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("puffin-batch-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    file("case.toml", duct);
  }
  /// Runs whose batch was killed may still be writing their last checkpoint.
  void TearDown() override {
    std::error_code busy;
    for (int n = 0; n < 100; ++n) {
      fs::remove_all(folder_, busy);
      if (!busy) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  void file(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string text(const std::string& name) const {
    std::ifstream stream(folder_ / name);
    std::stringstream all;
    all << stream.rdbuf();
    return all.str();
  }
  int shell(const std::string& command) const {
    return WEXITSTATUS(std::system(("cd " + folder_.string() + " && " + command).c_str()));
  }
  int batch(const std::string& arguments) const {
    return shell(std::string(PUFFIN_BINARY_DIR) + "/puffin batch study.toml --out out " + arguments +
                 " > json.txt 2>> log.txt");
  }
  /// The same, stopped when its run `a` has a checkpoint.
  void stop_at_checkpoint(const std::string& arguments) const {
    shell("(" + std::string(PUFFIN_BINARY_DIR) + "/puffin batch study.toml --out out " + arguments +
          " > /dev/null 2>> log.txt & for n in $(seq 2000); do if ls out/a/seed-1/checkpoints/*.bin > /dev/null 2>&1; "
          "then break; fi; sleep 0.01; done; kill -TERM $!; wait $!)");
  }
  fs::path folder_;
};

}  // namespace puffin::test
