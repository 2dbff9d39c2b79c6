#pragma once
// Values that several tables of a case file share.

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

namespace puffin::cases {

using Vec3 = Eigen::Vector3d;

/// A value of a free-form table (generator parameters, reference numbers): numbers are SI.
using Parameter = std::variant<double, std::vector<double>, std::string, bool>;

/// A quantity over time, linear between the rows and constant outside them. One row is a constant.
struct TimeTable {
  std::vector<double> time;   // [s], strictly increasing
  std::vector<double> value;  // same length
  double at(double t) const;
  bool operator==(const TimeTable&) const = default;
};

}  // namespace puffin::cases
