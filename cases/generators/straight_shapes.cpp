// Straight shapes of rectangular section: duct, box, backward-facing step. One corner lies in the origin.

#include <algorithm>

#include "cases/generators/faces.hpp"
#include "cases/generators/kinds.hpp"

namespace puffin::cases::generators {
namespace {

using enum Provenance;
using enum Range;
constexpr double mm = 1e-3;

constexpr SideNames wall{"wall", "wall", "wall", "wall"};
constexpr SideNames box_sides{"y-min", "y-max", "z-min", "z-max"};

/// A tube with both ends: the whole of a duct or a box.
void add_block(const Vec3& size, bool named_faces, Surface& surface) {
  const Section section{0.0, size.y(), 0.0, size.z()};
  if (named_faces)
    surface.declare({"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"});
  else
    surface.declare({"inlet", "outlet", "wall"});
  add_end(named_faces ? "x-min" : "inlet", 0.0, section, false, surface);
  add_end(named_faces ? "x-max" : "outlet", size.x(), section, true, surface);
  add_sides(named_faces ? box_sides : wall, 0.0, size.x(), section, surface);
}

KeyPoints block_points(const Vec3& size) {
  KeyPoints points;
  points.inlet = Vec3(0.0, 0.5 * size.y(), 0.5 * size.z());
  points.outlet = Vec3(size.x(), 0.5 * size.y(), 0.5 * size.z());
  points.path_length = size.x();
  return points;
}

Vec3 duct_size(const Values& v) { return {v.number("length"), v.number("width"), v.number("height")}; }
Vec3 box_size(const Values& v) { return {v.number("x"), v.number("y"), v.number("z")}; }

/// A quarter of the shortest side; for shapes that are thin (one cell of a two-dimensional flow) not below 1/200 of the
/// whole, or the thickness would set the number of triangles.
double facet_of(const Vec3& size) { return std::max(0.25 * size.minCoeff(), 0.005 * size.norm()); }

struct StepSections {
  Section before, after;
};
StepSections step_sections(const Values& v) {
  const double width = v.number("width"), step = v.number("step_height"), top = step + v.number("inlet_height");
  return {{0.0, width, step, top}, {0.0, width, 0.0, top}};
}

}  // namespace

Kind duct_kind() {
  return {"duct",
          "a straight duct of rectangular section; a corner in the origin",
          {{"length", 50.0 * mm, "m", "length (x)", assumed, positive},
           {"width", 7.0 * mm, "m", "width (y)", assumed, positive},
           {"height", 3.5 * mm, "m", "height (z)", assumed, positive},
           {"periodic", false, "", "name the six faces x-min ... z-max, as a box has them", assumed},
           facet_size_info(0.0)},
          [](Values& v, Problems&) { choose_facet_size(v, facet_of(duct_size(v))); },
          [](const Values& v, Surface& s) { add_block(duct_size(v), v.flag("periodic"), s); },
          [](const Values& v) { return block_points(duct_size(v)); }};
}

Kind box_kind() {
  return {"box",
          "a box, its six faces named x-min ... z-max; a corner in the origin",
          {{"x", 10.0 * mm, "m", "length (x)", assumed, positive},
           {"y", 10.0 * mm, "m", "width (y)", assumed, positive},
           {"z", 10.0 * mm, "m", "height (z)", assumed, positive},
           facet_size_info(0.0)},
          [](Values& v, Problems&) { choose_facet_size(v, facet_of(box_size(v))); },
          [](const Values& v, Surface& s) { add_block(box_size(v), true, s); },
          [](const Values& v) { return block_points(box_size(v)); }};
}

Kind step_kind() {
  return {"step",
          "a backward-facing step: the floor drops by step_height at x = inlet_length; a corner in the origin",
          {{"inlet_height", 2.0 * mm, "m", "height (z) before the step", assumed, positive},
           {"step_height", 2.0 * mm, "m", "height of the step", assumed, positive},
           {"width", 7.0 * mm, "m", "width (y)", assumed, positive},
           {"inlet_length", 10.0 * mm, "m", "length before the step", assumed, positive},
           {"outlet_length", 40.0 * mm, "m", "length behind the step", assumed, positive},
           {"periodic", false, "", "name the two sides y-min and y-max, for a two-dimensional flow", assumed},
           facet_size_info(0.0)},
          [](Values& v, Problems&) {
            const double thinnest = std::min({v.number("inlet_height"), v.number("step_height"), v.number("width")});
            choose_facet_size(
                v, std::max(0.25 * thinnest, 0.005 * (v.number("inlet_length") + v.number("outlet_length"))));
          },
          [](const Values& v, Surface& s) {
            const auto [before, after] = step_sections(v);
            const double edge = v.number("inlet_length"), end = edge + v.number("outlet_length");
            const SideNames sides = v.flag("periodic") ? SideNames{"y-min", "y-max", "wall", "wall"} : wall;
            s.declare({"inlet", "outlet", "wall", "y-min", "y-max"});
            add_end("inlet", 0.0, before, false, s);
            add_sides(sides, 0.0, edge, before, s);
            add_section_change("wall", edge, before, after, s);
            add_sides(sides, edge, end, after, s);
            add_end("outlet", end, after, true, s);
          },
          [](const Values& v) {
            const auto [before, after] = step_sections(v);
            KeyPoints points;
            points.path_length = v.number("inlet_length") + v.number("outlet_length");
            points.inlet = before.centre(0.0);
            points.outlet = after.centre(points.path_length);
            return points;
          }};
}

}  // namespace puffin::cases::generators
