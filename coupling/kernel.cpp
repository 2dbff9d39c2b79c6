#include "coupling/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puffin::coupling {

double roma(double r) {
  r = std::abs(r);
  if (r <= 0.5) return (1.0 + std::sqrt(1.0 - 3.0 * r * r)) / 3.0;
  if (r >= 1.5) return 0.0;
  const double inner = 1.0 - r;
  return (5.0 - 3.0 * r - std::sqrt(std::max(0.0, 1.0 - 3.0 * inner * inner))) / 6.0;
}

Kernel::Kernel(double diameter_in_cells) : diameter_(diameter_in_cells) {
  if (!(diameter_in_cells >= 0.0) || diameter_in_cells > 9.0)
    throw std::invalid_argument(
        "a carrier of " + std::to_string(diameter_in_cells) +
        " cells in diameter cannot be coupled by a kernel (0 to 9); use a larger dx or smaller parcels");
  if (diameter_ <= 1.0) {
    nodes_ = {{0.0, 1.0}};
    return;
  }
  const double variance = roma_variance * (diameter_ * diameter_ - 1.0);  // of G, so B = sqrt(7 variance)
  const double half_width = std::sqrt(7.0 * variance);
  const int count = std::max(2, static_cast<int>(std::ceil(4.0 * half_width)));
  double sum = 0.0, second = 0.0;
  for (int n = 0; n < count; ++n) {
    const double s = (2.0 * n + 1.0) / count - 1.0;
    const double weight = (1.0 - s * s) * (1.0 - s * s);
    nodes_.push_back({s, weight});
    sum += weight;
    second += weight * s * s;
  }
  const double stretch = std::sqrt(variance * sum / second);  // makes the variance of the nodes exact
  double farthest = 0.0;
  for (Node& node : nodes_) {
    node.shift *= stretch;
    node.weight /= sum;
    farthest = std::max(farthest, node.shift);
  }
  reach_ = static_cast<int>(std::ceil(1.5 + farthest - 0.5 - 1e-12));
}

void Kernel::weights(double offset, double* weights) const {
  if (reach_ == 1 && nodes_.size() == 1 && std::abs(offset) <= 0.5) {  // Roma's own: the two sums give the outer ones
    weights[1] = roma(offset);
    weights[0] = 0.5 * (1.0 - weights[1] - offset);
    weights[2] = 0.5 * (1.0 - weights[1] + offset);
    return;
  }
  for (int j = -reach_; j <= reach_; ++j) weights[j + reach_] = 0.0;
  for (const Node& node : nodes_) {
    const double at = offset + node.shift;
    const int nearest = static_cast<int>(std::lround(at));
    for (int j = nearest - 1; j <= nearest + 1; ++j)
      if (j >= -reach_ && j <= reach_) weights[j + reach_] += node.weight * roma(j - at);
  }
}

}  // namespace puffin::coupling
