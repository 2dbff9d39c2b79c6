// The two devices of the thesis: inlet, lip, backward-facing step, pocket, one bend (L) or four (Omega).
// The thesis's drawings are not available: what it does not state is a parameter marked assumed, see
// docs/assumptions-geometry.md.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "cases/generators/faces.hpp"
#include "cases/generators/kinds.hpp"
#include "cases/generators/outline.hpp"

namespace puffin::cases::generators {
namespace {

constexpr double mm = 1e-3;

/// Turns at the ends of the legs, > 0 to the left: L turns once; Omega goes out, across, back and on.
std::vector<double> turns(std::size_t legs) {
  const double right_angle = 0.5 * std::numbers::pi;
  if (legs == 2) return {right_angle, 0.0};
  return {right_angle, -right_angle, -right_angle, right_angle, 0.0};
}

std::vector<Leg> legs_of(const Values& v) {
  const auto &lengths = v.numbers("leg_lengths"), &widths = v.numbers("leg_widths");
  const std::vector<double> turn = turns(lengths.size());
  std::vector<Leg> legs;
  for (std::size_t i = 0; i < lengths.size(); ++i) legs.push_back({lengths[i], widths[i], turn[i]});
  return legs;
}

Outline plan_of(const Values& v) { return outline(legs_of(v), v.number("bend_inner_radius"), v.number("facet_size")); }

/// Section of the inlet or of the lip: its floor is the top of the step.
Section inlet_section(const Values& v, double height) {
  const double half = 0.5 * v.number("inlet_width"), floor = v.number("step_height");
  return {-half, half, floor, floor + height};
}

bool has_lip(const Values& v) { return v.number("lip_height") > v.number("inlet_height"); }
bool has_pocket(const Values& v) { return v.number("pocket_depth") > 0.0; }

Pocket pocket_of(const Values& v) {
  const double top = v.number("pocket_top_diameter"), depth = v.number("pocket_depth");
  return {Vec3(v.number("pocket_distance") + 0.5 * top, 0.0, -depth), v.number("pocket_bottom_diameter"), top, depth};
}

int pocket_corners(const Values& v) {
  return ring_corners(0.5 * v.number("pocket_top_diameter"), v.number("facet_size"));
}

/// Volume of the surface as it is meshed: prisms, and a frustum between two regular polygons.
double volume_of(const Values& v) {
  const double lip_length = has_lip(v) ? v.number("lip_length") : 0.0;
  double volume = v.number("inlet_width") * (v.number("inlet_height") * (v.number("inlet_length") - lip_length) +
                                             v.number("lip_height") * lip_length) +
                  v.number("duct_height") * plan_of(v).area();
  if (has_pocket(v)) {
    const int n = pocket_corners(v);
    const double a = 0.5 * v.number("pocket_bottom_diameter"), b = 0.5 * v.number("pocket_top_diameter");
    volume += 0.5 * n * std::sin(2.0 * std::numbers::pi / n) * v.number("pocket_depth") * (a * a + a * b + b * b) / 3.0;
  }
  return volume;
}

/// Legs of length 0 become equally long, so that the volume is the asked one: it is linear in their length.
void solve_free_legs(Values& v, Problems& problems) {
  std::vector<double> lengths = v.numbers("leg_lengths");
  const std::vector<double>& widths = v.numbers("leg_widths");
  double section = 0.0;  // volume gained per length of the free legs
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if (lengths[i] == 0.0) section += widths[i] * v.number("duct_height");
  if (section == 0.0) return;
  const double missing = (v.number("volume") - volume_of(v)) / section;
  if (missing <= 0.0) {
    problems.push_back({"volume",
                        "leaves no room for the legs of length 0 in leg_lengths; give it more, or give all "
                        "leg_lengths"});
    return;
  }
  for (double& length : lengths)
    if (length == 0.0) length = missing;
  v.set("leg_lengths", lengths);
}

void check_inlet(const Values& v, Problems& problems) {
  const double inlet = v.number("inlet_height"), lip = v.number("lip_height"), step = v.number("step_height");
  const double opening = std::max(inlet, lip), duct = v.number("duct_height");
  if (lip > 0.0 && lip < inlet)
    problems.push_back({"lip_height", "is " + millimetres(lip) + ", below the inlet's " + millimetres(inlet) +
                                          "; the lip is the higher end of the inlet (0: no lip)"});
  if (has_lip(v) && (v.number("lip_length") <= 0.0 || v.number("lip_length") >= v.number("inlet_length")))
    problems.push_back({"lip_length", "is " + millimetres(v.number("lip_length")) +
                                          "; it must lie between 0 and inlet_length (" +
                                          millimetres(v.number("inlet_length")) + "), which contains it"});
  if (step + opening > duct * (1.0 + 1e-9))
    problems.push_back({"step_height", "and the opening above it are " + millimetres(step + opening) +
                                           " high, the duct only " + millimetres(duct) +
                                           "; lower step_height or raise duct_height"});
}

void check_pocket(const Values& v, Problems& problems) {
  if (!has_pocket(v)) return;
  const double top = v.number("pocket_top_diameter"), bottom = v.number("pocket_bottom_diameter");
  const double distance = v.number("pocket_distance");
  if (bottom <= 0.0) problems.push_back({"pocket_bottom_diameter", "is 0; for no pocket set pocket_depth = 0"});
  if (bottom > top)
    problems.push_back({"pocket_bottom_diameter", "is " + millimetres(bottom) + ", wider than the top's " +
                                                      millimetres(top) + "; the pocket must open upwards"});
  if (top >= v.number("duct_width"))
    problems.push_back({"pocket_top_diameter", "is " + millimetres(top) + "; the duct is only " +
                                                   millimetres(v.number("duct_width")) + " wide"});
  if (distance <= 0.0) problems.push_back({"pocket_distance", "is 0; the rim of the pocket must not touch the step"});
}

/// Whether every leg is long enough for its bends, and the first one for the pocket.
void check_legs(const Values& v, Problems& problems) {
  const Outline plan = plan_of(v);
  for (std::size_t i = 0; i < plan.straight.size(); ++i)
    if (plan.straight[i] < 1e-3 * v.numbers("leg_widths")[i])
      problems.push_back({"leg_lengths", "give leg " + std::to_string(i + 1) + " " +
                                             millimetres(v.numbers("leg_lengths")[i]) + "; its bends need " +
                                             millimetres(-plan.straight[i]) +
                                             " more (or a smaller bend_inner_radius)"});
  if (!problems.empty() || !has_pocket(v)) return;
  const double end = v.number("pocket_distance") + v.number("pocket_top_diameter");
  if (end >= plan.straight[0])
    problems.push_back({"pocket_distance", "puts the far rim of the pocket " + millimetres(end) +
                                               " behind the step; the first leg is straight for only " +
                                               millimetres(plan.straight[0])});
}

void complete_device(Values& v, Problems& problems, std::size_t legs) {
  for (const char* name : {"leg_lengths", "leg_widths"})
    if (v.numbers(name).size() != legs)
      problems.push_back({name, "has " + std::to_string(v.numbers(name).size()) + " numbers; it needs " +
                                    std::to_string(legs) + ", one for each leg"});
  if (!problems.empty()) return;
  std::vector<double> widths = v.numbers("leg_widths");
  if (widths[0] != 0.0 && widths[0] != v.number("duct_width"))
    problems.push_back({"leg_widths", "begins with " + millimetres(widths[0]) +
                                          "; the first leg is as wide as "
                                          "duct_width: write 0 there, or the same value"});
  for (double& width : widths)
    if (width == 0.0) width = v.number("duct_width");
  v.set("leg_widths", widths);
  if (v.number("lip_height") == 0.0) v.set("lip_height", v.number("inlet_height"));
  choose_facet_size(v, 0.2 * v.number("duct_height"));
  check_inlet(v, problems);
  check_pocket(v, problems);
  if (!problems.empty()) return;
  solve_free_legs(v, problems);
  if (problems.empty()) check_legs(v, problems);
}

void add_duct(const Values& v, Surface& surface) {
  const Outline plan = plan_of(v);
  const double height = v.number("duct_height");
  const std::vector<Vec2> polygon = plan.polygon();
  Loop floor, ceiling;
  for (const Vec2& p : polygon) {
    floor.emplace_back(p.x(), p.y(), 0.0);
    ceiling.emplace_back(p.x(), p.y(), height);
  }
  const Vec3 up(0, 0, height);
  std::vector<Loop> holes;
  if (has_pocket(v)) {
    const Pocket pocket = pocket_of(v);
    const int n = pocket_corners(v);
    const Loop bottom = ring(pocket.floor, Vec3::UnitX(), Vec3::UnitY(), 0.5 * pocket.bottom_diameter, n);
    const Loop top =
        ring(pocket.floor + Vec3(0, 0, pocket.depth), Vec3::UnitX(), Vec3::UnitY(), 0.5 * pocket.top_diameter, n);
    add_band("pocket", bottom, top, surface);
    surface.add("pocket", reversed(bottom));
    holes.push_back(top);
  }
  surface.add("wall", reversed(floor), holes);
  surface.add("wall", ceiling);
  const std::size_t outlet = plan.right.size() - 1;
  for (std::size_t k = 0; k + 1 < floor.size(); ++k)  // the last edge is the plane of the step
    add_parallelogram(k == outlet ? "outlet" : "wall", floor[k], floor[k + 1] - floor[k], up, surface);
}

void add_device(const Values& v, Surface& surface) {
  const SideNames wall{"wall", "wall", "wall", "wall"};
  const Section inlet = inlet_section(v, v.number("inlet_height")), lip = inlet_section(v, v.number("lip_height"));
  const double half = 0.5 * v.number("duct_width"), start = -v.number("inlet_length");
  const double lip_start = has_lip(v) ? -v.number("lip_length") : 0.0;
  surface.declare({"inlet", "outlet", "wall", "pocket"});
  add_end("inlet", start, inlet, false, surface);
  add_sides(wall, start, lip_start, inlet, surface);
  if (has_lip(v)) {
    add_section_change("wall", lip_start, inlet, lip, surface);
    add_sides(wall, lip_start, 0.0, lip, surface);
  }
  add_section_change("wall", 0.0, lip, {-half, half, 0.0, v.number("duct_height")}, surface);
  add_duct(v, surface);
}

KeyPoints device_points(const Values& v) {
  KeyPoints points;
  const Vec2 end = plan_of(v).end;
  points.inlet = inlet_section(v, v.number("inlet_height")).centre(-v.number("inlet_length"));
  points.outlet = Vec3(end.x(), end.y(), 0.5 * v.number("duct_height"));
  if (has_pocket(v)) points.pocket = pocket_of(v);
  const auto& lengths = v.numbers("leg_lengths");
  points.path_length = std::accumulate(lengths.begin(), lengths.end(), v.number("inlet_length"));
  return points;
}

struct Defaults {
  double inlet_height, lip_height, step_height, duct_height;  // [m]
  Provenance lip;
  std::vector<double> leg_lengths, leg_widths;  // [m]
  std::string widths_meaning;
  double bend_inner_radius, volume;  // [m], [m^3]
};

std::vector<ParameterInfo> device_parameters(const Defaults& d) {
  using enum Provenance;
  using enum Range;
  return {
      {"inlet_width", 7.0 * mm, "m", "width (y) of the inlet", given, positive},
      {"inlet_height", d.inlet_height, "m", "height (z) of the inlet", given, positive},
      {"inlet_length", 4.0 * mm, "m", "from the inlet to the step, the lip included", assumed, positive},
      {"lip_height", d.lip_height, "m", "height of the inlet's end, its ceiling raised; 0: as the inlet", d.lip},
      {"lip_length", 2.0 * mm, "m", "length of the raised end, before the step", assumed},
      {"step_height", d.step_height, "m", "drop of the floor at the backward-facing step", assumed},
      {"duct_width", 7.0 * mm, "m", "width of the main duct, where the pocket is", assumed, positive},
      {"duct_height", d.duct_height, "m", "height (z) of the duct behind the step", assumed, positive},
      {"leg_lengths", d.leg_lengths, "m",
       "lengths of the legs along their centre lines, from the step to the outlet; 0: as long as `volume` asks",
       assumed},
      {"leg_widths", d.leg_widths, "m", d.widths_meaning, assumed},
      {"bend_inner_radius", d.bend_inner_radius, "m",
       "radius of the inner side of the bends, the outer side concentric; 0: sharp mitres", assumed},
      {"pocket_depth", 0.25 * mm, "m", "depth of the indentation for the dose; 0: none", given},
      {"pocket_bottom_diameter", 4.5 * mm, "m", "diameter of the indentation's floor", given},
      {"pocket_top_diameter", 5.0 * mm, "m", "diameter of the indentation's rim", given},
      {"pocket_distance", 1.0 * mm, "m", "from the step to the near side of the rim", assumed},
      {"volume", d.volume, "m^3",
       "volume of the fluid, if a leg has length 0 (the thesis: cells over cells per volume)", given, positive},
      facet_size_info(0.7 * mm),
  };
}

}  // namespace

Kind l_bend_kind() {
  return {"l-bend",
          "the thesis's L-bend: inlet, lip, step and pocket, a duct with one 90-degree bend",
          device_parameters({1.5 * mm,
                             2.0 * mm,
                             1.5 * mm,
                             3.5 * mm,
                             Provenance::given,
                             {65.0 * mm, 0.0},
                             {0.0, 5.75 * mm},
                             "widths of the legs; 0: duct_width",
                             0.0,
                             2751.6e-9}),
          [](Values& v, Problems& problems) { complete_device(v, problems, 2); },
          add_device,
          device_points};
}

Kind omega_bend_kind() {
  return {"omega-bend",
          "the thesis's Omega-bend: inlet, step and pocket, a duct with four 90-degree bends and a narrow middle part",
          device_parameters({2.5 * mm,
                             0.0,
                             2.0 * mm,
                             4.5 * mm,
                             Provenance::assumed,
                             {30.0 * mm, 18.0 * mm, 18.0 * mm, 18.0 * mm, 0.0},
                             {0.0, 4.0 * mm, 4.0 * mm, 4.0 * mm, 0.0},
                             "widths of the legs; 0: duct_width (the thesis gives the middle part 4 mm)",
                             3.0 * mm,
                             3144.6e-9}),
          [](Values& v, Problems& problems) { complete_device(v, problems, 5); },
          add_device,
          device_points};
}

}  // namespace puffin::cases::generators
