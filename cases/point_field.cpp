#include "cases/point_field.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cases/table_file.hpp"

namespace puffin::cases {

namespace {
constexpr std::size_t neighbours = 12;
}

PointField::PointField(std::vector<Vec3> points, std::vector<Vec3> values)
    : points_(std::move(points)), values_(std::move(values)) {
  if (points_.empty() || points_.size() != values_.size())
    throw std::invalid_argument("a field needs at least one point and one value a point");
  if (find_grid()) return;
  tree_.resize(points_.size());
  for (std::size_t n = 0; n < tree_.size(); ++n) tree_[n] = static_cast<int>(n);
  sort_tree(0, static_cast<int>(tree_.size()), 0);
  for (std::size_t n = 0; n < points_.size(); ++n) {
    std::vector<std::pair<double, int>> two;
    two.reserve(neighbours);
    nearest(points_[n], 0, static_cast<int>(tree_.size()), 0, two);
    if (two.size() > 1 && two[1].first == 0.0)
      throw std::invalid_argument("two values at the point [" + std::to_string(points_[n][0]) + ", " +
                                  std::to_string(points_[n][1]) + ", " + std::to_string(points_[n][2]) + "] m");
  }
}

bool PointField::find_grid() {
  Vec3 low = points_.front(), high = low;
  for (const Vec3& p : points_) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double same = 1e-6 * std::max((high - low).maxCoeff(), 1e-300);
  std::size_t nodes = 1;
  for (int d = 0; d < 3; ++d) {
    std::vector<double> all;
    all.reserve(points_.size());
    for (const Vec3& p : points_) all.push_back(p[d]);
    std::sort(all.begin(), all.end());
    axis_[d].clear();
    for (const double v : all)
      if (axis_[d].empty() || v - axis_[d].back() > same) axis_[d].push_back(v);
    nodes *= axis_[d].size();
    if (nodes > points_.size()) return false;
  }
  if (nodes != points_.size()) return false;
  std::vector<int> grid(nodes, -1);
  for (std::size_t n = 0; n < points_.size(); ++n) {
    std::size_t at = 0;
    for (int d = 2; d >= 0; --d) {
      const auto& a = axis_[d];
      const auto found = std::lower_bound(a.begin(), a.end(), points_[n][d] - same);
      at = at * a.size() + static_cast<std::size_t>(found - a.begin());
    }
    if (grid[at] >= 0) return false;
    grid[at] = static_cast<int>(n);
  }
  grid_ = std::move(grid);
  return true;
}

Vec3 PointField::at(const Vec3& x) const { return is_grid() ? on_grid(x) : scattered(x); }

Vec3 PointField::on_grid(const Vec3& x) const {
  std::array<std::size_t, 3> base{};
  Vec3 part = Vec3::Zero();
  for (int d = 0; d < 3; ++d) {
    const auto& a = axis_[d];
    if (a.size() < 2) continue;
    const auto above = std::upper_bound(a.begin() + 1, a.end() - 1, x[d]);
    base[d] = static_cast<std::size_t>(above - a.begin()) - 1;
    part[d] = std::clamp((x[d] - a[base[d]]) / (a[base[d] + 1] - a[base[d]]), 0.0, 1.0);
  }
  Vec3 sum = Vec3::Zero();
  for (int n = 0; n < 8; ++n) {
    double w = 1.0;
    std::size_t at = 0;
    for (int d = 2; d >= 0; --d) {
      const int high = n >> d & 1;
      w *= high ? part[d] : 1.0 - part[d];
      at = at * axis_[d].size() + std::min(base[d] + high, axis_[d].size() - 1);
    }
    if (w > 0.0) sum += w * values_[grid_[at]];
  }
  return sum;
}

Vec3 PointField::scattered(const Vec3& x) const {
  std::vector<std::pair<double, int>> near;
  near.reserve(neighbours + 1);
  nearest(x, 0, static_cast<int>(tree_.size()), 0, near);
  const double reach2 = near.back().first;
  if (near.front().first <= 1e-18 * reach2 || near.size() == 1) return values_[near.front().second];
  // Weighted least squares of value = c0 + c . (p - m), m the middle of the neighbours, lengths in units of the reach
  // so that columns compare. About m, the slope across a plane or a line of neighbours is a column of zeros, so no
  // slope.
  Vec3 middle = Vec3::Zero();
  for (const auto& [r2, p] : near) middle += points_[p] / static_cast<double>(near.size());
  const double reach = std::sqrt(reach2);
  const auto rows = static_cast<Eigen::Index>(near.size());
  Eigen::MatrixXd a(rows, 4), b(rows, 3);
  Vec3 low = values_[near.front().second], high = low;
  for (Eigen::Index n = 0; n < rows; ++n) {
    const auto& [r2, p] = near[static_cast<std::size_t>(n)];
    const double weight = reach2 / r2;  // the square root of the weight 1/r^4, up to a factor
    a(n, 0) = weight;
    a.block<1, 3>(n, 1) = weight / reach * (points_[p] - middle).transpose();
    b.row(n) = weight * values_[p].transpose();
    low = low.cwiseMin(values_[p]);
    high = high.cwiseMax(values_[p]);
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fit;
  fit.setThreshold(1e-10);  // neighbours on a plane or a line say nothing about the slope across it: taken as zero
  fit.compute(a);
  const Eigen::MatrixXd c = fit.solve(b);
  const Vec3 value = c.row(0).transpose() + c.bottomRows(3).transpose() * ((x - middle) / reach);
  return value.cwiseMax(low).cwiseMin(high);
}

void PointField::sort_tree(int begin, int end, int depth) {
  if (end - begin < 2) return;
  const int middle = (begin + end) / 2, d = depth % 3;
  std::nth_element(tree_.begin() + begin, tree_.begin() + middle, tree_.begin() + end,
                   [&](int a, int b) { return points_[a][d] < points_[b][d]; });
  sort_tree(begin, middle, depth + 1);
  sort_tree(middle + 1, end, depth + 1);
}

/// Keeps the nearest in `best`, sorted by squared distance, then by index.
void PointField::nearest(const Vec3& x, int begin, int end, int depth,
                         std::vector<std::pair<double, int>>& best) const {
  if (begin >= end) return;
  const int middle = (begin + end) / 2, d = depth % 3, p = tree_[middle];
  const std::pair<double, int> here{(points_[p] - x).squaredNorm(), p};
  if (best.size() < neighbours || here < best.back()) {
    best.insert(std::upper_bound(best.begin(), best.end(), here), here);
    if (best.size() > neighbours) best.pop_back();
  }
  const double across = x[d] - points_[p][d];
  nearest(x, across < 0.0 ? begin : middle + 1, across < 0.0 ? middle : end, depth + 1, best);
  if (best.size() < neighbours || across * across <= best.back().first)
    nearest(x, across < 0.0 ? middle + 1 : begin, across < 0.0 ? end : middle, depth + 1, best);
}

PointRows read_point_rows(const std::string& file) {
  const Columns columns = read_columns(file, {"x", "y", "z", "u", "v", "w"});
  PointRows rows;
  for (std::size_t n = 0; n < columns.at("x").size(); ++n) {
    rows.points.emplace_back(columns.at("x")[n], columns.at("y")[n], columns.at("z")[n]);
    rows.values.emplace_back(columns.at("u")[n], columns.at("v")[n], columns.at("w")[n]);
  }
  return rows;
}

PointField read_point_field(const std::string& file) {
  PointRows rows = read_point_rows(file);
  try {
    return {std::move(rows.points), std::move(rows.values)};
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(file + ": " + e.what());
  }
}

}  // namespace puffin::cases
