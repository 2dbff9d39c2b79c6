#include "tools/bench/liggghts.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace puffin::bench {
namespace {

namespace fs = std::filesystem;

/// A modulus whose Hertz contact lasts about as long as the scene's linear one: the step is as safe for it.
constexpr double modulus = 5e6;  // [Pa]

/// A skin that lasts about a hundred steps at the scene's speeds, at least a tenth of the diameter.
double skin(const DemScene& scene) {
  double fastest = 0.0;
  for (const dem::Carrier& c : scene.carriers) fastest = std::max(fastest, c.velocity.norm());
  return std::max(0.2 * scene.carriers.front().radius, 200.0 * fastest * scene.contact_step);
}

void write_input(const DemScene& scene, const fs::path& folder, std::int64_t steps) {
  std::ofstream data(folder / "carriers.data");
  data.precision(17);
  const Eigen::Vector3d size = scene.walls.size();
  data << "carriers\n\n" << scene.carriers.size() << " atoms\n1 atom types\n";
  const char* axes[] = {"x", "y", "z"};
  for (int d = 0; d < 3; ++d) data << 0.0 << ' ' << size[d] << ' ' << axes[d] << "lo " << axes[d] << "hi\n";
  data << "\nAtoms\n\n";  // id type diameter density x y z
  for (const dem::Carrier& c : scene.carriers) {
    const double r3 = c.radius * c.radius * c.radius;
    data << c.id + 1 << " 1 " << 2.0 * c.radius << ' ' << c.mass / (4.0 / 3.0 * 3.14159265358979323846 * r3);
    for (int d = 0; d < 3; ++d) data << ' ' << c.position[d];
    data << '\n';
  }
  data << "\nVelocities\n\n";
  for (const dem::Carrier& c : scene.carriers) {
    data << c.id + 1;
    for (int d = 0; d < 3; ++d) data << ' ' << c.velocity[d];
    data << " 0 0 0\n";
  }
  std::ofstream in(folder / "in.carriers");
  in.precision(17);
  in << "atom_style granular\natom_modify map array\nboundary f f f\nnewton off\ncommunicate single vel yes\nunits si\n"
        "read_data carriers.data\n"
     << "neighbor " << skin(scene) << " bin\nneigh_modify delay 0\n"
     << "fix m1 all property/global youngsModulus peratomtype " << modulus << "\n"
     << "fix m2 all property/global poissonsRatio peratomtype 0.3\n"
        "fix m3 all property/global coefficientRestitution peratomtypepair 1 0.6\n"
        "fix m4 all property/global coefficientFriction peratomtypepair 1 0.3\n"
        "fix m5 all property/global cohesionEnergyDensity peratomtypepair 1 1e3\n"
        "pair_style gran model hertz tangential history cohesion sjkr\npair_coeff * *\n"
     << "timestep " << scene.contact_step << "\n";
  for (int d = 0; d < 3; ++d)
    for (const double wall : {0.0, size[d]})
      in << "fix w" << axes[d] << (wall > 0.0)
         << " all wall/gran model hertz tangential history cohesion sjkr primitive "
         << "type 1 " << axes[d] << "plane " << wall << "\n";
  in << "fix move all nve/sphere\nthermo 1000000\nrun 10\nrun " << steps << "\n";
}

/// The loop time [s] of the last run, 0 if there was none.
double loop_time(const fs::path& folder, int processes) {
  const std::string mpi =
      processes > 1 ? "mpirun --allow-run-as-root --oversubscribe -np " + std::to_string(processes) : "";
  const std::string command = "cd '" + folder.string() + "' && " + mpi + " liggghts -in in.carriers 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) return 0.0;
  double seconds = 0.0;
  char line[512];
  while (std::fgets(line, sizeof line, pipe.get()) != nullptr) std::sscanf(line, "Loop time of %lf", &seconds);
  return seconds;
}

}  // namespace

bool liggghts_installed() { return std::system("command -v liggghts >/dev/null 2>&1") == 0; }

double liggghts_speed(const DemScene& scene, int processes, double seconds) {
  std::string name = (fs::temp_directory_path() / "puffin-bench-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) return 0.0;
  const fs::path folder(name);
  const double count = static_cast<double>(scene.carriers.size());
  std::int64_t steps = 20;
  double speed = 0.0;
  for (int trial = 0; trial < 2; ++trial) {  // the first finds how many steps fill the time
    write_input(scene, folder, steps);
    const double time = loop_time(folder, processes);
    if (!(time > 0.0)) break;
    speed = count * static_cast<double>(steps) / time;
    if (time > 0.5 * seconds) break;
    steps = static_cast<std::int64_t>(seconds * speed / count) + 1;
  }
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return speed;
}

}  // namespace puffin::bench
