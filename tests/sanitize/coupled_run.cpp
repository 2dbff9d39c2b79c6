// A short coupled run for the sanitizers: the small dose in the L-bend, air, carriers and fines, without the program's
// output files.
//
// usage: coupled_run THREADS     prints what happened; exits 1 if something that is to be watched did not

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "cases/build.hpp"
#include "cases/read_case.hpp"
#include "coupling/checkpoint/checkpoint.hpp"
#include "coupling/health.hpp"
#include "tests/tools/run/small_dose.hpp"

using namespace puffin;

namespace {

int run(int threads) {
  const auto sim = cases::build(cases::parse_case(coarse_dose(), PUFFIN_SOURCE_DIR "/cases/small-dose.toml"));
  coupling::State& s = sim->state;
  const coupling::Health health(sim->models, s);
  const double end = sim->description.stop.time;
  int intervals = 0;
  for (; s.time < end * (1.0 - 1e-9); ++intervals) {
    coupling::advance(sim->models, end, s);
    if (intervals % 50 == 0) health.check(sim->models, s);
  }
  coupling::Checkpoint checkpoint;
  coupling::save(s, checkpoint);
  coupling::restore(checkpoint, s);
  coupling::advance(sim->models, s.time + s.scale.dt, s);
  health.check(sim->models, s);
  const coupling::Ledger books = coupling::ledger(s.fines, s.scalars, s.budget, 0);
  double contacts = 0.0;
  for (const double hits : s.collisions.contacts) contacts += hits;
  std::printf(
      "%d threads, %d intervals to %.4g s, %lld air steps, %zu parcels, %.0f contacts, in the air %.3g of the "
      "fines, ledger off by %.2g\n",
      threads, intervals, s.time, static_cast<long long>(s.air->steps), s.carriers.carriers.size(), contacts,
      books.in_air / books.loaded, books.error());
  const bool all_awake = contacts > 0.0 && books.in_air > 0.0 && std::abs(books.error()) < 1e-12;
  return all_awake ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  const int threads = argc > 1 ? std::atoi(argv[1]) : 2;
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  oneapi::tbb::task_arena arena(threads);  // of itself oneTBB uses no more threads than there are processors
  return arena.execute([&] { return run(threads); });
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
