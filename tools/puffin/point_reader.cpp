// Readings of the air between the cell centres.

#include <algorithm>
#include <cmath>
#include <iterator>

#include "cases/check_boundaries.hpp"
#include "cases/units.hpp"
#include "tools/puffin/sampling.hpp"

namespace puffin::tools {

using coupling::Vec3;

PointReader::PointReader(const cases::Simulation& s) {
  if (!s.state.air) return;
  const auto& mesh = s.surface.mesh;
  auto walls = std::make_shared<lbm::geometry::TriangleMesh>();
  walls->vertices = mesh.vertices;
  walls->solids = mesh.solids;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int patch = s.surface.patches.of_triangle[t];
    if (s.state.air->boundaries[patch].kind != lbm::BoundaryKind::wall) continue;
    walls->triangles.push_back(mesh.triangles[t]);
    walls->solid.push_back(0);
    patch_.push_back(patch);
  }
  if (!walls->triangles.empty()) walls_ = std::make_shared<const lbm::geometry::TriangleTree>(walls);
}

namespace {
constexpr double whole = 1.0 - 1e-6;  // weight of eight cells that are all in the fluid
// Weight from which on half of them are: in the plane of an opening, or of a second wall, it is 1/2 but for rounding,
// 1e-14, which must not decide.
constexpr double half = 0.5 - 1e-6;
constexpr double nothing = 1e-6;  // weight below which none is
// Support points of the wall's parabola lie at once and twice one of these from the wall [dx]. The eight cells around a
// point are nearer to it than sqrt(3) dx: beyond the last, no plane wall takes one away.
constexpr double supports[] = {1.0, 1.25, 1.5, 1.75};
}  // namespace

PointReader::Mean PointReader::mean_of_cells(const cases::Simulation& s, const Vec3& x) const {
  const auto& rows = s.state.air->rows;
  const Vec3 at = (x - rows.origin()) / rows.dx();
  const int base[3] = {static_cast<int>(std::floor(at[0])), static_cast<int>(std::floor(at[1])),
                       static_cast<int>(std::floor(at[2]))};
  Mean mean;
  for (int n = 0; n < 8; ++n) {
    double w = 1.0;
    int c[3];
    for (int d = 0; d < 3; ++d) {
      const int high = n >> d & 1;
      const double part = at[d] - base[d];
      c[d] = base[d] + high;
      w *= high ? part : 1.0 - part;
    }
    if (w <= 1e-9) continue;
    const std::ptrdiff_t slot = rows.active_slot(c[0], c[1], c[2]);
    if (slot < 0 || !s.state.air->is_fluid(slot)) continue;
    const PointReading r = read_cell(s, slot);
    mean.reading.velocity += w * r.velocity;
    mean.reading.pressure += w * r.pressure;
    mean.weight += w;
  }
  if (mean.weight > 0.0) {
    mean.reading.velocity /= mean.weight;
    mean.reading.pressure /= mean.weight;
  }
  return mean;
}

PointReader::Mean PointReader::curved_mean(const cases::Simulation& s, const Vec3& x) const {
  const Mean linear = mean_of_cells(s, x);
  if (linear.weight < whole) return linear;
  const auto& rows = s.state.air->rows;
  Mean curved = linear;
  for (int d = 0; d < 3; ++d) {
    const double at = (x[d] - rows.origin()[d]) / rows.dx(), part = at - std::floor(at);
    const double bend = 0.5 * part * (1.0 - part);
    if (bend < 1e-9) continue;
    const Vec3 cell = rows.dx() * Vec3::Unit(d);
    const auto straighten = [&](const Vec3& aside) {
      for (const int middle : {0, 1, -1}) {  // the second difference around the point, else beside it
        const auto at_step = [&](int n) {
          return n == 0 && aside.isZero(0.0) ? linear : mean_of_cells(s, x + aside + n * cell);
        };
        const Mean a = at_step(middle - 1), b = at_step(middle), c = at_step(middle + 1);
        if (std::min({a.weight, b.weight, c.weight}) < whole) continue;
        curved.reading.velocity -= bend * (a.reading.velocity - 2.0 * b.reading.velocity + c.reading.velocity);
        curved.reading.pressure -= bend * (a.reading.pressure - 2.0 * b.reading.pressure + c.reading.pressure);
        return true;
      }
      return false;
    };
    // Under the crown of a pipe the row holds too few cells; the next one, of the same parabola, holds enough.
    const Vec3 none = Vec3::Zero(), e = rows.dx() * Vec3::Unit((d + 1) % 3), f = rows.dx() * Vec3::Unit((d + 2) % 3);
    for (const Vec3& aside : {none, e, Vec3(-e), f, Vec3(-f)})
      if (straighten(aside)) break;
  }
  return curved;
}

std::optional<PointReading> PointReader::read(const cases::Simulation& s, const Vec3& x) const {
  if (s.models.frozen_air) {  // known everywhere in the device; it has no pressure
    if (!s.tree->inside(x)) return std::nullopt;
    return PointReading{s.models.frozen_air(x), 0.0};
  }
  if (!s.state.air) return std::nullopt;
  const Mean mean = curved_mean(s, x);
  if (mean.weight >= whole) return mean.reading;
  return beside_wall(s, x, mean);
}

std::optional<PointReading> PointReader::beside_wall(const cases::Simulation& s, const Vec3& x,
                                                     const Mean& mean) const {
  const double dx = s.state.air->rows.dx();
  std::optional<PointReading> rest;  // what the cells in the fluid say
  if (mean.weight >= nothing) rest = mean.reading;
  const auto near = walls_ ? walls_->closest(x, *std::rbegin(supports) * dx) : lbm::geometry::Closest{};
  if (near.triangle < 0) return rest;
  const Vec3 inward = -walls_->mesh().area_vector(near.triangle).normalized(), way = x - near.point;
  const double distance = inward.dot(way);
  const bool on_face = (way - distance * inward).norm() <= 1e-6 * dx;  // else on an edge: no normal leads to the point
  const bool close = near.distance <= dx;
  if (distance < -1e-3 * dx) {  // behind the wall; farther from an edge one of its triangles cannot tell
    if (on_face || close || !s.tree->inside(x)) return std::nullopt;
    return rest;
  }
  const int patch = patch_[near.triangle];
  const auto& boundary = s.state.air->boundaries[patch];
  Vec3 wall = Vec3::Zero();
  if (boundary.profile && s.models.patches[patch].speed)
    wall = s.models.patches[patch].speed(s.state.time) * boundary.profile(near.point);
  Foot foot{near.point, inward, wall, std::max(0.0, distance)};
  if (!on_face) {
    foot.along = way / near.distance;
    foot.distance = near.distance;
  }
  if (const auto reading = on_parabola(s, foot)) return reading;
  if (!close) return rest;
  const Mean one = curved_mean(s, near.point + dx * inward);  // beside an opening or a second wall: a straight line
  if (one.weight < half) {
    if (rest && on_face && distance <= 1e-6 * dx)
      rest->velocity = wall;  // a point on the wall, at a corner of an opening's rim
    return rest;
  }
  PointReading reading;
  reading.pressure = mean.weight > nothing ? mean.reading.pressure : one.reading.pressure;
  reading.velocity = wall + std::max(0.0, distance) / dx * (one.reading.velocity - wall);
  return reading;
}

std::optional<PointReading> PointReader::on_parabola(const cases::Simulation& s, const Foot& foot) const {
  for (const double spacing : supports) {
    const double h = spacing * s.state.air->rows.dx();
    const Mean one = curved_mean(s, foot.point + h * foot.along);
    const Mean two = curved_mean(s, foot.point + 2.0 * h * foot.along);
    if (std::min(one.weight, two.weight) < whole) continue;
    const Mean three = curved_mean(s, foot.point + 3.0 * h * foot.along);
    const double a = foot.distance / h;
    const double p1 = one.reading.pressure, p2 = two.reading.pressure, p3 = three.reading.pressure;
    PointReading reading;
    reading.pressure = (2.0 - a) * p1 + (a - 1.0) * p2;
    if (three.weight >= whole) reading.pressure += 0.5 * (a - 1.0) * (a - 2.0) * (p1 - 2.0 * p2 + p3);
    const Vec3 first = one.reading.velocity - foot.velocity, second = two.reading.velocity - foot.velocity;
    reading.velocity = foot.velocity + a * (2.0 - a) * first + 0.5 * a * (a - 1.0) * second;
    return reading;
  }
  return std::nullopt;
}

std::vector<std::string> PointReader::check_places(const cases::Simulation& s) const {
  std::vector<std::string> notes;
  if (!s.state.air && !s.models.frozen_air) return notes;
  const cases::Output& out = s.description.output;
  std::vector<cases::Problem> problems;
  const auto say = [&](const std::string& key, std::size_t i, const std::string& text) {
    const std::string at = key + "[" + std::to_string(i) + "]";
    problems.push_back(cases::problem_at(s.description, at, at + ": " + text));
  };
  for (std::size_t i = 0; i < out.probes.size(); ++i)
    if (!read(s, out.probes[i].at)) say("output.probe", i, "'" + out.probes[i].name + "' lies outside the fluid");
  for (std::size_t i = 0; i < out.lines.size(); ++i) {
    const cases::Line& line = out.lines[i];
    int outside = 0;
    for (int n = 0; n < line.points; ++n) outside += !read(s, place_on(line, n));
    if (outside == line.points)
      say("output.line", i, "'" + line.name + "' meets no fluid");
    else if (outside > 0)
      notes.push_back("line '" + line.name + "': " + std::to_string(outside) + " of its " +
                      std::to_string(line.points) + " points lie outside the fluid; lines.csv has no rows for them");
  }
  if (!s.state.air) {
    if (!problems.empty()) throw cases::CaseError(std::move(problems));
    return notes;
  }
  const auto& rows = s.state.air->rows;
  const auto outside = [&](int axis, double at) {
    const double place = (at - rows.origin()[axis]) / rows.dx();
    return place < -0.5 - 1e-6 || place > rows.box()[axis] - 0.5 + 1e-6;
  };
  for (std::size_t i = 0; i < out.planes.size(); ++i)
    if (!read_plane(s, out.planes[i].axis, out.planes[i].at))
      say("output.plane", i, "'" + out.planes[i].name + "' meets no fluid");
  for (std::size_t i = 0; i < out.fields.size(); ++i) {
    if (const auto* slice = std::get_if<cases::RegionSlice>(&out.fields[i].region); slice)
      if (outside(slice->axis, slice->at)) say("output.fields", i, "the slice lies outside the geometry");
    if (const auto* box = std::get_if<cases::RegionBox>(&out.fields[i].region); box)
      for (int d = 0; d < 3; ++d)
        if (box->max[d] < rows.origin()[d] - 0.5 * rows.dx() ||
            box->min[d] > rows.origin()[d] + (rows.box()[d] - 0.5) * rows.dx()) {
          say("output.fields", i, "the box lies outside the geometry");
          break;
        }
  }
  if (!problems.empty()) throw cases::CaseError(std::move(problems));
  return notes;
}

Vec3 place_on(const cases::Line& line, int n) {
  const double share = line.points > 1 ? static_cast<double>(n) / (line.points - 1) : 0.0;
  return line.from + share * (line.to - line.from);
}

}  // namespace puffin::tools
