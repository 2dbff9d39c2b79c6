#include "cases/generators/outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace puffin::cases::generators {
namespace {

Vec2 left_of(const Vec2& d) { return {-d.y(), d.x()}; }
double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

struct Side {
  std::vector<Vec2> line;      // the polyline so far
  double used = 0.0;           // tangent length taken from the current leg by the corner before it
  Vec2 corner = Vec2::Zero();  // where the current leg's side starts, corners taken sharp
};

/// Where the lines p + s d and q + t e meet.
Vec2 meet(const Vec2& p, const Vec2& d, const Vec2& q, const Vec2& e) {
  return p + d * (cross(q - p, e) / cross(d, e));
}

void append(const Vec2& point, std::vector<Vec2>& line) {
  if ((point - line.back()).norm() > 1e-9 * point.norm()) line.push_back(point);
}

/// Ends the current leg of one side at corner `sharp`, rounded with `radius`; returns the straight piece left over.
double turn_corner(const Vec2& sharp, const Vec2& d, double turn, double radius, double facet_size, Side& side) {
  const double tangent = radius * std::tan(0.5 * std::abs(turn));
  const double straight = (sharp - side.corner).dot(d) - side.used - tangent;
  if (radius > 0.0) {
    const Vec2 start = sharp - tangent * d, inwards = (turn > 0.0 ? 1.0 : -1.0) * left_of(d);
    const Vec2 centre = start + radius * inwards;
    const int pieces = chords(std::abs(turn), radius, facet_size);
    for (int k = 0; k <= pieces; ++k) {
      const double a = std::abs(turn) * k / pieces;
      append(centre + radius * (std::sin(a) * d - std::cos(a) * inwards), side.line);
    }
  } else {
    append(sharp, side.line);
  }
  side.corner = sharp;
  side.used = tangent;
  return straight;
}

}  // namespace

void refuse_too_many_corners(double corners) {
  if (!(corners <= 1e6)) throw std::length_error("the facet size asks for more than a million corners of a circle");
}

int chords(double angle, double radius, double facet_size) {
  const double by_angle = angle / (std::numbers::pi / 30.0), by_size = angle * radius / facet_size;
  refuse_too_many_corners(by_size);
  return std::max(1, static_cast<int>(std::ceil(std::max(by_angle, by_size) - 1e-9)));
}

Outline outline(const std::vector<Leg>& legs, double inner_radius, double facet_size) {
  Outline plan;
  Side left, right;
  Vec2 at = Vec2::Zero(), d = Vec2::UnitX();
  left.corner = 0.5 * legs[0].width * left_of(d);
  right.corner = -left.corner;
  left.line = {left.corner};
  right.line = {right.corner};
  for (std::size_t i = 0; i + 1 < legs.size(); ++i) {
    at += legs[i].length * d;
    const double turn = legs[i].turn;
    const Vec2 next = std::cos(turn) * d + std::sin(turn) * left_of(d);
    const Vec2 here = 0.5 * legs[i].width * left_of(d), there = 0.5 * legs[i + 1].width * left_of(next);
    const double outer = inner_radius > 0.0 ? inner_radius + std::min(legs[i].width, legs[i + 1].width) : 0.0;
    const double straight_left =
        turn_corner(meet(at + here, d, at + there, next), d, turn, turn > 0.0 ? inner_radius : outer, facet_size, left);
    const double straight_right = turn_corner(meet(at - here, d, at - there, next), d, turn,
                                              turn > 0.0 ? outer : inner_radius, facet_size, right);
    plan.straight.push_back(std::min(straight_left, straight_right));
    d = next;
  }
  plan.end = at + legs.back().length * d;
  for (Side* side : {&left, &right}) {
    const Vec2 last = plan.end + (side == &left ? 0.5 : -0.5) * legs.back().width * left_of(d);
    const double straight = (last - side->corner).dot(d) - side->used;
    if (side == &left)
      plan.straight.push_back(straight);
    else
      plan.straight.back() = std::min(plan.straight.back(), straight);
    append(last, side->line);
  }
  plan.left = left.line;
  plan.right = right.line;
  return plan;
}

std::vector<Vec2> Outline::polygon() const {
  std::vector<Vec2> corners = right;
  corners.insert(corners.end(), left.rbegin(), left.rend());
  return corners;
}

double Outline::area() const {
  const std::vector<Vec2> p = polygon();
  double sum = 0.0;
  for (std::size_t k = 0; k < p.size(); ++k) sum += cross(p[k] - p[0], p[(k + 1) % p.size()] - p[0]);
  return 0.5 * sum;
}

}  // namespace puffin::cases::generators
