#include "coupling/transfer.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "coupling/stencil_loop.hpp"

namespace puffin::coupling {

namespace {

constexpr std::size_t block_of_cells = 2048;
std::size_t blocks(std::size_t cells) { return (cells + block_of_cells - 1) / block_of_cells; }

/// Calls visit(block, slot) for each cell, in parallel blocks that do not depend on the number of threads.
template <class Visit>
void for_each_cell(std::span<const std::int32_t> slots, const Visit& visit) {
  tbb::parallel_for(std::size_t{0}, blocks(slots.size()), [&](std::size_t block) {
    const std::size_t end = std::min(slots.size(), (block + 1) * block_of_cells);
    for (std::size_t n = block * block_of_cells; n < end; ++n) visit(block, slots[n]);
  });
}

}  // namespace

void interpolate(const Stencils& stencils, const lbm::Moments& moments, std::size_t carriers, AirSamples& samples,
                 double wall_speed_lu) {
  samples.velocity_lu.resize(carriers, Eigen::Vector3d::Zero());
  samples.in_cells.resize(moments.ux.size());
  for_each_cell(stencils.cells(), [&](std::size_t, std::int32_t slot) {
    samples.in_cells[slot] = {moments.ux[slot], moments.uy[slot], moments.uz[slot], 0.0};
  });
  for_each_stencil(stencils, [&](const Stencil& stencil) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (const StencilEntry& e : stencils.entries(stencil)) sum += e.weight * samples.in_cells[e.slot];
    const auto shifts = stencils.shifts(static_cast<std::size_t>(&stencil - stencils.stencils().data()));
    if (!shifts.empty()) {
      Eigen::Vector4d shift = Eigen::Vector4d::Zero();
      for (const Shift& s : shifts) shift += s.weight * samples.in_cells[s.slot];
      const double far = shift.norm(), most = sum.norm() + wall_speed_lu;
      sum += far > most ? Eigen::Vector4d(most / far * shift) : shift;
    }
    samples.velocity_lu[stencil.carrier] = sum.head<3>();
  });
}

void interpolate_gradients(const Stencils& stencils, const lbm::Moments& moments, std::size_t carriers,
                           AirGradients& gradients) {
  gradients.velocity_lu.resize(carriers, Eigen::Matrix3d::Zero());
  gradients.density_excess_lu.resize(carriers, Eigen::Vector3d::Zero());
  for_each_stencil(stencils, [&](const Stencil& stencil) {
    using Fields = Eigen::Matrix<double, 4, 1>;  // ux, uy, uz, density excess
    const auto fields = [&](std::int32_t s) {
      return Fields(moments.ux[s], moments.uy[s], moments.uz[s], moments.density_excess[s]);
    };
    Eigen::Vector3d mean_x = Eigen::Vector3d::Zero();
    Fields mean_f = Fields::Zero();
    for (const StencilEntry& e : stencils.entries(stencil)) {
      mean_x += e.weight * Eigen::Vector3d(e.x, e.y, e.z);
      mean_f += e.weight * fields(e.slot);
    }
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 4, 3> mixed = Eigen::Matrix<double, 4, 3>::Zero();
    for (const StencilEntry& e : stencils.entries(stencil)) {
      const Eigen::Vector3d x = Eigen::Vector3d(e.x, e.y, e.z) - mean_x;
      second += e.weight * x * x.transpose();
      mixed += e.weight * (fields(e.slot) - mean_f) * x.transpose();
    }
    // A direction in which the cells do not differ has no variance and no gradient: a unit there makes the solve
    // regular.
    for (int d = 0; d < 3; ++d)
      if (second(d, d) < 1e-3) second(d, d) += 1.0;
    const Eigen::Matrix<double, 4, 3> gradient = second.ldlt().solve(mixed.transpose()).transpose();
    gradients.velocity_lu[stencil.carrier] = gradient.topRows<3>();
    gradients.density_excess_lu[stencil.carrier] = gradient.row(3).transpose();
  });
}

MomentumBooking Spreader::spread(const Stencils& stencils, std::span<const Eigen::Vector3d> impulse, double interval,
                                 const Scale& scale, lbm::BodyForce& force) {
  MomentumBooking books;
  for (const Stencil& stencil : stencils.stencils()) {
    if (stencil.count == 0) continue;
    books.given += impulse[stencil.carrier];
    books.exchanged += impulse[stencil.carrier].norm();
  }
  for_each_by_tile(stencils, [&](int, const Stencil& stencil) {
    const Eigen::Vector3d& j = impulse[stencil.carrier];
    const Eigen::Vector4d given(j.x(), j.y(), j.z(), 0.0);
    for (const StencilEntry& e : stencils.entries(stencil)) momentum_[e.slot] += e.weight * given;
  });
  const double to_lu = 1.0 / (interval * scale.force());
  struct Part {
    Eigen::Vector3d taken = Eigen::Vector3d::Zero(), rounding_lu = Eigen::Vector3d::Zero();
  };
  std::vector<Part> parts(blocks(stencils.cells().size()));
  for_each_cell(stencils.cells(), [&](std::size_t block, std::int32_t slot) {
    const Eigen::Vector3d cell = std::exchange(momentum_[slot], Eigen::Vector4d::Zero()).head<3>();
    const Eigen::Vector3d f = cell * to_lu;
    force.x[slot] = static_cast<float>(f.x());
    force.y[slot] = static_cast<float>(f.y());
    force.z[slot] = static_cast<float>(f.z());
    parts[block].taken += cell;
    parts[block].rounding_lu += Eigen::Vector3d(force.x[slot], force.y[slot], force.z[slot]) - f;
  });
  for (const Part& part : parts) {
    books.taken += part.taken;
    books.rounding += part.rounding_lu / to_lu;
  }
  return books;
}

void Spreader::clear(std::span<const std::int32_t> slots, lbm::BodyForce& force) {
  for (const std::int32_t slot : slots) force.x[slot] = force.y[slot] = force.z[slot] = 0.0F;
}

double Spreader::smooth(const Stencils& stencils, std::span<const double> value, double ceiling,
                        std::span<double> result) {
  add(stencils, value);
  std::vector<double> largest(blocks(stencils.cells().size()), 0.0);
  for_each_cell(stencils.cells(), [&](std::size_t block, std::int32_t slot) {
    largest[block] = std::max(largest[block], scalar_[slot]);
    scalar_[slot] = std::min(scalar_[slot], ceiling);
  });
  for_each_stencil(stencils, [&](const Stencil& stencil) {
    double sum = 0.0;
    for (const StencilEntry& e : stencils.entries(stencil)) sum += e.weight * scalar_[e.slot];
    result[stencil.carrier] = sum;
  });
  for (const std::int32_t slot : stencils.cells()) scalar_[slot] = 0.0;
  return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

void Spreader::add(const Stencils& stencils, std::span<const double> value) {
  for_each_by_tile(stencils, [&](int, const Stencil& stencil) {
    const double v = value[stencil.carrier];
    for (const StencilEntry& e : stencils.entries(stencil)) scalar_[e.slot] += e.weight * v;
  });
}

void Spreader::collect(const Stencils& stencils, std::span<const double> value, std::vector<std::int32_t>& slots,
                       std::vector<double>& sums) {
  add(stencils, value);
  slots.clear(), sums.clear();
  for (const std::int32_t slot : stencils.cells()) {
    const double sum = std::exchange(scalar_[slot], 0.0);
    if (sum != 0.0) slots.push_back(slot), sums.push_back(sum);
  }
}

}  // namespace puffin::coupling
