#pragma once
// The scenes of `puffin bench dem`: carriers of 70 um in a closed box, without air.

#include <cstdint>
#include <string>
#include <vector>

#include "dem/loads.hpp"
#include "dem/models.hpp"
#include "dem/state.hpp"
#include "dem/walls.hpp"

namespace puffin::bench {

/// A box of six planes, from the origin to `size` [m].
class BoxWalls : public dem::Walls {
 public:
  explicit BoxWalls(const Eigen::Vector3d& size) : size_(size) {}
  dem::RestOfWall near(const Eigen::Vector3d& centre, double reach,
                       std::vector<dem::WallTouch>& touches) const override;
  double clearance(const Eigen::Vector3d& centre, double limit) const override;
  bool inside(const Eigen::Vector3d& point) const override;
  const Eigen::Vector3d& size() const { return size_; }

 private:
  Eigen::Vector3d size_;
};

/// One scene, ready to be moved.
struct DemScene {
  dem::Models models;
  BoxWalls walls{Eigen::Vector3d::Ones()};
  std::vector<dem::Carrier> carriers;
  double step = 0.0;          // air step [s]
  double contact_step = 0.0;  // t_c/20 of two carriers at the scene's stiffness [s]
};

/// `name`:
///   dense   : a body-centred packing at solid fraction 0.68, each carrier between eight others and pressed by them,
///             all awake: every carrier takes every contact step;
///   resting : the same, which may sleep;
///   dilute  : a cloud of solid fraction 1e-3 at 1 m/s, a few of which meet in each step.
/// Linear contacts of one stiffness, e = 0.6, friction 0.3, adhesion of the founding study.
/// Throws std::invalid_argument for another name or less than one carrier.
DemScene dem_scene(const std::string& name, std::int64_t carriers);

}  // namespace puffin::bench
