#include "tools/bench/dem_bench.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <chrono>

#include "dem/advance.hpp"
#include "tools/bench/dem_scenes.hpp"
#include "tools/bench/liggghts.hpp"
#include "tools/bench/machine.hpp"

namespace puffin::bench {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::int64_t live_contacts(const dem::State& state) {
  return static_cast<std::int64_t>(state.contacts.size() - state.free_contacts.size());
}

}  // namespace

DemRow measure_dem(const DemSetting& setting, double seconds, bool compare) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, setting.threads);
  const DemScene scene = dem_scene(setting.scene, setting.carriers);
  dem::State state;
  dem::add(scene.carriers, state);
  const std::vector<dem::Load> loads(scene.carriers.size());
  dem::Events events;
  const auto step = [&] {
    events.clear();
    dem::advance(scene.step, scene.models, scene.walls, loads, state, events);
  };
  int warm_up = 2;
  if (setting.scene == "resting")  // until it sleeps
    for (; warm_up < 2000 && dem::count_asleep(state) < state.carriers.size(); ++warm_up) step();
  else
    for (int n = 0; n < warm_up; ++n) step();

  DemRow row;
  row.setting = setting;
  const ForeignLoad foreign;
  const auto begin = Clock::now();
  const std::int64_t before = state.statistics.contact_steps;
  double evaluated = 0.0;
  std::int64_t steps = 0, last = before;
  while (steps < 2 || (row.seconds = seconds_since(begin)) < seconds) {
    step();
    ++steps;
    evaluated += static_cast<double>((state.statistics.contact_steps - last) * live_contacts(state)) /
                 static_cast<double>(setting.carriers);
    last = state.statistics.contact_steps;
  }
  row.seconds = seconds_since(begin);
  row.foreign_load = foreign.share();
  const double count = static_cast<double>(setting.carriers), done = static_cast<double>(steps);
  row.particle_steps_per_second = count * done * scene.step / scene.contact_step / row.seconds;
  row.substeps_per_second = static_cast<double>(state.statistics.contact_steps - before) / row.seconds;
  row.contacts_per_second = evaluated / row.seconds;
  row.contacts_per_carrier = static_cast<double>(live_contacts(state)) / count;
  row.nanoseconds_per_carrier = 1e9 * row.seconds / (done * count);
  if (compare && liggghts_installed()) {
    row.liggghts_particle_steps_per_second = liggghts_speed(scene, setting.threads, seconds);
    if (row.liggghts_particle_steps_per_second > 0.0)
      row.ratio = row.particle_steps_per_second / row.liggghts_particle_steps_per_second;
  }
  return row;
}

std::vector<DemRow> dem_benchmark(bool quick, std::vector<std::int64_t> sizes,
                                  const std::function<void(const DemRow&)>& row_done) {
  if (sizes.empty())
    sizes = quick ? std::vector<std::int64_t>{2500, 25000} : std::vector<std::int64_t>{2500, 25000, 250000};
  std::vector<DemRow> rows;
  for (const char* scene : {"dense", "dilute", "resting"})
    for (const std::int64_t carriers : sizes)
      for (const int threads : {1, 2}) {
        if (threads > oneapi::tbb::info::default_concurrency()) continue;
        const bool other_has_it = std::string(scene) != "resting";         // nothing sleeps there
        if (quick && !other_has_it && carriers > sizes.front()) continue;  // a large bed takes minutes to fall asleep
        rows.push_back(measure_dem({scene, carriers, threads}, quick ? 0.5 : 2.0, !quick && other_has_it));
        if (row_done) row_done(rows.back());
      }
  return rows;
}

}  // namespace puffin::bench
