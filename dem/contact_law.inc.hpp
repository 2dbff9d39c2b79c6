// The law of a live contact over a number type R: a double, or a pack of lanes. Included within a namespace that offers
// select(mask, yes, no), any(mask), maximum, minimum and root for R, so that each instruction set has a text of its
// own. The states of a contact and their reasons: contact_step.cpp.

/// One contact, as loaded from a lane of Springs.
template <class R>
struct Spring {
  R phase, inverse_mass, knee, pull_off, pull_stiffness, well, eta_pull, pull_step, stiffness, eta, push_step,
      slip_stiffness, eta_slip, knee_stiffness, slip[3], spring, dashpot, max_force, max_overlap;
};

/// Where and how fast the two surfaces meet.
template <class R>
struct Encounter {
  R normal[3];         // towards a
  R overlap, closing;  // [m], [m/s]
  R half[3], end[3];   // velocity of a's surface against b's, of the half step and predicted for its end [m/s]
};

/// The normal force before its dashpot.
template <class R>
struct Normal {
  R spring, tangent, eta;  // [N], [N/m], [kg/s]
  R lean;                  // what adhesion adds to the force that friction leans on [N]
  R least;                 // of spring and dashpot together (Hertz) [N]
  R step;                  // sub-step that the present stiffness allows [s]
};

/// What a contact does in this sub-step.
template <class R>
struct Answer {
  R force[3], tangential[3], moment[3];  // on a [N]; normal x tangential [N]
  R pressing, limit;                     // what friction leans on, its limit [N]
};

template <class R>
[[gnu::always_inline]] inline R dot(const R (&a)[3], const R (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class R>
[[gnu::always_inline]] inline void take_off_normal(const R (&n)[3], R (&v)[3]) {
  const R along = dot(n, v);
  for (int d = 0; d < 3; ++d) v[d] = v[d] - n[d] * along;
}

template <class R>
[[gnu::always_inline]] inline void cross(const R (&a)[3], const R (&b)[3], R (&c)[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/// mu at the sliding speed (SpeedFriction in models.hpp).
template <class R>
[[gnu::always_inline]] inline R friction_coefficient(const SpringLaw& law, const R (&velocity)[3]) {
  if (law.slip_speed == 0.0) return R(law.stick);
  const R speed = root(dot(velocity, velocity)), part = speed / R(law.slip_speed);
  const R sticking = R(law.stick) + R(law.stick - law.slip) * (part - R(2.0)) * part;
  const R slipping =
      R(law.slip) + R((law.limit - law.slip) / (law.limit_speed - law.slip_speed)) * (speed - R(law.slip_speed));
  return select(speed < R(law.slip_speed), sticking, select(speed < R(law.limit_speed), slipping, R(law.limit)));
}

/// An impact that turns is leaving; what turns back before it separates is bonded, or without adhesion an impact again.
template <class R>
[[gnu::always_inline]] inline void turn_phase(const R& overlap, const R& closing, Spring<R>& c) {
  const R zero(0.0);
  c.phase = select(c.phase == R(lane::impact) && closing < zero, R(lane::leaving), c.phase);
  const R again = select(c.pull_off > zero, R(lane::bonded), R(lane::impact));
  c.phase = select(c.phase == R(lane::leaving) && closing > zero && overlap > zero, again, c.phase);
}

/// Linear spring with its knee, or the breaking spring of a bond.
template <class R>
[[gnu::always_inline]] inline Normal<R> linear_normal(const SpringLaw& law, const R& overlap, const R& closing,
                                                      Spring<R>& c) {
  const R zero(0.0);
  const auto bonded = c.phase == R(lane::bonded);
  const auto outside = overlap <= zero;
  const auto tension = bonded && outside;
  Normal<R> n;
  n.spring = select(outside, select(bonded, c.pull_stiffness * overlap, zero), c.stiffness * overlap);
  n.tangent = select(tension, c.pull_stiffness, c.stiffness);
  n.eta = select(tension, c.eta_pull, c.eta);
  n.step = select(tension, c.pull_step, c.push_step);
  n.lean = select(bonded, c.pull_off, zero);
  n.least = zero;
  const auto over = overlap > c.knee;
  c.knee_stiffness = select(over || outside, c.knee_stiffness, zero);
  if (any(over)) {
    constexpr double capacity = 8.0;  // K = 8 m* (v/D)^2 takes the energy m* v^2/2 within s = 1/2 (0.068 K D^2)
    const R v = maximum(zero, closing) / c.knee;
    const R fresh = maximum(c.stiffness, R(capacity) * v * v / c.inverse_mass);
    c.knee_stiffness = select(over && c.knee_stiffness == zero, fresh, c.knee_stiffness);
    const R s = minimum(R(0.99), (overlap - c.knee) / c.knee), rest = R(1.0) - s;
    n.spring = select(over, n.spring + c.knee_stiffness * c.knee * s * s / rest, n.spring);
    n.tangent = select(over, n.tangent + c.knee_stiffness * (R(2.0) - s) * s / (rest * rest), n.tangent);
    // Of a spring K x^p the dashpot 2 zeta (m (p + 1)/2 K x^(p-1))^(1/2) returns the same restitution: tangent and
    // secant in equal parts, as Tsuji's of Hertz (5/6 of the tangent).
    n.eta = select(over, R(2.0 * law.zeta) * root(R(0.5) * (n.tangent + n.spring / overlap) / c.inverse_mass), n.eta);
    n.step = select(over, R(law.step_factor) / root(n.tangent * c.inverse_mass), n.step);
  }
  return n;
}

/// Tangential spring with dashpot (Cundall & Strack 1979) up to the friction limit mu * pressing (thesis eq. 2.4).
/// Moves the spring by `share` [s] of the half-step velocities and shortens it at the limit, so it never gives back
/// more than it took.
template <class R>
[[gnu::always_inline]] inline void slide(const SpringLaw& law, const R& share, Encounter<R>& e, Spring<R>& c,
                                         Answer<R>& answer) {
  take_off_normal(e.normal, e.half);
  take_off_normal(e.normal, e.end);
  take_off_normal(e.normal, c.slip);
  for (int d = 0; d < 3; ++d) c.slip[d] = c.slip[d] + share * e.half[d];
  R(&force)[3] = answer.tangential;
  for (int d = 0; d < 3; ++d) force[d] = R(0.0) - c.slip_stiffness * c.slip[d] - c.eta_slip * e.end[d];
  answer.limit = friction_coefficient(law, e.end) * answer.pressing;
  const R size2 = dot(force, force), limit2 = answer.limit * answer.limit;
  const auto slides = size2 > limit2;
  if (any(slides)) {
    const R part = select(slides, answer.limit / root(size2), R(1.0));
    for (int d = 0; d < 3; ++d) force[d] = force[d] * part;
  }
  const R stretch2 = c.slip_stiffness * c.slip_stiffness * dot(c.slip, c.slip);
  const auto beyond = stretch2 > limit2;
  if (any(beyond)) {
    const R part = select(beyond, answer.limit / root(stretch2), R(1.0));
    for (int d = 0; d < 3; ++d) c.slip[d] = c.slip[d] * part;
  }
}

/// Keeps the largest force and overlap. Near the turning point the overlap still to come, m* v^2/(2 F) from here (and
/// where it comes from, past the point), is known to second order; the dashpot is silent there.
template <class R>
[[gnu::always_inline]] inline void note_extremes(const R& overlap, const R& closing, const R& spring, const R& tangent,
                                                 const R& normal_force, Spring<R>& c) {
  c.max_force = maximum(c.max_force, normal_force);
  c.max_overlap = maximum(c.max_overlap, overlap);
  const R twice = closing * closing, lever = spring * c.inverse_mass;
  const auto turns = spring > R(0.0) && overlap > R(0.0) && twice <= R(0.04) * overlap * lever;
  if (!any(turns)) return;
  const R way = R(0.5) * twice / lever;
  c.max_overlap = select(turns, maximum(c.max_overlap, overlap + way), c.max_overlap);
  c.max_force = select(turns, maximum(c.max_force, spring + tangent * way), c.max_force);
}

/// Forces of a live contact over the sub-step h [s], of which it has lived `share` [s]. The dashpot acts on the speed
/// at the end of the sub-step. The predicted one carries the old force of this contact; to put its new force there
/// instead, dashpot included, is second order with a small constant (e right within 0.1 %). Friction is held by what
/// presses the surfaces together. The linear dashpot's integral over a contact is zero; that of a Hertz contact, which
/// never pulls, is not.
template <class R>
[[gnu::always_inline]] inline Answer<R> contact_force(const SpringLaw& law, const R& h, const R& share,
                                                      const Normal<R>& n, Encounter<R>& e, Spring<R>& c) {
  Answer<R> answer;
  const R response = R(0.5) * h * c.inverse_mass;
  R dashpot = n.eta * (e.closing + response * (c.spring + c.dashpot - n.spring)) / (R(1.0) + response * n.eta);
  if (law.hertz) dashpot = maximum(n.least - n.spring, dashpot);
  answer.pressing = maximum(R(0.0), (law.hertz ? n.spring + dashpot : n.spring) + n.lean);
  slide(law, share, e, c, answer);
  const R normal_force = n.spring + dashpot;
  for (int d = 0; d < 3; ++d) answer.force[d] = e.normal[d] * normal_force + answer.tangential[d];
  cross(e.normal, answer.tangential, answer.moment);
  c.spring = n.spring, c.dashpot = dashpot;
  note_extremes(e.overlap, e.closing, n.spring, n.tangent, normal_force, c);
  return answer;
}

/// Leaving: ends the sub-step where the overlap is gone, if that is not much less than a sub-step away.
/// in: `left` [m] to the end of the contact.
template <class R>
[[gnu::always_inline]] inline R stop_at_separation(const R& left, const R& closing, const Spring<R>& c, const R& step) {
  const R zero(0.0), speed = zero - closing;
  const R push = (c.spring + c.dashpot) * c.inverse_mass;  // towards separation [m/s^2]
  const auto reaches = speed > zero && left > zero && left < (speed + R(0.5) * maximum(zero, push) * step) * step;
  if (!any(reaches)) return step;
  const R under = speed * speed + R(2.0) * push * left;
  const R fall = R(2.0) * left / (root(maximum(zero, under)) + speed);
  return select(reaches && under >= zero && fall < step, maximum(fall, R(0.25) * step), step);
}

/// Near separation, slow enough to bond: the stiffer spring of tension is about to take over, with sub-steps
/// `pull_step`.
template <class R>
[[gnu::always_inline]] inline R mind_the_bond(const R& overlap, const R& closing, const R& pull_step,
                                              const Spring<R>& c, const R& step) {
  const R zero(0.0), speed2 = closing * closing;
  const auto slow = c.phase == R(lane::bonded) || speed2 < R(8.0) * c.well * c.inverse_mass;
  const auto soon = c.well > zero && overlap > zero && slow && pull_step < step;
  if (!any(soon)) return step;
  const R fall = overlap / maximum(R(1e-300), zero - closing);
  const R leaving = minimum(step, maximum(pull_step, R(0.5) * fall));
  const R arriving = select(overlap < R(2.0) * step * closing || closing == zero, pull_step, step);
  return select(soon, select(closing < zero, leaving, arriving), step);
}

/// A bond that keeps less than half of its well, in motion and in its springs, cannot break by itself: while no more
/// than half of its strength is in use it needs only stability, t_c/8. The factor on its sub-step; for a contact that
/// may bond: on that of its bond.
template <class R>
[[gnu::always_inline]] inline R quiet_factor(const SpringLaw& law, const R& overlap, const R& closing, const R& spring,
                                             const Spring<R>& c) {
  const R energy = closing * closing + spring * overlap * c.inverse_mass;  // twice, of unit mass
  const auto quiet =
      energy < c.well * c.inverse_mass && overlap < R(0.5) * c.knee && R(0.0) - spring < R(0.5) * c.pull_off;
  return select(quiet, R(law.quiet_factor), R(1.0));
}

/// The largest next sub-step [s] that a live linear contact allows.
template <class R>
[[gnu::always_inline]] inline R next_step(const SpringLaw& law, const Normal<R>& n, const Encounter<R>& e,
                                          const Spring<R>& c) {
  const R zero(0.0);
  const R coarse = quiet_factor(law, e.overlap, e.closing, n.spring, c);
  R step = select(c.phase == R(lane::bonded), coarse, R(1.0)) * n.step;
  const auto over = e.overlap > c.knee;
  const auto reaches = e.closing > zero && (over || e.closing * step > c.knee - e.overlap);
  if (any(reaches)) {
    const R deep = R(0.1) * maximum(R(2.0) * c.knee - e.overlap, R(0.01) * c.knee) / e.closing;
    const R near = (R(1.05) * c.knee - e.overlap) / e.closing;
    step = select(reaches, minimum(step, select(over, deep, near)), step);
  }
  step = select(c.phase == R(lane::bonded), step, stop_at_separation(e.overlap, e.closing, c, step));
  return mind_the_bond(e.overlap, e.closing, coarse * minimum(n.step, c.pull_step), c, step);
}
