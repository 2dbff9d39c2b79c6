#include "micromodels/table_law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puffin::micromodels {

namespace {

void check_rising(const std::vector<double>& x, const char* what) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i]) || x[i] < 0.0 || (i > 0 && x[i] <= x[i - 1]))
      throw std::invalid_argument(std::string("table: the ") + what + " must be >= 0 and rise from row to row (entry " +
                                  std::to_string(i + 1) + ")");
}

}  // namespace

TableLaw::TableLaw(std::vector<double> speeds, std::vector<double> angles, std::vector<double> values, bool may_fall,
                   Validity valid)
    : speeds_(std::move(speeds)), angles_(std::move(angles)), values_(std::move(values)), valid_(valid) {
  if (speeds_.empty()) throw std::invalid_argument("table: no rows");
  check_rising(speeds_, "speeds");
  check_rising(angles_, "angles");
  if (angles_.empty()) angles_ = {90.0};
  if (values_.size() != speeds_.size() * angles_.size())
    throw std::invalid_argument("table: every speed needs a value for every angle (" +
                                std::to_string(speeds_.size() * angles_.size()) + " values, found " +
                                std::to_string(values_.size()) + ")");
  for (std::size_t n = 0; n < values_.size(); ++n) {
    const std::string row = "table: speed " + std::to_string(speeds_[n / angles_.size()]) + " m/s: ";
    if (!std::isfinite(values_[n]) || values_[n] < 0.0)
      throw std::invalid_argument(row + "the value must be a number >= 0");
    if (speeds_[n / angles_.size()] == 0.0 && values_[n] != 0.0)
      throw std::invalid_argument(row + "nothing can be taken at rest");
    if (!may_fall && n >= angles_.size() && values_[n] < values_[n - angles_.size()])
      throw std::invalid_argument(row + "the value falls with the speed; set may_fall if that is meant");
  }
}

double TableLaw::at_angle(std::size_t speed, double angle) const {
  const double* row = values_.data() + speed * angles_.size();
  if (angle <= angles_.front()) return row[0];
  if (angle >= angles_.back()) return row[angles_.size() - 1];
  const std::size_t j = std::upper_bound(angles_.begin(), angles_.end(), angle) - angles_.begin();
  const double t = (angle - angles_[j - 1]) / (angles_[j] - angles_[j - 1]);
  return (1.0 - t) * row[j - 1] + t * row[j];
}

double TableLaw::value(double speed, double angle) const {
  if (speed >= speeds_.back()) return at_angle(speeds_.size() - 1, angle);
  const std::size_t i = std::upper_bound(speeds_.begin(), speeds_.end(), speed) - speeds_.begin();
  if (i == 0) return speed / speeds_[0] * at_angle(0, angle);
  const double t = (speed - speeds_[i - 1]) / (speeds_[i] - speeds_[i - 1]);
  return (1.0 - t) * at_angle(i - 1, angle) + t * at_angle(i, angle);
}

}  // namespace puffin::micromodels
