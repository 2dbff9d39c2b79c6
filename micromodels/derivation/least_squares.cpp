#include "micromodels/derivation/least_squares.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace puffin::micromodels::derivation {
namespace {

/// In the form that Eigen's solver asks for.
struct Functor {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>* residuals = nullptr;
  int parameters = 0, count = 0;
  int inputs() const { return parameters; }
  int values() const { return count; }
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    (*residuals)(x, r);
    return 0;
  }
};

}  // namespace

double student_95(int freedom) {
  if (freedom < 1) return std::numeric_limits<double>::infinity();
  constexpr double table[] = {12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622};
  if (freedom <= 9) return table[freedom - 1];
  const double z = 1.959964, n = freedom, z2 = z * z;
  return z * (1.0 + (z2 + 1.0) / (4.0 * n) + ((5.0 * z2 + 16.0) * z2 + 3.0) / (96.0 * n * n) +
              (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / (384.0 * n * n * n));
}

Estimate LeastSquares::estimate_of(const Eigen::VectorXd& weights) const {
  const double value = weights.dot(x);
  if (freedom < 1) return {value, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const double half = student_95(freedom) * std::sqrt(std::max(0.0, weights.dot(covariance * weights)));
  return {value, value - half, value + half};
}

LeastSquares least_squares(const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& residuals, int count,
                           const Eigen::VectorXd& start, double first_step) {
  const int parameters = static_cast<int>(start.size());
  if (count < parameters) throw std::invalid_argument("a fit needs at least as many points as parameters");
  Functor plain;
  plain.residuals = &residuals;
  plain.parameters = parameters;
  plain.count = count;
  Eigen::NumericalDiff<Functor> functor(plain);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Functor>> solver(functor);
  solver.parameters.maxfev = 4000;
  solver.parameters.xtol = solver.parameters.ftol = 1e-12;
  if (first_step > 0.0) {
    solver.useExternalScaling = true;
    solver.diag = Eigen::VectorXd::Ones(parameters);
    solver.parameters.factor = first_step / (start.norm() > 0.0 ? start.norm() : 1.0);
  }
  LeastSquares fit;
  fit.x = start;
  solver.minimize(fit.x);
  Eigen::VectorXd r(count);
  residuals(fit.x, r);
  fit.sum_of_squares = r.squaredNorm();
  fit.freedom = count - parameters;
  Eigen::MatrixXd jacobian(count, parameters);
  functor.df(fit.x, jacobian);
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const double variance = fit.freedom > 0 ? fit.sum_of_squares / fit.freedom : 0.0;
  fit.covariance = variance * normal.completeOrthogonalDecomposition().pseudoInverse();
  return fit;
}

}  // namespace puffin::micromodels::derivation
