#include "tests/tools/output/synthetic_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "tools/output/tables.hpp"
#include "tools/output/vtk_series.hpp"

namespace puffin::output {
namespace {

using Point = std::array<double, 3>;
constexpr double mm = 1e-3;

/// Adds a rectangle from `corner` along u and v as triangles of about 1 mm, its patch chosen by the triangle's middle.
void add_rectangle(WallFrame& walls, const Point& corner, const Point& u, const Point& v,
                   const std::function<int(const Point&)>& patch) {
  const auto length = [](const Point& p) { return std::hypot(p[0], p[1], p[2]); };
  const int n = std::max(1, static_cast<int>(std::lround(length(u) / mm)));
  const int m = std::max(1, static_cast<int>(std::lround(length(v) / mm)));
  const int base = static_cast<int>(walls.vertices.size());
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i <= n; ++i) {
      Point p;
      for (int c = 0; c < 3; ++c) p[c] = std::round((corner[c] + u[c] * i / n + v[c] * j / m) * 1e9) / 1e9;
      walls.vertices.push_back(p);
    }
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = base + i + (n + 1) * j, b = a + 1, c = a + n + 1, d = c + 1;
      for (const auto& triangle : {std::array<int, 3>{a, b, d}, std::array<int, 3>{a, d, c}}) {
        Point middle{};
        for (const int k : triangle) {
          for (int x = 0; x < 3; ++x) middle[x] += walls.vertices[k][x] / 3;
        }
        walls.triangles.push_back(triangle);
        walls.patch.push_back(patch(middle));
      }
    }
  }
}

bool inside_l(double x, double y) { return (x < 30 * mm && y < 7 * mm) || (x > 23 * mm && x < 30 * mm && y < 25 * mm); }

}  // namespace

WallFrame synthetic_walls() {
  WallFrame walls;
  walls.patches = {{"wall", false}, {"inlet", true}, {"outlet", true}, {"pocket", false}};
  const auto always = [](int patch) { return [patch](const Point&) { return patch; }; };
  const auto floor = [](const Point& p) { return std::hypot(p[0] - 8 * mm, p[1] - 3.5 * mm) < 2.4 * mm ? 3 : 0; };
  const double h = 4.5 * mm;
  for (const auto& [x0, y0, x1, y1] :
       {std::array{0., 0., 23., 7.}, std::array{23., 0., 30., 7.}, std::array{23., 7., 30., 25.}}) {
    add_rectangle(walls, {x0 * mm, y0 * mm, 0}, {0, (y1 - y0) * mm, 0}, {(x1 - x0) * mm, 0, 0}, floor);
    add_rectangle(walls, {x0 * mm, y0 * mm, h}, {(x1 - x0) * mm, 0, 0}, {0, (y1 - y0) * mm, 0}, always(0));
  }
  const std::array<std::array<double, 2>, 6> corners{{{0, 0}, {30, 0}, {30, 25}, {23, 25}, {23, 7}, {0, 7}}};
  for (int side = 0; side < 6; ++side) {
    const auto& a = corners[side];
    const auto& b = corners[(side + 1) % 6];
    add_rectangle(walls, {a[0] * mm, a[1] * mm, 0}, {(b[0] - a[0]) * mm, (b[1] - a[1]) * mm, 0}, {0, 0, h},
                  always(side == 5   ? 1
                         : side == 2 ? 2
                                     : 0));
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<float> noise(0.3f, 1.0f);
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    const auto& p = walls.vertices[walls.triangles[t][0]];
    const double far = std::hypot(p[0] - 29 * mm, p[1] - 4 * mm, 0.5 * (p[2] - 2 * mm)) / (5 * mm);
    const bool wall = walls.patch[t] == 0;
    const auto strength = static_cast<float>(wall ? std::exp(-far * far) : 0.0);
    walls.fines.push_back(strength > 1e-6f ? 4e11f * strength * noise(random) : 0.0f);
    walls.hits.push_back(std::floor(300 * strength * noise(random)));
    walls.energy.push_back(walls.hits.back() * 5e-10f);
  }
  return walls;
}

FieldFrame synthetic_field(double time) {
  FieldFrame field;
  field.dx = 0.5 * mm;
  field.size = {60, 50, 9};
  field.origin = {0.25 * mm, 0.25 * mm, 0.25 * mm};
  for (int k = 0; k < 9; ++k) {
    for (int j = 0; j < 50; ++j) {
      for (int i = 0; i < 60; ++i) {
        const double x = field.origin[0] + i * field.dx, y = field.origin[1] + j * field.dx;
        const double z = (k + 0.5) / 9;
        const bool fluid = inside_l(x, y);
        const double across = x < 23 * mm ? y / (7 * mm) : (30 * mm - x) / (7 * mm);
        const double speed = 400 * time * 16 * across * (1 - across) * z * (1 - z);
        const double turn =
            std::clamp((x - 21 * mm + 0.6 * (y - 3.5 * mm)) / (7 * mm), 0.0, 1.0) * std::numbers::pi / 2;
        field.fluid.push_back(fluid);
        field.velocity.push_back(static_cast<float>(speed * std::cos(turn)));
        field.velocity.push_back(static_cast<float>(speed * std::sin(turn)));
        field.velocity.push_back(0);
        field.pressure.push_back(static_cast<float>(3000 * (1 - x / (30 * mm))));
      }
    }
  }
  return field;
}

CarrierFrame synthetic_carriers(double time) {
  CarrierFrame frame;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 1500; ++i) {
    const double angle = 2 * std::numbers::pi * unit(random), radius = 2.2 * mm * std::sqrt(unit(random));
    const Point start{8 * mm + radius * std::cos(angle), 3.5 * mm + radius * std::sin(angle), 0.9 * mm * unit(random)};
    const double begin = 0.06 + 0.09 * unit(random), lift = unit(random), lane = unit(random);
    const double flight = std::max(0.0, time - begin), speed = 60 * flight;  // constant acceleration of 60 m/s^2
    double path = 0.5 * 60 * flight * flight;
    Point p = start;
    std::array<float, 3> v{0, 0, 0};
    const double to_corner = 29.5 * mm - 5 * mm * lane - start[0];
    if (path < to_corner) {
      p[0] += path, v = {static_cast<float>(speed), 0, 0};
    } else {
      p[0] += to_corner, p[1] += (path - to_corner) * 0.7, v = {0, static_cast<float>(0.7 * speed), 0};
    }
    p[2] += (4.4 * mm - p[2]) * lift * std::min(1.0, path / (10 * mm));
    if (p[1] > 25 * mm) continue;
    frame.position.push_back(p);
    frame.id.push_back(i);
    frame.diameter.push_back(151e-6f);
    frame.velocity.push_back(v);
    frame.fines.push_back(2000);
    frame.asleep.push_back(flight <= 0);
  }
  return frame;
}

Summary synthetic_summary() {
  Summary s;
  s.name = "L-Base", s.version = "0.1.0", s.state = "finished", s.host = "x86-64-v3";
  s.simulated_time = 0.211, s.wall_clock = 312.4, s.threads = 2;
  s.cells_fluid = 213576, s.cells_active = 251330, s.steps = 421000;
  s.mlups = 41.2, s.mlups_active = 48.5, s.dx = 0.234e-3, s.dt_min = 3.4e-7, s.dt_max = 2.1e-6;
  s.tau_min = 0.50031, s.mach_max = 0.23, s.memory_peak = 1.62e8;
  s.phases = {{"air", 190.0}, {"carriers", 71.5}, {"fines", 30.2}, {"coupling", 14.1}, {"output", 6.6}};
  s.skipped = {{"carriers asleep in the pocket", 310000, 48.0}, {"fines before the first contact", 120000, 22.5}};
  s.pressure = PressureSummary{{1950, 1900, 2000, 20}, {2610, 2550, 2670, 20}, 0.19, 0.211, {}};
  s.carriers = CarrierSummary{15000, 14640, 360, 0.024, 0.064, 0.0971, 0.2098, 0.13, {}};
  s.fines = {{"L-Base", 0.64, 0.13, 0.022, 0.205, 0.003, 4e-13, {0.996, 0.0039, 1e-4}}};
  s.collisions = CollisionSummary{231000, 498000, 23, 24, 5.9e-10, 2.1e-13, {}};
  s.assumptions = {"The leg behind the bend is 4.6 mm wide: the thesis does not give it.",
                   "Micro-models are a surrogate (surface energy 3.6 mJ/m\xC2\xB2)."};
  return s;
}

void write_synthetic_run(const std::filesystem::path& folder, RunKind kind) {
  std::filesystem::create_directories(folder);
  const bool carriers = kind != RunKind::flow_only;
  const double end = kind == RunKind::diverged ? 0.12 : 0.211;
  Summary summary = synthetic_summary();
  summary.simulated_time = end;
  if (!carriers) {
    summary.name = "L-bend, air only";
    summary.carriers.reset(), summary.collisions.reset(), summary.fines.clear();
  }
  if (kind == RunKind::diverged) {
    summary.state = "diverged";
    summary.message =
        "step 231044, t = 120.0 ms: cell (88, 14, 9) at (20.6, 3.3, 2.1) mm has a speed of 0.61 (limit 0.5)";
  }
  std::vector<ReferenceValue> given{{"total_to_static_drop", 2600, {}, {}},
                                    {"experiment.total_to_static_drop", 3600, 3260, 3960}};
  if (carriers) {
    given = {{"FFE", 0.67, {}, {}},
             {"FFW", 0.12, {}, {}},
             {"FFCR", 0.0, {}, {}},
             {"FFCE", 0.21, {}, {}},
             {"median_per_carrier", 24, {}, {}},
             {"collisions.wall", 232560, {}, {}},
             {"first_emitted", 0.098, {}, {}},
             {"experiment.FFE", 0.41, 0.23, 0.64},
             {"experiment.RDF", 0.16, 0.0, 0.27},
             {"pocket_emptied", 0.2, {}, {}},
             given[0],
             given[1]};
  }
  compare_with_reference(summary, given);
  write_summary(folder / "summary.json", summary);

  CsvFile history(folder / "history.csv", history_columns());
  for (double t = 0; t <= end + 1e-9; t += 0.001) {
    HistoryRow row;
    row.time = t, row.dt = 2e-6 / (1 + 5 * t);
    row.flow_rate = 2.5e-3 * t;  // 150 L/min a second
    const double q = row.flow_rate / 6e-4;
    row.static_drop = 2300 * q * q * (1 + 0.02 * std::sin(900 * t)), row.total_to_static_drop = 3100 * q * q;
    if (carriers) {
      const double gone = std::clamp((t - 0.097) / 0.11, 0.0, 1.0), part = gone * gone * (3 - 2 * gone);
      const double moved = std::clamp((t - 0.07) / 0.1, 0.0, 1.0);
      row.carriers_emitted = std::round(14640 * part), row.carriers_in = 15000 - row.carriers_emitted;
      row.FFE = 0.64 * part, row.FFW = 0.13 * moved * moved, row.FFCE = 0.205 * part;
      row.in_air = 0.64 * moved * moved * (3 - 2 * moved) - row.FFE;
      row.in_air = std::max(row.in_air, 0.0);
      row.FFCR = 1 - row.FFE - row.FFW - row.FFCE - row.in_air;
      row.ledger_error = 1e-13 * t;
    }
    append(history, row);
  }
  history.flush();

  VtkSeries walls(folder / "vtk", "walls"), fields(folder / "vtk", "fields");
  walls.append(end, synthetic_walls());
  for (double t = 0; t <= end + 1e-9; t += 0.05) fields.append(t, synthetic_field(t));
  if (!carriers) return;
  VtkSeries bodies(folder / "vtk", "carriers");
  for (double t = 0; t <= end + 1e-9; t += 0.01) bodies.append(t, synthetic_carriers(t));
}

}  // namespace puffin::output
