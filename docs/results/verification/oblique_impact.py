"""Oblique elastic impact of a sphere on a rigid plane by Hertz and Mindlin, integrated: the reference of D05.

    python3 oblique_impact.py > ../../../cases/verify/d05/oblique_impact.csv

The equations are those of hertz.hpp and of Thornton, Cummins & Cleary, Powder Technol. 233, 30 (2013): normal force
F = 4/3 E* a d, a = sqrt(R d); the tangential force T grows by 8 G* a per slip, falls with a while the normal force falls,
and is at most mu F. Surface velocity s = u - w R, of effective mass 2/7 m. Steel as in test 5 of Chung & Ooi (2011).
Halving the step changes the fifth digit. Columns: tangential speed before, R w' after [m/s].
"""
import math

YOUNG, POISSON, DENSITY, RADIUS, FRICTION, NORMAL_SPEED = 208e9, 0.3, 7850.0, 1e-5, 0.3, 5.0
TANGENTIAL_SPEEDS = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0]  # [m/s], those of cases/verify/d05


def spin_after(tangential_speed, steps):
    """R w' [m/s] after an impact that lasts about `steps` steps."""
    mass = DENSITY * 4 / 3 * math.pi * RADIUS**3
    normal_modulus = YOUNG / (1 - POISSON**2)
    shear_modulus = YOUNG / (2 * (1 + POISSON) * (2 - POISSON))
    peak = (15 / 16 * mass * NORMAL_SPEED**2 / (normal_modulus * math.sqrt(RADIUS))) ** 0.4
    step = 2.943 * peak / NORMAL_SPEED / steps
    overlap, closing, surface, tangential, impulse, stiffness = 0.0, NORMAL_SPEED, tangential_speed, 0.0, 0.0, 0.0
    while True:
        overlap += 0.5 * step * closing
        if overlap <= 0.0:
            return -2.5 * impulse / mass
        a, before = math.sqrt(RADIUS * overlap), stiffness
        normal, stiffness = 4 / 3 * normal_modulus * a * overlap, 8 * shear_modulus * a
        if stiffness < before:
            tangential *= stiffness / before
        tangential += stiffness * surface * step
        tangential = max(-FRICTION * normal, min(FRICTION * normal, tangential))
        closing -= normal / mass * step
        surface -= tangential / (2 / 7 * mass) * step
        impulse += tangential * step
        overlap += 0.5 * step * closing


if __name__ == "__main__":
    print("# python3 docs/results/verification/oblique_impact.py")
    print("u,spin_speed")
    for speed in TANGENTIAL_SPEEDS:
        print(f"{speed},{spin_after(speed, 40000):.5f}")
