#include "coupling/exchange_interval.hpp"

#include <algorithm>

#include "coupling/air_steps.hpp"
#include "coupling/drag_limit.hpp"

namespace puffin::coupling {

bool all_asleep(const dem::Carriers& carriers) {
  return std::none_of(carriers.rest.begin(), carriers.rest.end(), [](dem::Rest r) { return r == dem::Rest::awake; });
}

int most_steps(const Models& models, const State& s) {
  if (s.carriers.carriers.size() == 0) return models.steps_per_exchange_asleep;
  const int most = all_asleep(s.carriers.carriers) ? models.steps_per_exchange_asleep : models.steps_per_exchange;
  if (!computes_air(models, s) || !models.two_way) return most;
  const double step = s.load_rate * s.scale.dt;  // load of one step
  int steps = 1;
  while (steps < most && (steps + 1) * step <= largest_load(steps + 1)) ++steps;
  return steps;
}

}  // namespace puffin::coupling
