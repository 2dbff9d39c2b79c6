#pragma once
// What a kind of shape has to say: its parameters, its checks, its faces. The catalogue holds one of these per kind.

#include <string>
#include <vector>

#include "cases/generators/generators.hpp"
#include "cases/generators/surface.hpp"

namespace puffin::cases::generators {

using lbm::geometry::Vec3;

/// Complete parameters, read by name; every name and type has been checked against the kind's list.
class Values {
 public:
  explicit Values(Parameters& parameters) : parameters_(&parameters) {}
  double number(const std::string& name) const { return std::get<double>(parameters_->at(name)); }
  const std::vector<double>& numbers(const std::string& name) const {
    return std::get<std::vector<double>>(parameters_->at(name));
  }
  const std::string& word(const std::string& name) const { return std::get<std::string>(parameters_->at(name)); }
  bool flag(const std::string& name) const { return std::get<bool>(parameters_->at(name)); }
  void set(const std::string& name, ParameterValue value) { parameters_->at(name) = std::move(value); }

 private:
  Parameters* parameters_;
};

using Problems = std::vector<ParameterProblem>;

struct Kind {
  std::string name;
  std::string summary;
  std::vector<ParameterInfo> parameters;
  /// Fills what is derived (free lengths, automatic sizes) and reports what does not fit together.
  void (*complete)(Values&, Problems&);
  void (*add_faces)(const Values&, Surface&);
  KeyPoints (*key_points)(const Values&);
};

Kind l_bend_kind();
Kind omega_bend_kind();
Kind duct_kind();
Kind step_kind();
Kind box_kind();
Kind pipe_kind();
Kind bend_kind();
Kind obstacle_kind();

/// The `facet_size` parameter, with its default [m]; 0: chosen from the shape.
ParameterInfo facet_size_info(double default_value);

/// Replaces a facet_size of 0 by `automatic` [m].
void choose_facet_size(Values& values, double automatic);

/// "1.5 mm": a length as people read it.
std::string millimetres(double length);

}  // namespace puffin::cases::generators
