// Pipe and bend. The inlet's centre lies in the origin, the flow enters along +x, a bend turns towards +y.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/generators/faces.hpp"
#include "cases/generators/kinds.hpp"
#include "cases/generators/outline.hpp"

namespace puffin::cases::generators {
namespace {

using enum Provenance;
using enum Range;
constexpr double mm = 1e-3;

bool is_round(const Values& v) { return v.number("diameter") > 0.0; }

/// Width of the bend in its plane.
double bend_width(const Values& v) { return v.number(is_round(v) ? "diameter" : "width"); }

/// From the beginning of the bend to the crossing of the centre lines.
double tangent_length(const Values& v) {
  return (v.number("inner_radius") + 0.5 * bend_width(v)) * std::tan(0.5 * v.number("angle"));
}

std::vector<Leg> bend_legs(const Values& v) {
  return {{v.number("inlet_length") + tangent_length(v), bend_width(v), v.number("angle")},
          {v.number("outlet_length") + tangent_length(v), bend_width(v), 0.0}};
}

Outline bend_plan(const Values& v) { return outline(bend_legs(v), v.number("inner_radius"), v.number("facet_size")); }

void add_rectangular_bend(const Values& v, Surface& surface) {
  const Outline plan = bend_plan(v);
  const Vec3 low(0, 0, -0.5 * v.number("height")), up(0, 0, v.number("height"));
  Loop floor, ceiling;
  for (const Vec2& p : plan.polygon()) {
    floor.push_back(low + Vec3(p.x(), p.y(), 0));
    ceiling.push_back(floor.back() + up);
  }
  surface.add("wall", reversed(floor));
  surface.add("wall", ceiling);
  const std::size_t outlet = plan.right.size() - 1;
  for (std::size_t k = 0; k < floor.size(); ++k) {
    const char* solid = k == outlet ? "outlet" : k + 1 == floor.size() ? "inlet" : "wall";
    add_parallelogram(solid, floor[k], floor[(k + 1) % floor.size()] - floor[k], up, surface);
  }
}

/// Rings along the pipe: at the ends, and at every kink of the centre line in its bisecting plane.
void add_round_bend(const Values& v, Surface& surface) {
  const double radius = 0.5 * v.number("diameter"), angle = v.number("angle"), inner = v.number("inner_radius");
  const int n = ring_corners(radius, v.number("facet_size"), 96);
  const double centre_radius = inner + radius;
  const Vec3 z = Vec3::UnitZ(), pivot(v.number("inlet_length"), centre_radius, 0.0);
  const auto frame = [](double a) {
    return std::pair{Vec3(std::cos(a), std::sin(a), 0), Vec3(-std::sin(a), std::cos(a), 0)};
  };
  Loop last;
  const auto reach = [&](Loop next) {
    if (last.empty())
      surface.add("inlet", reversed(next));
    else
      add_band("wall", last, next, surface);
    last = std::move(next);
  };
  if (v.number("inlet_length") > 0.0 || inner == 0.0) reach(ring(Vec3::Zero(), Vec3::UnitY(), z, radius, n));
  if (inner > 0.0) {
    const int pieces = chords(angle, inner + 2.0 * radius, v.number("facet_size"));
    for (int k = 0; k <= pieces; ++k) {
      const Vec3 left = frame(angle * k / pieces).second;
      reach(ring(pivot - centre_radius * left, left, z, radius, n));
    }
  } else {
    const Vec3 kink(v.number("inlet_length") + tangent_length(v), 0, 0);
    reach(ring(kink, frame(0.5 * angle).second / std::cos(0.5 * angle), z, radius, n));
  }
  const auto [along, left] = frame(angle);
  const Vec3 bend_end =
      inner > 0.0 ? Vec3(pivot - centre_radius * left)
                  : Vec3(Vec3(v.number("inlet_length") + tangent_length(v), 0, 0) + tangent_length(v) * along);
  if (v.number("outlet_length") > 0.0 || inner == 0.0)
    reach(ring(bend_end + v.number("outlet_length") * along, left, z, radius, n));
  surface.add("outlet", last);
}

void complete_bend(Values& v, Problems& problems) {
  const double degree = std::numbers::pi / 180.0;
  if (v.number("angle") > 170.0 * degree)
    problems.push_back({"angle", "is more than 170 degrees; bends turn by less (a bare number is in radians)"});
  choose_facet_size(v,
                    is_round(v) ? 0.1 * v.number("diameter") : 0.25 * std::min(v.number("width"), v.number("height")));
  if (v.number("inner_radius") == 0.0)
    for (const char* name : {"inlet_length", "outlet_length"})
      if (v.number(name) <= 1e-3 * bend_width(v))
        problems.push_back({name, "is 0; a mitre (inner_radius = 0) needs a straight piece on both sides"});
}

KeyPoints bend_points(const Values& v) {
  const std::vector<Leg> legs = bend_legs(v);
  const Vec2 end = bend_plan(v).end;
  KeyPoints points;
  points.inlet = Vec3::Zero();
  points.outlet = Vec3(end.x(), end.y(), 0.0);
  points.path_length = legs[0].length + legs[1].length;
  return points;
}

}  // namespace

Kind pipe_kind() {
  return {"pipe",
          "a straight round pipe on the x-axis, from x = 0",
          {{"diameter", 5.0 * mm, "m", "diameter; the section is an inscribed polygon", assumed, positive},
           {"length", 50.0 * mm, "m", "length (x)", assumed, positive},
           {"periodic", false, "", "name the ends x-min and x-max", assumed},
           facet_size_info(0.0)},
          [](Values& v, Problems&) { choose_facet_size(v, 0.1 * v.number("diameter")); },
          [](const Values& v, Surface& s) {
            const double radius = 0.5 * v.number("diameter");
            const int n = ring_corners(radius, v.number("facet_size"), 96);
            const Loop in = ring(Vec3::Zero(), Vec3::UnitY(), Vec3::UnitZ(), radius, n);
            const Loop out = ring(Vec3(v.number("length"), 0, 0), Vec3::UnitY(), Vec3::UnitZ(), radius, n);
            s.add(v.flag("periodic") ? "x-min" : "inlet", reversed(in));
            s.add(v.flag("periodic") ? "x-max" : "outlet", out);
            add_band("wall", in, out, s);
          },
          [](const Values& v) {
            KeyPoints points;
            points.inlet = Vec3::Zero();
            points.outlet = Vec3(v.number("length"), 0, 0);
            points.path_length = v.number("length");
            return points;
          }};
}

Kind bend_kind() {
  return {"bend",
          "a duct or a pipe with one bend, sharp or rounded; on the x-axis from x = 0, then towards +y",
          {{"width", 7.0 * mm, "m", "width in the plane of the bend", assumed, positive},
           {"height", 3.5 * mm, "m", "height (z), across the plane of the bend", assumed, positive},
           {"diameter", 0.0, "m", "diameter of a round section; 0: rectangular, width by height", assumed},
           {"angle", 0.5 * std::numbers::pi, "rad", "angle by which the flow is turned", assumed, positive},
           {"inner_radius", 0.0, "m", "radius of the inner side; 0: a mitre", assumed},
           {"inlet_length", 30.0 * mm, "m", "straight length before the bend (inner side)", assumed},
           {"outlet_length", 30.0 * mm, "m", "straight length behind the bend (inner side)", assumed},
           facet_size_info(0.0)},
          complete_bend,
          [](const Values& v, Surface& s) {
            s.declare({"inlet", "outlet", "wall"});
            if (is_round(v))
              add_round_bend(v, s);
            else
              add_rectangular_bend(v, s);
          },
          bend_points};
}

}  // namespace puffin::cases::generators
