// Eight live linear contacts between carriers at once, for one instruction set: PUFFIN_ISA names the namespace, the
// flags are set in dem/CMakeLists.txt. No function of others is called here but roots: what the linker shares must not
// be compiled for one processor. Products and sums are never fused, so every instruction set gives the same bits.

#include <cstdint>
#include <experimental/simd>

#include "dem/contact_pack.hpp"

namespace puffin::dem::PUFFIN_ISA {
namespace {

namespace stdx = std::experimental;
using Pack = stdx::native_simd<double>;
using Mask = Pack::mask_type;
constexpr int width = static_cast<int>(Pack::size());
static_assert(Springs::lanes % width == 0);

[[gnu::always_inline]] inline Pack select(const Mask& mask, const Pack& yes, const Pack& no) {
  Pack chosen = no;
  stdx::where(mask, chosen) = yes;
  return chosen;
}
[[gnu::always_inline]] inline bool any(const Mask& mask) { return stdx::any_of(mask); }
[[gnu::always_inline]] inline Pack maximum(const Pack& a, const Pack& b) { return select(a < b, b, a); }
[[gnu::always_inline]] inline Pack minimum(const Pack& a, const Pack& b) { return select(b < a, b, a); }
[[gnu::always_inline]] inline Pack root(const Pack& a) { return stdx::sqrt(a); }

#include "dem/contact_law.inc.hpp"

[[gnu::always_inline]] inline Pack load(const double* from) { return Pack(from, stdx::vector_aligned); }
/// (Without AVX a masked store would go past the caches.)
[[gnu::always_inline]] inline void store(const Mask& mask, const Pack& value, double* to) {
  select(mask, value, load(to)).copy_to(to, stdx::vector_aligned);
}

/// The bodies at both ends of the lanes' contacts.
struct Ends {
  const Body* a[width];
  const Body* b[width];
  /// Member of every lane's body, less that of its partner.
  template <class Member>
  [[gnu::always_inline]] Pack apart(Member member) const {
    return Pack([&](auto l) { return member(*a[l]); }) - Pack([&](auto l) { return member(*b[l]); });
  }
  template <class Member>
  [[gnu::always_inline]] Pack of_a(Member member) const {
    return Pack([&](auto l) { return member(*a[l]); });
  }
  template <class Member>
  [[gnu::always_inline]] Pack of_b(Member member) const {
    return Pack([&](auto l) { return member(*b[l]); });
  }
};

/// Turning of both surfaces: v - turn x n is the velocity of a's surface against b's.
[[gnu::always_inline]] inline void add_turning(const Pack (&turn)[3], const Pack (&normal)[3], Pack (&velocity)[3]) {
  Pack moved[3];
  cross(turn, normal, moved);
  for (int d = 0; d < 3; ++d) velocity[d] = velocity[d] - moved[d];
}

/// `width` lanes of a block from `first` on. Returns the smallest sub-step that they allow; sets bits of lanes whose
/// contact begins, ends or bonds, which are left as they are.
template <bool rotation>
inline double some_contacts(const SpringLaw& law, double h, const Body* bodies, const PairConstants* pairs, int first,
                            Springs& s, Pull* pulls, std::uint32_t& events) {
  const Pack zero(0.0);
  Ends ends;
  for (int l = 0; l < width; ++l) {
    ends.a[l] = bodies + s.a[first + l];
    ends.b[l] = bodies + (s.b[first + l] < 0 ? s.a[first + l] : s.b[first + l]);
  }
  Spring<Pack> c;
  c.phase = load(s.phase + first);
  const Mask live = c.phase > Pack(lane::free) && Pack([&](auto l) { return s.b[first + l] < 0 ? 0.0 : 1.0; }) > zero;
  if (!any(live)) return 1e300;

  Encounter<Pack> e;
  Pack apart[3];
  for (int d = 0; d < 3; ++d) apart[d] = ends.apart([d](const Body& body) { return body.x[d]; });
  const Pack distance2 = dot(apart, apart), distance = root(distance2);
  for (int d = 0; d < 3; ++d) e.normal[d] = apart[d] / distance;
  const auto of_pair = [&](auto member) {
    if (s.one_pair) return Pack(member(pairs[s.pair[0]]));
    return Pack([&](auto l) { return member(pairs[s.pair[first + l]]); });
  };
  e.overlap = of_pair([](const PairConstants& p) { return p.reach; }) - distance - load(s.offset + first);
  for (int d = 0; d < 3; ++d) {
    e.half[d] = ends.apart([d](const Body& body) { return body.v[d]; });
    e.end[d] = e.half[d] + ends.apart([d](const Body& body) { return body.kick[d]; });
  }
  e.closing = zero - dot(e.normal, e.end);

  c.inverse_mass = of_pair([](const PairConstants& p) { return p.inverse_mass; });
  c.knee = of_pair([](const PairConstants& p) { return p.knee; });
  c.pull_off = of_pair([](const PairConstants& p) { return p.pull_off; });
  c.pull_stiffness = of_pair([](const PairConstants& p) { return p.pull_stiffness; });
  c.well = of_pair([](const PairConstants& p) { return p.well; });
  c.eta_pull = of_pair([](const PairConstants& p) { return p.eta_pull; });
  c.pull_step = of_pair([](const PairConstants& p) { return p.pull_step; });
  c.stiffness = load(s.stiffness + first), c.eta = load(s.eta + first), c.push_step = load(s.push_step + first);
  c.knee_stiffness = load(s.knee_stiffness + first);
  turn_phase(e.overlap, e.closing, c);
  const Normal<Pack> n = linear_normal(law, e.overlap, e.closing, c);
  const Mask bonded = c.phase == Pack(lane::bonded);
  const Mask parts = !bonded && e.overlap <= zero && e.closing < zero;
  const Mask breaks = bonded && e.overlap <= zero && zero - n.spring >= c.pull_off;
  const Mask event = live && (parts || breaks || !(distance2 > zero));
  const Mask goes_on = live && !event;
  if (any(event))
    for (int l = 0; l < width; ++l) events |= (event[l] ? 1u : 0u) << (first + l);

  if constexpr (rotation) {
    const Pack arm_a = of_pair([](const PairConstants&p) { return p.share; }) * distance, arm_b = distance - arm_a;
    Pack half[3], end[3];
    for (int d = 0; d < 3; ++d) {
      const Pack w_a = ends.of_a([d](const Body& body) { return body.w[d]; });
      const Pack w_b = ends.of_b([d](const Body& body) { return body.w[d]; });
      const Pack twist_a = ends.of_a([d](const Body& body) { return body.twist[d]; });
      const Pack twist_b = ends.of_b([d](const Body& body) { return body.twist[d]; });
      half[d] = arm_a * w_a + arm_b * w_b;
      end[d] = half[d] + (arm_a * twist_a + arm_b * twist_b);
    }
    add_turning(half, e.normal, e.half);
    add_turning(end, e.normal, e.end);
  }
  c.slip_stiffness = load(s.slip_stiffness + first), c.eta_slip = load(s.eta_slip + first);
  for (int d = 0; d < 3; ++d) c.slip[d] = load(s.slip[d] + first);
  c.spring = load(s.spring + first), c.dashpot = load(s.dashpot + first);
  c.max_force = load(s.max_force + first), c.max_overlap = load(s.max_overlap + first);
  const Answer<Pack> answer = contact_force(law, Pack(h), Pack(h), n, e, c);

  store(goes_on, c.phase, s.phase + first);
  store(goes_on, c.knee_stiffness, s.knee_stiffness + first);
  store(goes_on, c.spring, s.spring + first);
  store(goes_on, c.dashpot, s.dashpot + first);
  store(goes_on, answer.limit, s.limit + first);
  store(goes_on, c.max_force, s.max_force + first);
  store(goes_on, c.max_overlap, s.max_overlap + first);
  alignas(64) double pull[6][width];
  for (int d = 0; d < 3; ++d) {
    store(goes_on, c.slip[d], s.slip[d] + first);
    answer.force[d].copy_to(pull[d], stdx::vector_aligned);
    if constexpr (rotation) (distance * answer.moment[d]).copy_to(pull[3 + d], stdx::vector_aligned);
  }
  for (int l = 0; l < width; ++l) {
    if (!goes_on[l]) continue;
    for (int d = 0; d < 3; ++d) pulls[first + l].force[d] = pull[d][l];
    if constexpr (rotation)
      for (int d = 0; d < 3; ++d) pulls[first + l].moment[d] = pull[3 + d][l];
  }
  return stdx::hmin(select(goes_on, next_step(law, n, e, c), Pack(1e300)));
}

double contacts(const SpringLaw& law, double h, const Body* bodies, const PairConstants* pairs, Springs& block,
                Pull* pulls, std::uint32_t& events) {
  double step = 1e300;
  for (int first = 0; first < Springs::lanes; first += width) {
    const double allowed = law.rotation ? some_contacts<true>(law, h, bodies, pairs, first, block, pulls, events)
                                        : some_contacts<false>(law, h, bodies, pairs, first, block, pulls, events);
    step = allowed < step ? allowed : step;
  }
  return step;
}

}  // namespace

PairContacts* pair_contacts() { return &contacts; }

}  // namespace puffin::dem::PUFFIN_ISA
