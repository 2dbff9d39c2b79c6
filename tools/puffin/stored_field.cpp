#include "tools/puffin/stored_field.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "cases/units.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::tools {

namespace {

using coupling::Vec3;

std::string as_time(double t) { return cases::format_quantity(t, cases::unit::time); }

/// Moment of the series nearest to a time. It must be as near as the series is dense.
double nearest_moment(const std::vector<output::SeriesEntry>& entries, const cases::RunField& wanted) {
  std::vector<double> times;
  for (const auto& e : entries)
    if (times.empty() || e.time > times.back()) times.push_back(e.time);
  const auto nearest = *std::min_element(times.begin(), times.end(), [&](double a, double b) {
    return std::abs(a - wanted.at) < std::abs(b - wanted.at);
  });
  double interval = 0.0;
  for (std::size_t n = 1; n < times.size(); ++n) interval = std::max(interval, times[n] - times[n - 1]);
  if (std::abs(nearest - wanted.at) <= std::max(0.5 * interval * (1.0 + 1e-6), 1e-3 * wanted.at)) return nearest;
  throw std::invalid_argument(wanted.run + " has no field at " + as_time(wanted.at) + "; it has " +
                              std::to_string(times.size()) + " from " + as_time(times.front()) + " to " +
                              as_time(times.back()));
}

Vec3 velocity_at(const output::FieldFrame& frame, const Vec3& x) {
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  std::array<int, 3> base{};
  Vec3 part;
  for (int d = 0; d < 3; ++d) {
    const double at = (x[d] - frame.origin[d]) / frame.dx;
    base[d] = static_cast<int>(std::floor(at));
    part[d] = at - base[d];
  }
  for (int n = 0; n < 8; ++n) {
    double w = 1.0;
    std::int64_t cell = 0;
    bool inside = true;
    for (int d = 2; d >= 0; --d) {
      const int high = n >> d & 1, c = base[d] + high;
      w *= high ? part[d] : 1.0 - part[d];
      inside = inside && c >= 0 && c < frame.size[d];
      cell = cell * frame.size[d] + c;
    }
    if (!inside || w <= 0.0 || frame.fluid[static_cast<std::size_t>(cell)] == 0) continue;
    const float* u = frame.velocity.data() + 3 * cell;
    sum += w * Vec3(u[0], u[1], u[2]);
    weight += w;
  }
  return weight > 1e-9 ? Vec3(sum / weight) : Vec3(Vec3::Zero());
}

}  // namespace

std::function<Vec3(const Vec3&)> read_stored_field(const cases::RunField& wanted) {
  const std::filesystem::path folder = std::filesystem::path(wanted.run) / "vtk", series = folder / "fields.pvd";
  if (!std::filesystem::exists(series))
    throw std::invalid_argument(wanted.run + " stores no fields: its case needs fields = [{ what = [\"velocity\"], " +
                                "every = ... }] in [output]");
  const auto entries = output::read_pvd(series);
  if (entries.empty()) throw std::invalid_argument(wanted.run + " stores no fields yet");
  const double moment = nearest_moment(entries, wanted);
  auto best = std::make_shared<output::FieldFrame>();
  for (const auto& e : entries) {
    if (e.time != moment) continue;
    output::FieldFrame frame = output::read_field_frame(folder / e.file);
    if (frame.velocity.empty() || frame.cells() <= best->cells()) continue;
    *best = std::move(frame);
  }
  if (best->velocity.empty()) throw std::invalid_argument(wanted.run + " stores fields, but no velocity");
  return [frame = std::shared_ptr<const output::FieldFrame>(best)](const Vec3& x) { return velocity_at(*frame, x); };
}

}  // namespace puffin::tools
