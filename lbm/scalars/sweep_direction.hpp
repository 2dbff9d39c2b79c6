#pragma once
// One sweep of all moving scalars along one direction, over all computed runs.

#include <vector>

#include "lbm/scalars/update.hpp"

namespace puffin::lbm {

/// Moves `steps` air steps along direction d (sweep.hpp), with what walls take and openings and held values bring.
/// exchange: [scalar] steps * Gamma, 0 where it diffuses elsewhere. drifts: FaceFluxes::drift takes part. After the
/// `last` sweep of an update the concentrations are those before it. Real: float or double.
template <class Real>
void sweep(const Update<Real>& u, const RunSweep<Real>& kernel, int d, double steps,
           const std::vector<double>& exchange, bool drifts, bool last);

extern template void sweep<float>(const Update<float>&, const RunSweep<float>&, int, double, const std::vector<double>&,
                                  bool, bool);
extern template void sweep<double>(const Update<double>&, const RunSweep<double>&, int, double,
                                   const std::vector<double>&, bool, bool);

}  // namespace puffin::lbm
