#include "cases/air_assumption.hpp"

#include <algorithm>

namespace puffin::cases {

std::string air_assumption(const Case& c) {
  if (c.air.model != AirModel::lbm) return {};
  const Numerics& n = c.numerics;
  std::string text = "air: ";
  if (n.les == Les::none)
    text += "no turbulence model, the cells resolve the flow";
  else
    text += std::string(n.les == Les::vreman ? "Vreman" : "Smagorinsky") + " large-eddy simulation";
  const auto inlet = [](const Boundary& b) { return b.type == BoundaryType::velocity_inlet; };
  const auto rough = [](const Boundary& b) { return b.turbulence > 0.0; };
  if (std::any_of(c.air.boundaries.begin(), c.air.boundaries.end(), rough))
    text += ", synthetic turbulence at the inlet";
  else if (std::any_of(c.air.boundaries.begin(), c.air.boundaries.end(), inlet))
    text += ", no turbulence at the inlet";
  text += n.wall_model ? ", with a wall model" : ", no wall model";
  const auto of_thesis = [](const auto& given) { return given.first.starts_with("thesis."); };
  const bool beside_thesis = std::any_of(c.reference.begin(), c.reference.end(), of_thesis);
  if (n.les != Les::none && beside_thesis) text += "; the founding study used a k-epsilon model";
  return text;
}

}  // namespace puffin::cases
