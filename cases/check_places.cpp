#include "cases/check_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cases/check_boundaries.hpp"
#include "cases/dose.hpp"
#include "cases/untagged_openings.hpp"

namespace puffin::cases {
namespace {

constexpr double shape = 0.1;  // of a radius: deeper than any contact goes

std::string element(const char* key, std::size_t i) { return std::string(key) + "[" + std::to_string(i) + "]"; }
std::string length(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g mm", 1e3 * value);
  return text;
}

}  // namespace

std::vector<Problem> carrier_place_problems(const Case& c, const lbm::geometry::TriangleTree& tree) {
  std::vector<Problem> problems;
  if (!c.carriers) return problems;
  for (std::size_t i = 0; i < c.carriers->list.size(); ++i) {
    if (tree.inside(c.carriers->list[i].position)) continue;
    const std::string key = element("carriers.list", i) + ".position";
    problems.push_back(problem_at(c, key,
                                  key + ": lies " + length(tree.closest(c.carriers->list[i].position).distance) +
                                      " outside the geometry; a carrier starts within it"));
  }
  return problems;
}

std::vector<Problem> output_place_problems(const Case& c, const lbm::geometry::TriangleTree& tree, double dx) {
  std::vector<Problem> problems;
  const auto say = [&](const std::string& key, const std::string& text) {
    problems.push_back(problem_at(c, key, key + ": " + text));
  };
  const auto beyond = [&](int axis, double low, double high) {
    return high < tree.min()[axis] - dx || low > tree.max()[axis] + dx;
  };
  const Output& out = c.output;
  for (std::size_t i = 0; i < out.probes.size(); ++i)
    if (!tree.inside(out.probes[i].at) && tree.closest(out.probes[i].at).distance > dx)
      say(element("output.probe", i), "'" + out.probes[i].name + "' lies outside the fluid");
  for (std::size_t i = 0; i < out.planes.size(); ++i)
    if (beyond(out.planes[i].axis, out.planes[i].at, out.planes[i].at))
      say(element("output.plane", i), "'" + out.planes[i].name + "' meets no fluid");
  for (std::size_t i = 0; i < out.fields.size(); ++i) {
    const Region& region = out.fields[i].region;
    if (const auto* slice = std::get_if<RegionSlice>(&region); slice && beyond(slice->axis, slice->at, slice->at))
      say(element("output.fields", i), "the slice lies outside the geometry");
    if (const auto* box = std::get_if<RegionBox>(&region))
      for (int d = 0; d < 3; ++d)
        if (beyond(d, box->min[d], box->max[d])) {
          say(element("output.fields", i), "the box lies outside the geometry");
          break;
        }
  }
  return problems;
}

std::vector<std::string> carrier_place_warnings(const Case& c, const lbm::geometry::TriangleTree& tree) {
  std::vector<std::string> warnings;
  if (!c.carriers) return warnings;
  for (const Boundary& b : c.air.boundaries) {
    if (b.type == BoundaryType::periodic)
      warnings.push_back("carriers bounce off the periodic patches '" + b.patch + "' and '" + b.with +
                         "': only the air goes on behind them");
    if (b.type == BoundaryType::moving_wall)
      warnings.push_back("carriers meet the moving wall '" + b.patch +
                         "' as one at rest: only the air is dragged along");
  }
  for (const std::string& name : doubtful_openings(c))
    warnings.push_back("carriers leave through '" + name +
                       "': no boundary says what it is; give it type = \"wall\" if it is one");
  if (c.carriers->list.empty()) return warnings;
  const std::vector<ListedCarrier>& list = c.carriers->list;
  const auto radius = [&](std::size_t i) { return 0.5 * parcel_diameter(list[i].diameter, c.carriers->parcel); };
  constexpr std::size_t most_named = 10;
  std::size_t overlaps = 0;
  const auto say = [&](std::size_t i, double depth, const std::string& where) {
    if (++overlaps > most_named) return;
    warnings.push_back(element("carriers.list", i) + " starts " + length(depth) + " deep in " + where +
                       ": the overlap is taken as its shape and pushes nothing");
  };
  std::vector<std::size_t> by_x(list.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    by_x[i] = i, largest = std::max(largest, radius(i));
    const double depth = radius(i) - tree.closest(list[i].position, radius(i)).distance;
    if (depth > shape * radius(i)) say(i, depth, "a wall");
  }
  std::sort(by_x.begin(), by_x.end(),
            [&](std::size_t a, std::size_t b) { return list[a].position.x() < list[b].position.x(); });
  for (std::size_t m = 0; m < by_x.size(); ++m)
    for (std::size_t n = m + 1; n < by_x.size(); ++n) {
      const std::size_t i = by_x[m], j = by_x[n];
      if (list[j].position.x() - list[i].position.x() > radius(i) + largest) break;
      const double depth = radius(i) + radius(j) - (list[i].position - list[j].position).norm();
      if (depth > shape * std::min(radius(i), radius(j)))
        say(std::max(i, j), depth, element("carriers.list", std::min(i, j)));
    }
  if (overlaps > most_named)
    warnings.push_back("carriers.list has " + std::to_string(overlaps - most_named) + " more such overlaps");
  return warnings;
}

}  // namespace puffin::cases
