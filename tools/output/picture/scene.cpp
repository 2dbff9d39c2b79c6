// A z-buffer for what is opaque and a sorted list of fragments a sample for what is translucent (A-buffer; Carpenter,
// Computer Graphics 18(3), 103 (1984)), on a grid of 3 x 3 samples a pixel. Bands of rows are independent tasks.

#include "tools/output/picture/scene.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace puffin::output {
namespace {

constexpr int samples = 3;       // along each side of a pixel
constexpr int band_pixels = 10;  // rows of pixels in a task

struct Fragment {
  float depth;
  Colour colour;
  float opacity;
};

/// Samples of one band: the nearest opaque surface, and a chain of translucent fragments before it.
class Band {
 public:
  Band(int x0, int y0, int width, int height)
      : x0_(x0),
        y0_(y0),
        width_(width),
        height_(height),
        nearest_(static_cast<std::size_t>(width) * height, {-std::numeric_limits<float>::infinity(), white, 0.0f}),
        first_(nearest_.size(), -1) {}

  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int x1() const { return x0_ + width_; }
  int y1() const { return y0_ + height_; }

  void add(int x, int y, const Fragment& fragment) {
    const std::size_t at = static_cast<std::size_t>(y - y0_) * width_ + (x - x0_);
    if (fragment.depth <= nearest_[at].depth) return;
    if (fragment.opacity >= 1.0f) {
      nearest_[at] = fragment;
    } else {
      chain_.push_back({fragment, first_[at]});
      first_[at] = static_cast<int>(chain_.size()) - 1;
    }
  }

  bool empty(int x, int y) const {
    const std::size_t at = static_cast<std::size_t>(y - y0_) * width_ + (x - x0_);
    return first_[at] < 0 && nearest_[at].opacity == 0;
  }

  /// Colour and opacity of a sample, multiplied: front to back. `sorted` is scratch.
  std::array<float, 4> resolve(int x, int y, std::vector<Fragment>& sorted) const {
    const std::size_t at = static_cast<std::size_t>(y - y0_) * width_ + (x - x0_);
    sorted.clear();
    for (int i = first_[at]; i >= 0; i = chain_[i].next) {
      if (chain_[i].fragment.depth > nearest_[at].depth) sorted.push_back(chain_[i].fragment);
    }
    std::sort(sorted.begin(), sorted.end(), [](const Fragment& a, const Fragment& b) {
      if (a.depth != b.depth) return a.depth > b.depth;
      // Equal depths are ordered by colour, so that no order of drawing shows.
      return std::tuple(a.opacity, a.colour.r, a.colour.g) < std::tuple(b.opacity, b.colour.r, b.colour.g);
    });
    if (nearest_[at].opacity > 0) sorted.push_back(nearest_[at]);
    std::array<float, 4> sum{0, 0, 0, 0};
    for (const Fragment& f : sorted) {
      const float weight = (1.0f - sum[3]) * f.opacity;
      sum[0] += weight * f.colour.r, sum[1] += weight * f.colour.g, sum[2] += weight * f.colour.b;
      sum[3] += weight;
    }
    return sum;
  }

 private:
  struct Link {
    Fragment fragment;
    int next;
  };
  int x0_, y0_, width_, height_;
  std::vector<Fragment> nearest_;
  std::vector<int> first_;
  std::vector<Link> chain_;
};

/// A triangle on the sample grid, ready to be filled.
struct FlatTriangle {
  Vec3 a, b, c;  // sample coordinates and depth
  Colour colour;
  float opacity;
};

struct FlatSphere {
  Vec3 centre;         // sample coordinates and depth
  double radius;       // [sample]
  double depth_scale;  // unit of length per sample
  Colour colour;
};

/// Twice the signed area of (a, b, p) for samples p of one row. The ends are ordered first, so that the two triangles
/// that share an edge compute the same number but for its sign, and a sample exactly on it belongs to one of them.
class Side {
 public:
  Side(const Vec3& a, const Vec3& b) {
    const bool exchanged = b.x() < a.x() || (b.x() == a.x() && b.y() < a.y());
    from_ = exchanged ? b : a;
    along_ = exchanged ? Vec3(a - b) : Vec3(b - a);
    sign_ = exchanged ? -1.0 : 1.0;
    owns_edge_ = b.y() > a.y() || (b.y() == a.y() && b.x() < a.x());
  }
  void set_row(double y) { row_ = along_.x() * (y - from_.y()); }
  double at(double x) const { return sign_ * (row_ - along_.y() * (x - from_.x())); }
  /// Narrows [low, high] to where a row may lie on this side, give or take a sample.
  void narrow(int& low, int& high) const {
    const double slope = -sign_ * along_.y();
    if (slope == 0.0) return;
    const double edge = from_.x() + row_ / along_.y() - 0.5;
    if (!(std::abs(edge) < 1e9)) return;
    if (slope > 0.0)
      low = std::max(low, static_cast<int>(edge) - 1);
    else
      high = std::min(high, static_cast<int>(edge) + 2);
  }
  bool holds(double value) const { return value > 0 || (value == 0 && owns_edge_); }

 private:
  Vec3 from_, along_;
  double sign_, row_ = 0.0;
  bool owns_edge_;
};

void fill(FlatTriangle t, Band& band) {
  Side whole(t.a, t.b);
  whole.set_row(t.c.y());
  const double area = std::abs(whole.at(t.c.x()));
  if (area == 0) return;
  if (whole.at(t.c.x()) < 0) std::swap(t.b, t.c);
  const int y0 = std::max(band.y0(), static_cast<int>(std::floor(std::min({t.a.y(), t.b.y(), t.c.y()}))));
  const int y1 = std::min(band.y1() - 1, static_cast<int>(std::ceil(std::max({t.a.y(), t.b.y(), t.c.y()}))));
  const int x0 = std::max(band.x0(), static_cast<int>(std::floor(std::min({t.a.x(), t.b.x(), t.c.x()}))));
  const int x1 = std::min(band.x1() - 1, static_cast<int>(std::ceil(std::max({t.a.x(), t.b.x(), t.c.x()}))));
  Side opposite_a(t.b, t.c), opposite_b(t.c, t.a), opposite_c(t.a, t.b);
  for (int y = y0; y <= y1; ++y) {
    opposite_a.set_row(y + 0.5), opposite_b.set_row(y + 0.5), opposite_c.set_row(y + 0.5);
    int first = x0, last = x1;
    for (const Side* side : {&opposite_a, &opposite_b, &opposite_c}) side->narrow(first, last);
    for (int x = first; x <= last; ++x) {
      const double a = opposite_a.at(x + 0.5), b = opposite_b.at(x + 0.5), c = opposite_c.at(x + 0.5);
      if (!opposite_a.holds(a) || !opposite_b.holds(b) || !opposite_c.holds(c)) continue;
      const double depth = (a * t.a.z() + b * t.b.z() + c * t.c.z()) / area;
      band.add(x, y, {static_cast<float>(depth), t.colour, t.opacity});
    }
  }
}

void fill(const FlatSphere& s, Band& band) {
  const int y0 = std::max(band.y0(), static_cast<int>(std::floor(s.centre.y() - s.radius)));
  const int y1 = std::min(band.y1() - 1, static_cast<int>(std::ceil(s.centre.y() + s.radius)));
  const int x0 = std::max(band.x0(), static_cast<int>(std::floor(s.centre.x() - s.radius)));
  const int x1 = std::min(band.x1() - 1, static_cast<int>(std::ceil(s.centre.x() + s.radius)));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double dx = (x + 0.5 - s.centre.x()) / s.radius, dy = (y + 0.5 - s.centre.y()) / s.radius;
      const double rest = 1.0 - dx * dx - dy * dy;
      if (rest <= 0) continue;
      const double dz = std::sqrt(rest);
      // Light from the upper left, a little before the picture; darker towards the rim.
      const double light = std::max(0.0, (-0.35 * dx - 0.55 * dy + 0.76 * dz));
      const float shade = static_cast<float>(0.55 + 0.45 * light);
      const Colour lit{s.colour.r * shade, s.colour.g * shade, s.colour.b * shade};
      const double depth = s.centre.z() + dz * s.radius * s.depth_scale;
      band.add(x, y, {static_cast<float>(depth), lit, 1.0f});
    }
  }
}

FlatTriangle flatten(const SceneTriangle& t, const Camera& camera) {
  const Vec3 normal = (t.b - t.a).cross(t.c - t.a).normalized();
  const double facing = std::max(std::abs(normal.dot(camera.towards_eye)), 0.08);
  FlatTriangle flat;
  flat.a = camera.project(t.a), flat.b = camera.project(t.b), flat.c = camera.project(t.c);
  if (t.opacity >= 1.0f) {
    // Opaque faces: brighter from above, so that the shape can be read.
    const float shade = static_cast<float>(0.72 + 0.18 * facing + 0.10 * std::abs(normal.z()));
    flat.colour = {t.colour.r * shade, t.colour.g * shade, t.colour.b * shade};
    flat.opacity = 1.0f;
  } else {
    flat.colour = t.colour;
    flat.opacity = static_cast<float>(1.0 - std::pow(1.0 - t.opacity, 1.0 / facing));  // Beer's law across a pane
  }
  return flat;
}

/// An edge as a strip of constant width on the picture, slightly nearer than the faces that meet in it.
void flatten(const SceneEdge& e, const Camera& camera, double nearer, std::vector<FlatTriangle>& out) {
  const Vec3 a = camera.project(e.a) + Vec3(0, 0, nearer), b = camera.project(e.b) + Vec3(0, 0, nearer);
  const double length = std::hypot(b.x() - a.x(), b.y() - a.y());
  if (length == 0) return;
  const Vec3 across = Vec3(-(b.y() - a.y()), b.x() - a.x(), 0) * (0.5 * e.width * samples / length);
  out.push_back({a - across, a + across, b + across, e.colour, e.opacity});
  out.push_back({a - across, b + across, b - across, e.colour, e.opacity});
}

/// Which of many things reach into which band of rows, in their order; [low, high] of each along y, in samples.
class ByBand {
 public:
  ByBand(int top, int bands) : top_(top * samples), of_band_(bands) {}
  void add(int thing, double low, double high) {
    const int last = static_cast<int>(of_band_.size()) - 1;
    const double first_row = std::floor(low) - top_, last_row = std::ceil(high) - top_;
    if (!(last_row >= 0.0 && first_row <= (last + 1.0) * rows)) return;
    const int to = std::min(last, static_cast<int>(last_row) / rows);
    for (int band = static_cast<int>(std::max(first_row, 0.0)) / rows; band <= to; ++band)
      of_band_[band].push_back(thing);
  }
  const std::vector<int>& operator[](int band) const { return of_band_[band]; }

 private:
  static constexpr int rows = band_pixels * samples;
  int top_;
  std::vector<std::vector<int>> of_band_;
};

}  // namespace

Camera Camera::looking(double azimuth, double elevation, const Vec3& low, const Vec3& high, const Box& view) {
  const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
  Camera camera;
  camera.towards_eye = Vec3(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
  camera.right = Vec3(-std::sin(a), std::cos(a), 0);
  camera.up = camera.towards_eye.cross(camera.right);
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(), corner & 4 ? high.z() : low.z());
    x0 = std::min(x0, p.dot(camera.right)), x1 = std::max(x1, p.dot(camera.right));
    y0 = std::min(y0, p.dot(camera.up)), y1 = std::max(y1, p.dot(camera.up));
  }
  camera.scale = std::min(view.width / std::max(x1 - x0, 1e-300), view.height / std::max(y1 - y0, 1e-300));
  camera.centre_x = view.x + 0.5 * view.width - camera.scale * 0.5 * (x0 + x1);
  camera.centre_y = view.y + 0.5 * view.height + camera.scale * 0.5 * (y0 + y1);
  return camera;
}

void paint(const Scene& scene, const Camera& camera, const Box& view, Canvas& canvas) {
  Camera fine = camera;  // on the sample grid
  fine.scale *= samples, fine.centre_x *= samples, fine.centre_y *= samples;
  std::vector<FlatTriangle> triangles;
  for (const auto& triangle : scene.triangles) triangles.push_back(flatten(triangle, fine));
  for (const auto& edge : scene.edges) flatten(edge, fine, 2.0 / camera.scale, triangles);
  std::vector<FlatSphere> spheres;
  for (const auto& s : scene.spheres) {
    const double radius = std::max(s.radius * fine.scale, scene.smallest_radius * samples);
    const Vec3 at = fine.project(s.centre);
    if (!(at.cwiseAbs().maxCoeff() + radius < 1e6)) continue;  // pixel: far away or no number, after a divergence
    spheres.push_back({at, radius, 1.0 / fine.scale, s.colour});
  }
  // Opaque things first: they save the translucent fragments behind them.
  std::stable_partition(triangles.begin(), triangles.end(), [](const auto& t) { return t.opacity >= 1.0f; });

  const int left = std::max(0, static_cast<int>(view.x)), top = std::max(0, static_cast<int>(view.y));
  const int right = std::min(canvas.width(), static_cast<int>(view.x + view.width));
  const int bottom = std::min(canvas.height(), static_cast<int>(view.y + view.height));
  const int bands = std::max(0, (bottom - top + band_pixels - 1) / band_pixels);
  ByBand spheres_of(top, bands), triangles_of(top, bands);
  for (int n = 0; n < static_cast<int>(spheres.size()); ++n)
    spheres_of.add(n, spheres[n].centre.y() - spheres[n].radius, spheres[n].centre.y() + spheres[n].radius);
  for (int n = 0; n < static_cast<int>(triangles.size()); ++n) {
    const auto [low, high] = std::minmax({triangles[n].a.y(), triangles[n].b.y(), triangles[n].c.y()});
    triangles_of.add(n, low, high);
  }
  tbb::parallel_for(0, bands, [&](int number) {
    const int row0 = top + number * band_pixels, row1 = std::min(row0 + band_pixels, bottom);
    Band band(left * samples, row0 * samples, (right - left) * samples, (row1 - row0) * samples);
    for (const int n : spheres_of[number]) fill(spheres[n], band);
    for (const int n : triangles_of[number]) fill(triangles[n], band);
    std::vector<Fragment> scratch;
    for (int y = row0; y < row1; ++y) {
      for (int x = left; x < right; ++x) {
        std::array<float, 4> sum{0, 0, 0, 0};
        for (int s = 0; s < samples * samples; ++s) {
          const int sx = x * samples + s % samples, sy = y * samples + s / samples;
          if (band.empty(sx, sy)) continue;
          const auto one = band.resolve(sx, sy, scratch);
          for (int c = 0; c < 4; ++c) sum[c] += one[c];
        }
        if (sum[3] <= 0) continue;
        const Colour mean{sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]};
        canvas.blend(x, y, mean, sum[3] / (samples * samples));
      }
    }
  });
}

}  // namespace puffin::output
