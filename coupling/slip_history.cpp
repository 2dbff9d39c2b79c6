#include "coupling/slip_history.hpp"

namespace puffin::coupling {

RateSamples sample_rates(const micromodels::Law& law) {
  constexpr int each = 16;
  RateSamples samples;
  for (int n = 0; n < SlipHistory::octaves * SlipHistory::per_octave * each; ++n)
    samples.push_back(micromodels::rate(
        law, SlipHistory::lowest * std::exp2(n / static_cast<double>(each * SlipHistory::per_octave))));
  return samples;
}

}  // namespace puffin::coupling
