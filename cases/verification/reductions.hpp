#pragma once
// From a curve of a run to one number: the closed list of what a verification file may ask for.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace puffin::cases {

/// Pairs in the order of the output file.
struct Points {
  std::vector<double> x, y;
};

/// What some of the reductions need besides the points.
struct ReductionArguments {
  std::optional<double> at = {};         // value, quadratic-root (the root nearest to it): abscissa
  std::optional<double> level = {};      // crossing: of the ordinate, default 0
  std::optional<double> frequency = {};  // amplitude, phase: angular, [rad / unit of x]
  Points exact = {};                     // l2-error, max-error: what the points are compared with
};

enum class Reduction {
  value,
  first,
  last,
  mean,
  mean_half_width,
  sum,
  count,
  minimum,
  maximum,
  range,
  at_minimum,
  at_maximum,
  integral,
  slope,
  decay,
  spread,
  crossing,
  period,
  amplitude,
  phase,
  quadratic_root,
  l2_error,
  max_error,
};

struct ReductionName {
  std::string_view name;
  Reduction reduction;
  std::string_view what;  // one line for people
};
const std::vector<ReductionName>& reductions();

/// Throws std::invalid_argument if there are too few points or an argument is missing.
///   value           linear between the two points around `at`, rising or falling; outside the points it throws
///   first, last     ordinate of the first, last point
///   mean-half-width  half the 95 % confidence interval of the mean, by batch means of points equally far apart
///                   (coupling/statistics.hpp); NaN with fewer than 8 points
///   mean, sum, count, minimum, maximum, range    of the ordinates
///   at-minimum, at-maximum    abscissa of the extremum, from the parabola through it and its neighbours
///   integral        trapezoids over x
///   slope           least-squares line
///   decay           -slope of ln|y|
///   spread          second central moment of x with the weights y: sum y (x - m)^2 / sum y
///   crossing        abscissa of the first passage through `level`, linear between points
///   period          mean distance of the upward passages through the mean ordinate
///   amplitude, phase    a and b of y = c + a cos(frequency x + b), least squares; b in [rad], (-pi, pi]
///   quadratic-root  root of the least-squares parabola nearest to `at`
///   l2-error        sqrt(sum (y - e)^2 / sum e^2), e the exact ordinates; not relative if they are all 0
///   max-error       largest |y - e|; with an exact curve on its own abscissae, ours linear between its points
double reduce(Reduction kind, const Points& points, const ReductionArguments& arguments = {});

/// Order p of error = C h^p: least-squares slope of ln(error) over ln(h).
/// Throws std::invalid_argument for fewer than two sizes or an error that is not positive.
double fitted_order(const std::vector<double>& size, const std::vector<double>& error);

}  // namespace puffin::cases
