#pragma once
// Non-linear least squares with confidence intervals.

#include <Eigen/Core>
#include <functional>

namespace puffin::micromodels::derivation {

/// A number with its 95 % confidence interval.
struct Estimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

struct LeastSquares {
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;  // of x: s^2 (J^T J)^-1, s^2 = sum of squares / degrees of freedom
  double sum_of_squares = 0.0;
  int freedom = 0;  // residuals - parameters; 0: no covariance

  /// x[i] -+ t(95 %, freedom) standard errors.
  Estimate estimate(int i) const { return estimate_of(Eigen::VectorXd::Unit(x.size(), i)); }
  /// The same for the linear combination weights . x.
  Estimate estimate_of(const Eigen::VectorXd& weights) const;
};

/// Levenberg-Marquardt (More, Argonne report ANL-80-74, 1980; Eigen's port of MINPACK) with forward differences.
/// residuals(x, r) fills r, of length `count`. Throws std::invalid_argument with fewer residuals than parameters.
/// first_step > 0: no longer than that is the first step, in x as it stands (later ones at most twice the last that
/// served): for residuals that are flat far from the start, where a long step would end.
LeastSquares least_squares(const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& residuals, int count,
                           const Eigen::VectorXd& start, double first_step = 0.0);

/// Two-sided 95 % quantile of Student's t (Cornish-Fisher series, Abramowitz & Stegun 26.7.5; tabulated up to 9).
double student_95(int freedom);

}  // namespace puffin::micromodels::derivation
