#include "tools/output/picture/streamlines.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace puffin::output {
namespace {

std::int64_t index_of(const FieldFrame& f, int i, int j, int k) {
  return i + static_cast<std::int64_t>(f.size[0]) * (j + static_cast<std::int64_t>(f.size[1]) * k);
}

bool is_fluid(const FieldFrame& f, int i, int j, int k) {
  return i >= 0 && j >= 0 && k >= 0 && i < f.size[0] && j < f.size[1] && k < f.size[2] && f.fluid[index_of(f, i, j, k)];
}

double fastest(const FieldFrame& f) {
  float most = 0;
  for (std::size_t n = 0; n + 2 < f.velocity.size(); n += 3)
    most = std::max(most, f.velocity[n] * f.velocity[n] + f.velocity[n + 1] * f.velocity[n + 1] +
                              f.velocity[n + 2] * f.velocity[n + 2]);
  return std::sqrt(most);
}

/// One way from the seed, without it.
void follow(const FieldFrame& field, Vec3 place, double step, double slowest, double longest, Streamline& line) {
  Vec3 first, middle;
  for (double gone = 0; gone < longest; gone += std::abs(step)) {
    if (!velocity_at(field, place, first) || first.norm() < slowest) return;
    if (!velocity_at(field, place + 0.5 * step * first.normalized(), middle) || middle.norm() < slowest) return;
    place += step * middle.normalized();
    if (!velocity_at(field, place, first)) return;
    line.push_back({place, first.norm()});
  }
}

/// Which blocks of space lines have already gone through.
class Blocks {
 public:
  Blocks(const FieldFrame& f, double edge) : edge_(edge) {
    for (int d = 0; d < 3; ++d) {
      low_[d] = f.origin[d] - 0.5 * f.dx;
      size_[d] = 1 + static_cast<int>(f.size[d] * f.dx / edge);
    }
    taken_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], 0);
  }
  char& at(const Vec3& p) {
    std::size_t n[3];
    for (int d = 0; d < 3; ++d)
      n[d] = static_cast<std::size_t>(std::clamp(static_cast<int>((p[d] - low_[d]) / edge_), 0, size_[d] - 1));
    return taken_[n[0] + size_[0] * (n[1] + size_[1] * n[2])];
  }

 private:
  double edge_;
  Vec3 low_;
  int size_[3];
  std::vector<char> taken_;
};

}  // namespace

bool velocity_at(const FieldFrame& f, const Vec3& place, Vec3& velocity) {
  const Vec3 at = (place - Vec3(f.origin[0], f.origin[1], f.origin[2])) / f.dx;  // in cells; centres are whole numbers
  const auto nearest = [&](int d) { return static_cast<int>(std::floor(at[d] + 0.5)); };
  if (!is_fluid(f, nearest(0), nearest(1), nearest(2))) return false;
  const int i = static_cast<int>(std::floor(at[0])), j = static_cast<int>(std::floor(at[1])),
            k = static_cast<int>(std::floor(at[2]));
  velocity.setZero();
  double weights = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int a = i + (corner & 1), b = j + (corner >> 1 & 1), c = k + (corner >> 2);
    if (!is_fluid(f, a, b, c)) continue;
    const double weight = (1 - std::abs(at[0] - a)) * (1 - std::abs(at[1] - b)) * (1 - std::abs(at[2] - c));
    const std::int64_t n = 3 * index_of(f, a, b, c);
    velocity += weight * Vec3(f.velocity[n], f.velocity[n + 1], f.velocity[n + 2]);
    weights += weight;
  }
  if (weights <= 0) return false;
  velocity /= weights;
  return true;
}

Streamline trace(const FieldFrame& field, const Vec3& seed, double slowest, double longest) {
  Vec3 velocity;
  if (!velocity_at(field, seed, velocity) || velocity.norm() < slowest) return {};
  Streamline line;
  follow(field, seed, -0.4 * field.dx, slowest, longest, line);
  std::reverse(line.begin(), line.end());
  line.push_back({seed, velocity.norm()});
  follow(field, seed, 0.4 * field.dx, slowest, longest, line);
  return line;
}

std::vector<Streamline> even_streamlines(const FieldFrame& field, double apart) {
  if (field.velocity.empty()) throw std::invalid_argument("this output holds no velocity");
  const double slowest = 1e-3 * fastest(field);
  if (slowest <= 0) return {};
  const double longest = 1.5 * field.dx * (field.size[0] + field.size[1] + field.size[2]);
  Blocks blocks(field, apart);
  std::vector<Streamline> lines;
  // A stride that shares no factor with the number of cells meets every cell once, far from the one before.
  const std::int64_t cells = field.cells();
  auto stride = static_cast<std::int64_t>(0.618034 * static_cast<double>(cells)) | 1;
  while (std::gcd(stride, cells) != 1) stride += 2;
  for (std::int64_t n = 0, cell = 0; n < cells; ++n, cell = (cell + stride) % cells) {
    if (!field.fluid[cell]) continue;
    const std::int64_t row = cell / field.size[0], layer = row / field.size[1];
    const Vec3 seed = Vec3(field.origin[0], field.origin[1], field.origin[2]) +
                      field.dx * Vec3(static_cast<double>(cell % field.size[0]),
                                      static_cast<double>(row % field.size[1]), static_cast<double>(layer));
    if (blocks.at(seed)) continue;
    blocks.at(seed) = 1;
    Streamline line = trace(field, seed, slowest, longest);
    if (line.size() < 12) continue;  // a stub in a corner
    for (const StreamPoint& p : line) blocks.at(p.place) = 1;
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace puffin::output
