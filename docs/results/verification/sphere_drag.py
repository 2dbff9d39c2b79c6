"""Drag of a sphere in an endless steady stream, by stream function and vorticity: the reference of V15.

    python3 sphere_drag.py LOG_OF_OUTER_RADIUS CELLS [CELLS ...]      # needs numpy and scipy

Radius, speed and density 1, viscosity 2/Re; r = exp(x), theta from the downstream axis. With psi the stream function and
W = (vorticity) r sin(theta) = -E^2 psi,

    L psi + r^2 W = 0,   [psi_theta (W_x - 2 W) - psi_x (W_theta - 2 cot(theta) W)] / (r sin(theta)) = (2/Re) L W,
    L = d^2/dx^2 - d/dx + sin(theta) d/dtheta (1/sin(theta) d/dtheta),

central differences of second order on CELLS x CELLS/2 cells, Newton's method on both at once. At the sphere psi = psi_x = 0, so
W = -2 psi_1/h^2 there (Thom); at the outer radius the undisturbed psi, W = 0 upstream and W_x = 0 downstream. From the
traction at the surface, Cd = 4/Re int (omega_x - omega) sin^2(theta) dtheta, 24/Re for Stokes's flow. Two grids are
extrapolated as of second order.
"""
import math
import sys

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as linear

REYNOLDS = [1.0, 10.0, 50.0, 100.0]


class Sphere:
    def __init__(self, cells, log_outer):
        n, m = cells, cells // 2
        self.h, self.k, self.rows, self.columns = log_outer / n, math.pi / m, n - 1, m - 1
        i, j = np.meshgrid(np.arange(1, n), np.arange(1, m), indexing="ij")
        theta, h, k = self.k * j, self.h, self.k
        r, sine = np.exp(h * i), np.sin(theta)

        def stencil(terms):
            at = (i - 1) * (m - 1) + j - 1
            row, column, value = [], [], []
            for di, dj, weight in terms:
                inside = (i + di >= 1) & (i + di < n) & (j + dj >= 1) & (j + dj < m)
                row.append(at[inside])
                column.append((at + di * (m - 1) + dj)[inside])
                value.append(np.broadcast_to(weight, i.shape)[inside])
            size = (n - 1) * (m - 1)
            return sp.csr_matrix((np.concatenate(value), (np.concatenate(row), np.concatenate(column))), shape=(size, size))

        diagonal = lambda a: sp.diags(np.asarray(a, float).ravel())
        up, down = sine / np.sin(theta + k / 2) / k**2, sine / np.sin(theta - k / 2) / k**2
        outward, inward = 1 / h**2 - 0.5 / h, 1 / h**2 + 0.5 / h
        self.laplace = stencil([(1, 0, outward), (-1, 0, inward), (0, 1, up), (0, -1, down), (0, 0, -2 / h**2 - up - down)])
        self.d_x = stencil([(1, 0, 0.5 / h), (-1, 0, -0.5 / h)])
        self.d_theta = stencil([(0, 1, 0.5 / k), (0, -1, -0.5 / k)])
        # What the edges add: psi beyond the outer radius, W on the sphere (from psi), W beyond the outer radius downstream.
        edge, wall = i == n - 1, i == 1
        psi_outer = 0.5 * math.exp(2 * log_outer) * sine**2
        self.laplace_psi, self.d_x_psi = np.where(edge, outward * psi_outer, 0).ravel(), np.where(edge, 0.5 / h * psi_outer, 0).ravel()
        self.laplace_wall = diagonal(np.where(wall, inward * -2 / h**2, 0))
        self.d_x_wall = diagonal(np.where(wall, -0.5 / h * -2 / h**2, 0))
        leaving = edge & (theta < math.pi / 2)
        self.laplace_w = self.laplace + diagonal(np.where(leaving, outward, 0))
        self.d_x_w = self.d_x + diagonal(np.where(leaving, 0.5 / h, 0))
        self.r_squared, self.r_sine, self.cot = (r**2).ravel(), (r * sine).ravel(), (np.cos(theta) / sine).ravel()
        self.sine = sine[0]
        self.psi = (0.5 * (r**2 - 1.5 * r + 0.5 / r) * sine**2).ravel()  # Stokes's flow to begin with
        self.w = -(self.laplace @ self.psi + self.laplace_psi) / self.r_squared

    def solve(self, reynolds):
        nu, one, size = 2 / reynolds, sp.identity(self.psi.size), self.psi.size
        for _ in range(20):
            psi, w = self.psi, self.w
            psi_x, psi_theta = self.d_x @ psi + self.d_x_psi, self.d_theta @ psi
            w_x, w_theta = self.d_x_w @ w + self.d_x_wall @ psi - 2 * w, self.d_theta @ w - 2 * self.cot * w
            poisson = self.laplace @ psi + self.laplace_psi + self.r_squared * w
            transport = (psi_theta * w_x - psi_x * w_theta) / self.r_sine - nu * (self.laplace_w @ w + self.laplace_wall @ psi)
            by_psi = (sp.diags(w_x / self.r_sine) @ self.d_theta - sp.diags(w_theta / self.r_sine) @ self.d_x
                      + sp.diags(psi_theta / self.r_sine) @ self.d_x_wall - nu * self.laplace_wall)
            by_w = (sp.diags(psi_theta / self.r_sine) @ (self.d_x_w - 2 * one)
                    - sp.diags(psi_x / self.r_sine) @ (self.d_theta - 2 * sp.diags(self.cot)) - nu * self.laplace_w)
            jacobian = sp.bmat([[self.laplace, sp.diags(self.r_squared)], [by_psi, by_w]]).tocsc()
            change = linear.splu(jacobian).solve(np.concatenate([poisson, transport]))
            self.psi, self.w = psi - change[:size], w - change[size:]
            if np.abs(change).max() < 1e-9:
                return self.drag(reynolds)
        raise RuntimeError("Newton's method did not converge")

    def drag(self, reynolds):
        w = self.w.reshape(self.rows, self.columns)
        at_wall = -2 * self.psi.reshape(self.rows, self.columns)[0] / self.h**2
        slope = (-3 * at_wall + 4 * w[0] - w[1]) / (2 * self.h)
        omega, omega_x = at_wall / self.sine, (slope - at_wall) / self.sine
        return 4 / reynolds * np.sum((omega_x - omega) * self.sine**2) * self.k


before = None
print("cells,log_outer_radius," + ",".join(f"Cd_re{r:g}" for r in REYNOLDS))
for cells in map(int, sys.argv[2:]):
    sphere = Sphere(cells, float(sys.argv[1]))
    drag = [sphere.solve(reynolds) for reynolds in REYNOLDS]
    print(f"{cells},{sys.argv[1]}," + ",".join(f"{d:.5f}" for d in drag), flush=True)
    if before:
        square = (cells / before[0]) ** 2
        print("extrapolated,," + ",".join(f"{(square * d - b) / (square - 1):.5f}" for d, b in zip(drag, before[1])))
    before = cells, drag
