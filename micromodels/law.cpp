#include "micromodels/law.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace puffin::micromodels {

namespace {

void check_speed(double speed) {
  if (!(speed >= 0.0))
    throw std::invalid_argument("micro-model: the speed must be a number >= 0, got " + std::to_string(speed));
}

double value(const PowerLaw& law, double speed, double) { return law.value(speed); }
double value(const TableLaw& law, double speed, double angle) { return law.value(speed, angle); }
double value(const WeibullLaw& law, double speed, double) { return law.value(speed); }
double value(const LiftOffLaw& law, double speed, double) { return law.value(speed); }

}  // namespace

double fraction(const Law& law, double speed, double angle) {
  check_speed(speed);
  return std::clamp(std::visit([&](const auto& l) { return value(l, speed, angle); }, law), 0.0, 1.0);
}

double rate(const Law& law, double slip_speed) {
  check_speed(slip_speed);
  if (!gives_rate(law))
    throw std::invalid_argument("a " + name(law) + " law knows impacts, not rates; use power or table");
  return std::visit([&](const auto& l) { return value(l, slip_speed, head_on); }, law);
}

bool gives_rate(const Law& law) {
  return std::holds_alternative<PowerLaw>(law) || std::holds_alternative<TableLaw>(law);
}

const Validity& valid(const Law& law) {
  return std::visit([](const auto& l) -> const Validity& { return l.valid(); }, law);
}

std::string name(const Law& law) {
  static const std::array<const char*, 4> names{"power", "table", "weibull", "lift-off"};
  static_assert(std::variant_size_v<Law> == 4);
  return names[law.index()];
}

}  // namespace puffin::micromodels
