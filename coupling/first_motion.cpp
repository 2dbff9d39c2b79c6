#include "coupling/first_motion.hpp"

#include <algorithm>
#include <stdexcept>

namespace puffin::coupling {

std::size_t id_range(const dem::Carriers& carriers) {
  std::int64_t last = -1;
  for (const std::int64_t id : carriers.id) {
    if (id <= last) throw std::invalid_argument("the ids of the carriers must ascend from 0");
    last = id;
  }
  return static_cast<std::size_t>(last + 1);
}

int place_of(const dem::Carriers& carriers, std::int64_t id) {
  const auto found = std::lower_bound(carriers.id.begin(), carriers.id.end(), id);
  return found != carriers.id.end() && *found == id ? static_cast<int>(found - carriers.id.begin()) : -1;
}

FirstMotion::FirstMotion(const dem::Carriers& carriers, double distance)
    : places_(id_range(carriers)), distance_(distance) {
  for (std::size_t i = 0; i < carriers.size(); ++i) places_[carriers.id[i]].position = carriers.position[i];
}

void FirstMotion::update(const dem::Carriers& carriers, double time) {
  if (time_) return;
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    Place& place = places_[carriers.id[i]];
    if ((carriers.position[i] - place.position).squaredNorm() > distance_ * distance_) {
      time_ = time;
      return;
    }
    if (!place.settled && (carriers.rest[i] == dem::Rest::asleep || carriers.rest[i] == dem::Rest::stuck))
      place = {carriers.position[i], true};
  }
}

void FirstMotion::restore(std::vector<Place> places, std::optional<double> time) {
  places_ = std::move(places);
  time_ = time;
}

}  // namespace puffin::coupling
