#include "coupling/transfer.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/stencil_loop.hpp"

namespace puffin::coupling {

void interpolate(const Stencils& stencils, const lbm::Moments& moments, std::size_t carriers, AirSamples& samples) {
  samples.velocity_lu.resize(carriers, Eigen::Vector3d::Zero());
  samples.density_excess_lu.resize(carriers, 0.0);
  for_each_stencil(stencils, [&](const Stencil& stencil) {
    double rho = 0.0, ux = 0.0, uy = 0.0, uz = 0.0;
    for (const StencilEntry& e : stencils.entries(stencil)) {
      const std::int32_t ahead = Stencils::slot_ahead(e);
      for (const auto* field : {&moments.density_excess, &moments.ux, &moments.uy, &moments.uz})
        __builtin_prefetch(field->data() + ahead);
      rho += e.weight * static_cast<double>(moments.density_excess[e.slot]);
      ux += e.weight * static_cast<double>(moments.ux[e.slot]);
      uy += e.weight * static_cast<double>(moments.uy[e.slot]);
      uz += e.weight * static_cast<double>(moments.uz[e.slot]);
    }
    samples.velocity_lu[stencil.carrier] = {ux, uy, uz};
    samples.density_excess_lu[stencil.carrier] = rho;
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
    for (const StencilEntry& e : stencils.entries(stencil)) {
      __builtin_prefetch(&momentum_[Stencils::slot_ahead(e)], 1);
      momentum_[e.slot] += e.weight * j;
    }
  });
  // Once more over the same cells: book each one when it is met first, and leave the sums zero for the next call.
  const double to_lu = 1.0 / (interval * scale.force());
  struct Part {
    Eigen::Vector3d taken = Eigen::Vector3d::Zero(), rounding_lu = Eigen::Vector3d::Zero();
  };
  std::vector<Part> parts(stencils.tiles().size() - 1);
  for_each_by_tile(stencils, [&](int tile, const Stencil& stencil) {
    for (const StencilEntry& e : stencils.entries(stencil)) {
      const std::int32_t ahead = Stencils::slot_ahead(e);
      __builtin_prefetch(&momentum_[ahead], 1);
      for (float* f : {force.x.data(), force.y.data(), force.z.data()}) __builtin_prefetch(f + ahead, 1);
      Eigen::Vector3d& cell = momentum_[e.slot];
      if (cell.x() == 0.0 && cell.y() == 0.0 && cell.z() == 0.0) continue;
      const Eigen::Vector3d f = cell * to_lu;
      force.x[e.slot] = static_cast<float>(f.x());
      force.y[e.slot] = static_cast<float>(f.y());
      force.z[e.slot] = static_cast<float>(f.z());
      parts[tile].taken += cell;
      parts[tile].rounding_lu += Eigen::Vector3d(force.x[e.slot], force.y[e.slot], force.z[e.slot]) - f;
      cell.setZero();
    }
  });
  for (const Part& part : parts) {
    books.taken += part.taken;
    books.rounding += part.rounding_lu / to_lu;
  }
  return books;
}

void Spreader::clear(const Stencils& stencils, lbm::BodyForce& force) {
  for_each_by_tile(stencils, [&](int, const Stencil& stencil) {
    for (const StencilEntry& e : stencils.entries(stencil)) force.x[e.slot] = force.y[e.slot] = force.z[e.slot] = 0.0f;
  });
}

double Spreader::smooth(const Stencils& stencils, std::span<const double> value, double ceiling,
                        std::span<double> result) {
  for_each_by_tile(stencils, [&](int, const Stencil& stencil) {
    const double v = value[stencil.carrier];
    for (const StencilEntry& e : stencils.entries(stencil)) scalar_[e.slot] += e.weight * v;
  });
  for_each_stencil(stencils, [&](const Stencil& stencil) {
    double sum = 0.0;
    for (const StencilEntry& e : stencils.entries(stencil)) sum += e.weight * std::min(scalar_[e.slot], ceiling);
    result[stencil.carrier] = sum;
  });
  std::vector<double> largest(stencils.tiles().size() - 1, 0.0);
  for_each_by_tile(stencils, [&](int tile, const Stencil& stencil) {
    for (const StencilEntry& e : stencils.entries(stencil)) {
      largest[tile] = std::max(largest[tile], scalar_[e.slot]);
      scalar_[e.slot] = 0.0;
    }
  });
  return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

void Spreader::collect(const Stencils& stencils, std::span<const double> value, std::vector<std::int32_t>& slots,
                       std::vector<double>& sums) {
  slots.clear(), sums.clear();
  for_each_by_tile(stencils, [&](int, const Stencil& stencil) {
    const double v = value[stencil.carrier];
    for (const StencilEntry& e : stencils.entries(stencil)) scalar_[e.slot] += e.weight * v;
  });
  for (const Stencil& stencil : stencils.stencils())
    for (const StencilEntry& e : stencils.entries(stencil)) {
      if (scalar_[e.slot] == 0.0) continue;
      slots.push_back(e.slot), sums.push_back(scalar_[e.slot]);
      scalar_[e.slot] = 0.0;
    }
}

}  // namespace puffin::coupling
