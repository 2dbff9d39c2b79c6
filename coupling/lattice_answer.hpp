#pragma once
// How much more weakly than the continuum the lattice answers a force on a few cells.

namespace puffin::coupling {

/// What the lattice's own answer to the coupling kernel is over that of the continuum, at rest (R = 0): the sum over
/// the lattice's wave numbers of |kernel|^2 u_z/F_z, over Psi(0) of (1) in self_disturbance.hpp. u_z: steady solution
/// of the linearised regularised step, f_i(x + c_i) = w_i [rho + 3 c_i (j + F) + 9/2 (1 - 1/tau) (c_i c_i - 1/3) : Pi],
/// Pi without its trace. in: kernel width in cells (1: Roma's on its own cells), relaxation time of the air. Linear in
/// the width and in log(tau - 1/2) between the points of a table, constant beyond. Good to 1 % (places of the kernel
/// between the cells).
double lattice_answer(double width_in_cells, double tau);

}  // namespace puffin::coupling
