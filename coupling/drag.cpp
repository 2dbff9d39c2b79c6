#include "coupling/drag.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace puffin::coupling {

namespace {

template <std::size_t... I>
DragLaw find_law(std::string_view name, std::index_sequence<I...>) {
  DragLaw law;
  std::string known;
  bool found = false;
  const auto look_at = [&]<class Law>(Law candidate) {
    if (name == Law::name) {
      law = candidate;
      found = true;
    }
    known += known.empty() ? "" : ", ";
    known += Law::name;
  };
  (look_at(std::variant_alternative_t<I, DragLaw>{}), ...);
  if (!found) throw std::invalid_argument("unknown drag law '" + std::string(name) + "'; known: " + known);
  return law;
}

}  // namespace

DragLaw drag_law(std::string_view name) {
  return find_law(name, std::make_index_sequence<std::variant_size_v<DragLaw>>{});
}

void drag_coefficients(const DragLaw& law, const Air& air, std::span<const int> which,
                       std::span<const Eigen::Vector3d> air_velocity, std::span<const Eigen::Vector3d> velocity,
                       std::span<const double> single_radius, std::span<const double> carriers_in_parcel,
                       std::span<const double> solid_fraction, std::span<double> beta) {
  std::visit(
      [&](const auto& chosen) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, which.size(), 128), [&](const auto& range) {
          for (std::size_t n = range.begin(); n != range.end(); ++n) {
            const int p = which[n];
            const double slip = (air_velocity[p] - velocity[p]).norm();
            const double phi = solid_fraction.empty() ? 0.0 : solid_fraction[p];
            beta[p] = carriers_in_parcel[p] * drag_coefficient(chosen, air, 2.0 * single_radius[p], slip, phi);
          }
        });
      },
      law);
}

}  // namespace puffin::coupling
