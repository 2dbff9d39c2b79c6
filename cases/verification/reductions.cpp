#include "cases/verification/reductions.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "coupling/statistics.hpp"

namespace puffin::cases {
namespace {

void need(bool enough, const std::string& what) {
  if (!enough) throw std::invalid_argument(what);
}

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }
double mean(const std::vector<double>& v) { return sum(v) / static_cast<double>(v.size()); }

/// The ordinate between the points around x; the points' abscissae rise, or fall (a profile read downwards).
double interpolate(const Points& p, double x) {
  need(p.x.size() >= 2, "a value between points needs at least two of them");
  if (p.x.front() > p.x.back()) return interpolate({{p.x.rbegin(), p.x.rend()}, {p.y.rbegin(), p.y.rend()}}, x);
  const double reach = 1e-9 * (p.x.back() - p.x.front());
  need(x >= p.x.front() - reach && x <= p.x.back() + reach,
       "the abscissa " + std::to_string(x) + " lies outside the points, " + std::to_string(p.x.front()) + " to " +
           std::to_string(p.x.back()));
  const auto above = std::upper_bound(p.x.begin() + 1, p.x.end() - 1, x);
  const std::size_t i = static_cast<std::size_t>(above - p.x.begin());
  const double share = (x - p.x[i - 1]) / (p.x[i] - p.x[i - 1]);
  return p.y[i - 1] + share * (p.y[i] - p.y[i - 1]);
}

/// Abscissa of the vertex of the parabola through the extreme point and its neighbours.
double at_extremum(const Points& p, std::size_t i) {
  if (i == 0 || i + 1 == p.x.size()) return p.x[i];
  const double left = p.x[i] - p.x[i - 1], right = p.x[i + 1] - p.x[i];
  const double rise = (p.y[i] - p.y[i - 1]) / left, fall = (p.y[i + 1] - p.y[i]) / right;
  if (rise == fall) return p.x[i];
  return p.x[i] - 0.5 * (rise * right + fall * left) / (fall - rise);
}

/// Least-squares coefficients of y over the columns of `basis`.
Eigen::VectorXd fit(const Eigen::MatrixXd& basis, const std::vector<double>& y) {
  return basis.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<int>(y.size())));
}

double slope(const std::vector<double>& x, const std::vector<double>& y) {
  need(x.size() >= 2, "a slope needs at least two points");
  const double mx = mean(x), my = mean(y);
  double xy = 0.0, xx = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mx) * (y[i] - my);
    xx += (x[i] - mx) * (x[i] - mx);
  }
  need(xx > 0.0, "a slope needs points at different abscissae");
  return xy / xx;
}

double decay(const Points& p) {
  std::vector<double> logarithm;
  for (const double y : p.y) logarithm.push_back(std::log(std::abs(y)));
  return -slope(p.x, logarithm);
}

double spread(const Points& p) {
  double weight = 0.0, first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    weight += p.y[i];
    first += p.y[i] * p.x[i];
  }
  const double middle = first / weight;
  for (std::size_t i = 0; i < p.x.size(); ++i) second += p.y[i] * (p.x[i] - middle) * (p.x[i] - middle);
  return second / weight;
}

/// Abscissae where the ordinate passes the level; upward ones alone if asked.
std::vector<double> passages(const Points& p, double level, bool upward_only) {
  std::vector<double> found;
  for (std::size_t i = 1; i < p.x.size(); ++i) {
    const double a = p.y[i - 1] - level, b = p.y[i] - level;
    const bool up = a < 0.0 && b >= 0.0, down = a > 0.0 && b <= 0.0;
    if (up || (down && !upward_only)) found.push_back(p.x[i - 1] + (p.x[i] - p.x[i - 1]) * a / (a - b));
  }
  return found;
}

double period(const Points& p) {
  const std::vector<double> up = passages(p, mean(p.y), true);
  need(up.size() >= 2, "a period needs at least two upward passages through the mean");
  return (up.back() - up.front()) / static_cast<double>(up.size() - 1);
}

/// c, a cos b, -a sin b of y = c + a cos(w x + b).
Eigen::VectorXd sinusoid(const Points& p, const ReductionArguments& arguments) {
  need(arguments.frequency.has_value(), "amplitude and phase need 'frequency' [rad / unit of x]");
  need(p.x.size() >= 4, "a sinusoid needs at least four points");
  Eigen::MatrixXd basis(p.x.size(), 3);
  for (int i = 0; i < basis.rows(); ++i)
    basis.row(i) << 1.0, std::cos(*arguments.frequency * p.x[i]), std::sin(*arguments.frequency * p.x[i]);
  return fit(basis, p.y);
}

double quadratic_root(const Points& p, const ReductionArguments& arguments) {
  need(arguments.at.has_value(), "quadratic-root needs 'at', the abscissa near the wanted root");
  need(p.x.size() >= 3, "a parabola needs at least three points");
  const double middle = mean(p.x), scale = std::max(std::abs(p.x.front() - middle), std::abs(p.x.back() - middle));
  Eigen::MatrixXd basis(p.x.size(), 3);
  for (int i = 0; i < basis.rows(); ++i) {
    const double s = (p.x[i] - middle) / scale;
    basis.row(i) << 1.0, s, s * s;
  }
  const Eigen::VectorXd c = fit(basis, p.y);
  const double discriminant = c[1] * c[1] - 4.0 * c[0] * c[2];
  need(discriminant >= 0.0, "the parabola through the points has no root");
  const double far = -0.5 * (c[1] + std::copysign(std::sqrt(discriminant), c[1]));
  const double one = middle + scale * far / c[2], two = middle + scale * c[0] / far;
  return std::abs(one - *arguments.at) < std::abs(two - *arguments.at) ? one : two;
}

/// Ours and the exact ordinates at the same abscissae.
std::pair<std::vector<double>, std::vector<double>> pairs(const Points& p, const Points& exact) {
  need(!exact.y.empty(), "an error needs 'exact' or 'against'");
  if (exact.x.empty()) return {p.y, exact.y};
  std::vector<double> ours;
  for (const double x : exact.x) ours.push_back(interpolate(p, x));
  return {ours, exact.y};
}

double l2_error(const Points& p, const Points& exact) {
  const auto [ours, theirs] = pairs(p, exact);
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    difference += (ours[i] - theirs[i]) * (ours[i] - theirs[i]);
    size += theirs[i] * theirs[i];
  }
  return std::sqrt(difference / (size > 0.0 ? size : static_cast<double>(ours.size())));
}

double max_error(const Points& p, const Points& exact) {
  const auto [ours, theirs] = pairs(p, exact);
  double largest = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double error = std::abs(ours[i] - theirs[i]);
    if (std::isnan(error)) return error;
    largest = std::max(largest, error);
  }
  return largest;
}

double integral(const Points& p) {
  double total = 0.0;
  for (std::size_t i = 1; i < p.x.size(); ++i) total += 0.5 * (p.y[i] + p.y[i - 1]) * (p.x[i] - p.x[i - 1]);
  return total;
}

}  // namespace

const std::vector<ReductionName>& reductions() {
  static const std::vector<ReductionName> names{
      {"value", Reduction::value, "at an abscissa"},
      {"first", Reduction::first, "first ordinate"},
      {"last", Reduction::last, "last ordinate"},
      {"mean", Reduction::mean, "mean ordinate"},
      {"mean-half-width", Reduction::mean_half_width, "half the confidence interval of the mean"},
      {"sum", Reduction::sum, "sum of the ordinates"},
      {"count", Reduction::count, "number of points"},
      {"minimum", Reduction::minimum, "smallest ordinate"},
      {"maximum", Reduction::maximum, "largest ordinate"},
      {"range", Reduction::range, "largest minus smallest ordinate"},
      {"at-minimum", Reduction::at_minimum, "abscissa of the minimum"},
      {"at-maximum", Reduction::at_maximum, "abscissa of the maximum"},
      {"integral", Reduction::integral, "over the abscissa"},
      {"slope", Reduction::slope, "of the least-squares line"},
      {"decay", Reduction::decay, "minus the slope of the logarithm"},
      {"spread", Reduction::spread, "second central moment"},
      {"crossing", Reduction::crossing, "abscissa of the first passage through a level"},
      {"period", Reduction::period, "mean distance of upward passages"},
      {"amplitude", Reduction::amplitude, "of a sinusoid"},
      {"phase", Reduction::phase, "of a sinusoid [rad]"},
      {"quadratic-root", Reduction::quadratic_root, "of the least-squares parabola"},
      {"l2-error", Reduction::l2_error, "relative, against an exact curve"},
      {"max-error", Reduction::max_error, "largest, against an exact curve"}};
  return names;
}

double reduce(Reduction kind, const Points& p, const ReductionArguments& arguments) {
  if (kind == Reduction::count) return static_cast<double>(p.y.size());
  need(!p.y.empty(), "no row of the output fits 'where', 'filter' and 'window'");
  const auto low = std::min_element(p.y.begin(), p.y.end()), high = std::max_element(p.y.begin(), p.y.end());
  switch (kind) {
    case Reduction::value:
      need(arguments.at.has_value(), "value needs 'at', the abscissa");
      return interpolate(p, *arguments.at);
    case Reduction::first:
      return p.y.front();
    case Reduction::last:
      return p.y.back();
    case Reduction::mean:
      return mean(p.y);
    case Reduction::mean_half_width:
      return coupling::batch_means(p.y, std::vector<double>(p.y.size(), 1.0)).half_width;
    case Reduction::sum:
      return sum(p.y);
    case Reduction::minimum:
      return *low;
    case Reduction::maximum:
      return *high;
    case Reduction::range:
      return *high - *low;
    case Reduction::at_minimum:
      return at_extremum(p, static_cast<std::size_t>(low - p.y.begin()));
    case Reduction::at_maximum:
      return at_extremum(p, static_cast<std::size_t>(high - p.y.begin()));
    case Reduction::integral:
      return integral(p);
    case Reduction::slope:
      return slope(p.x, p.y);
    case Reduction::decay:
      return decay(p);
    case Reduction::spread:
      return spread(p);
    case Reduction::crossing: {
      const std::vector<double> found = passages(p, arguments.level.value_or(0.0), false);
      need(!found.empty(), "the points never pass the level");
      return found.front();
    }
    case Reduction::period:
      return period(p);
    case Reduction::amplitude:
      return sinusoid(p, arguments).tail(2).norm();
    case Reduction::phase: {
      const Eigen::VectorXd c = sinusoid(p, arguments);
      return std::atan2(-c[2], c[1]);
    }
    case Reduction::quadratic_root:
      return quadratic_root(p, arguments);
    case Reduction::l2_error:
      return l2_error(p, arguments.exact);
    case Reduction::max_error:
      return max_error(p, arguments.exact);
    case Reduction::count:
      break;
  }
  return static_cast<double>(p.y.size());
}

double fitted_order(const std::vector<double>& size, const std::vector<double>& error) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < size.size(); ++i) {
    need(size[i] > 0.0 && error[i] > 0.0, "an order needs positive sizes and errors");
    x.push_back(std::log(size[i]));
    y.push_back(std::log(error[i]));
  }
  return slope(x, y);
}

}  // namespace puffin::cases
