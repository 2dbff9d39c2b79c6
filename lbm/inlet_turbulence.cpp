#include "lbm/inlet_turbulence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace puffin::lbm {

using geometry::Vec3;

namespace {

constexpr int triples = 32;

/// Wave numbers [1/cell] that divide the energy below four cells a wave into equal parts.
std::vector<double> wave_numbers(double length, int count) {
  const double k_e = 0.747 / length, longest = 0.5 * std::numbers::pi, shortest = std::min(0.05 * k_e, 0.1 * longest);
  constexpr int points = 4000;
  std::vector<double> k(points), energy(points, 0.0);
  for (int n = 0; n < points; ++n) k[n] = shortest * std::pow(longest / shortest, n / (points - 1.0));
  const auto density = [&](double q) { return std::pow(q, 4) / std::pow(k_e * k_e + q * q, 17.0 / 6.0); };
  for (int n = 1; n < points; ++n)
    energy[n] = energy[n - 1] + 0.5 * (density(k[n]) + density(k[n - 1])) * (k[n] - k[n - 1]);
  std::vector<double> chosen;
  for (int m = 0; m < count; ++m) {
    const double wanted = (m + 0.5) / count * energy.back();
    chosen.push_back(k[std::lower_bound(energy.begin(), energy.end(), wanted) - energy.begin()]);
  }
  return chosen;
}

/// Numbers in [0, 1) that every standard library draws alike.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

/// Three orthogonal unit vectors, uniform over all orientations.
std::array<Vec3, 3> random_frame(Uniform& random) {
  const auto point = [&] {
    const double z = 2.0 * random() - 1.0, a = 2.0 * std::numbers::pi * random(), r = std::sqrt(1.0 - z * z);
    return Vec3(r * std::cos(a), r * std::sin(a), z);
  };
  const Vec3 first = point();
  Vec3 second = first.cross(point());
  while (second.norm() < 1e-3) second = first.cross(point());
  second.normalize();
  return {first, second, first.cross(second)};
}

}  // namespace

InletTurbulence make_inlet_turbulence(const Air& air, int boundary, double intensity, double length, std::uint64_t seed,
                                      int part) {
  if (!(intensity >= 0.0) || !(length > 0.0))
    throw std::invalid_argument("inlet turbulence needs an intensity >= 0 and a length > 0");
  InletTurbulence t;
  t.boundary = boundary;
  for (std::size_t k = 0; k < air.links.inlets.size(); ++k)
    if (air.links.inlets[k].patch == boundary && air.links.inlets[k].part == part)
      t.links.push_back(static_cast<std::int32_t>(k));
  constexpr int modes = 3 * triples;
  t.cosine.assign(t.links.size() * modes, 0.0F);
  t.sine.assign(t.links.size() * modes, 0.0F);
  Uniform random(seed);
  const auto numbers = wave_numbers(length, triples);
  const Vec3 flow = t.links.empty() ? Vec3(-air.normal[boundary]) : Vec3(-air.outward(air.links.inlets[t.links[0]]));
  double base = 0.0;
  for (const auto k : t.links) base += air.links.inlets[k].gain;
  std::array<Vec3, 3> frame;
  for (int n = 0; n < modes; ++n) {
    if (n % 3 == 0) frame = random_frame(random);
    const Vec3 wave = numbers[n / 3] * frame[n % 3], sigma = frame[(n + 1) % 3];
    t.along.push_back(wave.dot(flow));
    t.phase.push_back(2.0 * std::numbers::pi * random());
    const double amplitude = intensity * std::sqrt(6.0 / modes);
    std::array<double, 2> net{0.0, 0.0};
    std::vector<std::array<double, 2>> pushes(t.links.size());
    for (std::size_t l = 0; l < t.links.size(); ++l) {
      const OpeningLink& link = air.links.inlets[t.links[l]];
      const auto& c = d3q19::velocity[link.direction];
      const double push = -6.0 * d3q19::weight[link.direction] * amplitude * sigma.dot(Vec3(c[0], c[1], c[2]));
      const double angle = wave.dot(air.rows.centre(link.slot) - air.rows.origin()) / air.rows.dx();
      pushes[l] = {push * std::cos(angle), push * std::sin(angle)};
      for (int h = 0; h < 2; ++h) net[h] += pushes[l][h];
    }
    for (std::size_t l = 0; l < t.links.size(); ++l) {
      const double share = air.links.inlets[t.links[l]].gain / base;
      t.cosine[l * modes + n] = static_cast<float>(pushes[l][0] - share * net[0]);
      t.sine[l * modes + n] = static_cast<float>(pushes[l][1] - share * net[1]);
    }
  }
  return t;
}

void add_fluctuation(const InletTurbulence& t, double way, double speed, std::vector<float>& gain) {
  const std::size_t modes = t.along.size();
  std::vector<float> c(modes), s(modes);
  for (std::size_t n = 0; n < modes; ++n) {
    // cos(k.x - k.e way + phi) = cos(k.x) cos(a) + sin(k.x) sin(a), a = k.e way - phi
    const double a = t.along[n] * way - t.phase[n];
    c[n] = static_cast<float>(speed * std::cos(a));
    s[n] = static_cast<float>(speed * std::sin(a));
  }
  for (std::size_t l = 0; l < t.links.size(); ++l) {
    float sum = 0.0F;
    const float *cosine = t.cosine.data() + l * modes, *sine = t.sine.data() + l * modes;
    for (std::size_t n = 0; n < modes; ++n) sum += cosine[n] * c[n] + sine[n] * s[n];
    gain[t.links[l]] += sum;
  }
}

}  // namespace puffin::lbm
