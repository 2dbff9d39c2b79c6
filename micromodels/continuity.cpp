#include "micromodels/continuity.hpp"

#include <cmath>

namespace puffin::micromodels {

Jump jump(const Law& law) {
  const auto* power = std::get_if<PowerLaw>(&law);
  if (!power) return {};
  const double at = power->constants()[2];
  if (at == 0.0) return {};  // one branch
  const double height = power->jump();
  return {at, std::abs(height) <= 1e-12 * power->value(at) ? 0.0 : height};
}

}  // namespace puffin::micromodels
