#pragma once
// A scene of triangles, edges and spheres, and the painter that turns it into pixels on the processor.

#include <Eigen/Core>
#include <vector>

#include "tools/output/picture/canvas.hpp"

namespace puffin::output {

using Vec3 = Eigen::Vector3d;

struct SceneTriangle {
  Vec3 a, b, c;
  Colour colour;
  float opacity = 1.0f;  // seen straight on; a slanted pane is thicker and so less clear
};

struct SceneEdge {
  Vec3 a, b;
  Colour colour;
  float width = 1.5f;  // [pixel]
  float opacity = 1.0f;
};

struct SceneSphere {
  Vec3 centre;
  double radius = 0.0;
  Colour colour;
};

struct Scene {
  std::vector<SceneTriangle> triangles;
  std::vector<SceneEdge> edges;
  std::vector<SceneSphere> spheres;
  double smallest_radius = 0.0;  // spheres are drawn at least this large [pixel]
};

/// Parallel projection: equal lengths across the view stay equal, so a scale bar holds everywhere.
struct Camera {
  Vec3 right, up, towards_eye;        // orthonormal
  double scale = 1.0;                 // pixel per unit of length
  double centre_x = 0, centre_y = 0;  // pixel of the origin of space

  /// Looks from the given azimuth (from the x axis towards y) and elevation [degree] at the box, filling the view.
  static Camera looking(double azimuth, double elevation, const Vec3& low, const Vec3& high, const Box& view);
  /// Pixel coordinates, and the depth (larger: nearer) in the unit of length.
  Vec3 project(const Vec3& p) const {
    return {centre_x + scale * p.dot(right), centre_y - scale * p.dot(up), p.dot(towards_eye)};
  }
};

/// Paints the scene over what is on the canvas, inside `view`. What is translucent is sorted exactly, pixel by pixel,
/// so the picture does not depend on the order of the triangles, nor on the number of threads.
void paint(const Scene& scene, const Camera& camera, const Box& view, Canvas& canvas);

}  // namespace puffin::output
