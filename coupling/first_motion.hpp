#pragma once
// When does the dose begin to move?

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "dem/carriers.hpp"

namespace puffin::coupling {

/// Watches for the first carrier that is farther than `distance` from its settled place. That place is where the
/// carrier first came to rest (asleep or stuck); until then, where it started: the gaps of a filled dose close by less
/// than `distance`. State: belongs in a checkpoint.
class FirstMotion {
 public:
  FirstMotion() = default;
  explicit FirstMotion(const dem::Carriers& carriers, double distance = 1e-3);  // [m]

  /// Call after each step of the carriers, before any are removed, until time() has a value; then it does nothing.
  void update(const dem::Carriers& carriers, double time);
  /// [s]; empty: nothing has moved yet.
  const std::optional<double>& time() const { return time_; }

  struct Place {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // [m]
    bool settled = false;
  };
  /// By carrier id.
  const std::vector<Place>& places() const { return places_; }
  void restore(std::vector<Place> places, std::optional<double> time);

 private:
  std::vector<Place> places_;
  double distance_ = 1e-3;
  std::optional<double> time_;
};

/// Ids of carriers index plain arrays. Throws std::invalid_argument unless they ascend from a value >= 0; returns the
/// length that such an array needs.
std::size_t id_range(const dem::Carriers& carriers);

/// Place of the carrier with that id, -1 if it is gone. Ids ascend.
int place_of(const dem::Carriers& carriers, std::int64_t id);

}  // namespace puffin::coupling
