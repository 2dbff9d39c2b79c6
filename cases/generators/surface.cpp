#include "cases/generators/surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <unordered_map>

#include "cases/generators/ear_clipping.hpp"
#include "cases/generators/refine.hpp"

namespace puffin::cases::generators {
namespace {

using lbm::geometry::TriangleMesh;
using lbm::geometry::Vec3;
using Edge = std::pair<int, int>;

constexpr const char* too_many = "the facet size asks for more than 4 million triangles";

/// Area vector of a plane polygon (Newell): its length is the area.
Vec3 area_vector(const Loop& loop) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < loop.size(); ++k) sum += (loop[k] - loop[0]).cross(loop[(k + 1) % loop.size()] - loop[0]);
  return 0.5 * sum;
}

/// Points closer than `tolerance` become one vertex.
class Weld {
 public:
  Weld(double tolerance, std::vector<Vec3>& vertices) : tolerance_(tolerance), vertices_(vertices) {}

  int index(const Vec3& p) {
    const Eigen::Array<std::int64_t, 3, 1> cell = (p.array() / (4.0 * tolerance_)).floor().cast<std::int64_t>();
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto [begin, end] = cells_.equal_range(hash(cell[0] + i, cell[1] + j, cell[2] + k));
          for (auto it = begin; it != end; ++it)
            if ((vertices_[it->second] - p).norm() <= tolerance_) return it->second;
        }
    vertices_.push_back(p);
    cells_.emplace(hash(cell[0], cell[1], cell[2]), static_cast<int>(vertices_.size()) - 1);
    return static_cast<int>(vertices_.size()) - 1;
  }

 private:
  static std::uint64_t hash(std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<std::uint64_t>(i) * 73856093U ^ static_cast<std::uint64_t>(j) * 19349663U ^
           static_cast<std::uint64_t>(k) * 83492791U;
  }
  double tolerance_;
  std::vector<Vec3>& vertices_;
  std::unordered_multimap<std::uint64_t, int> cells_;
};

using Loops = std::vector<std::vector<int>>;

std::map<Edge, int> directed_edges(const std::vector<Loops>& faces) {
  std::map<Edge, int> count;
  for (const Loops& loops : faces)
    for (const auto& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k) ++count[{loop[k], loop[(k + 1) % loop.size()]}];
  return count;
}

/// Inserts the corners of other faces that lie on an edge which has no partner.
void join_edges(const std::vector<Vec3>& vertices, double tolerance, std::vector<Loops>& faces) {
  const auto edges = directed_edges(faces);
  std::set<Edge> open;
  std::set<int> ends;
  for (const auto& [edge, count] : edges)
    if (edges.count({edge.second, edge.first}) == 0) {
      open.insert(edge);
      ends.insert({edge.first, edge.second});
    }
  for (Loops& loops : faces)
    for (auto& loop : loops) {
      std::vector<int> joined;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        joined.push_back(loop[k]);
        const Edge edge{loop[k], loop[(k + 1) % loop.size()]};
        if (open.count(edge) == 0) continue;
        const Vec3 &a = vertices[edge.first], along = vertices[edge.second] - a;
        std::vector<std::pair<double, int>> between;
        for (const int v : ends) {
          if (v == edge.first || v == edge.second) continue;
          const double s = (vertices[v] - a).dot(along) / along.squaredNorm();
          if (s > 0.0 && s < 1.0 && (vertices[v] - a - s * along).norm() <= tolerance) between.emplace_back(s, v);
        }
        std::sort(between.begin(), between.end());
        for (const auto& [s, v] : between) joined.push_back(v);
      }
      loop = joined;
    }
}

void require_closed(const TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, int> balance;
  for (const auto& c : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<std::uint64_t>(c[k]), b = static_cast<std::uint64_t>(c[(k + 1) % 3]);
      if (++balance[a << 32 | b] > 1) throw std::logic_error("a generated surface uses an edge twice");
    }
  for (const auto& [edge, count] : balance)
    if (balance.count(edge << 32 | edge >> 32) == 0) throw std::logic_error("a generated surface is not closed");
}

/// The triangles of one face, in the plane of its normal.
std::vector<std::array<int, 3>> triangulate_face(const std::vector<Vec3>& vertices, const Vec3& normal, Loops loops) {
  int axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  const Vec3 e1 = normal.cross(Vec3::Unit(axis)).normalized(), e2 = normal.normalized().cross(e1);
  std::vector<Eigen::Vector2d> points;
  std::vector<int> vertex;
  const Vec3& origin = vertices[loops[0][0]];
  for (auto& loop : loops)
    for (int& corner : loop) {
      const Vec3 p = vertices[corner] - origin;
      points.emplace_back(p.dot(e1), p.dot(e2));
      vertex.push_back(corner);
      corner = static_cast<int>(points.size()) - 1;
    }
  auto triangles = triangulate(points, loops);
  for (auto& t : triangles)
    for (int& corner : t) corner = vertex[corner];
  return triangles;
}

}  // namespace

void Surface::add(std::string_view solid, Loop outer, std::vector<Loop> holes) {
  auto found = std::find(solids_.begin(), solids_.end(), solid);
  if (found == solids_.end()) found = solids_.insert(solids_.end(), std::string(solid));
  Face face{static_cast<int>(found - solids_.begin()), {std::move(outer)}};
  const Vec3 normal = area_vector(face.loops[0]);
  for (Loop& hole : holes) {
    if (area_vector(hole).dot(normal) > 0.0) std::reverse(hole.begin(), hole.end());
    face.loops.push_back(std::move(hole));
  }
  expected_ += expected_triangles(face, facet_size_);
  if (!(expected_ <= largest_surface)) throw std::length_error(too_many);
  faces_.push_back(std::move(face));
}

double Surface::expected_triangles(const Face& face, double facet_size) {
  const double edge = 0.75 * facet_size;
  return 1.0 + area_vector(face.loops[0]).norm() / (0.25 * std::sqrt(3.0) * edge * edge);
}

double Surface::expected_triangles(double facet_size) const {
  double sum = 0.0;
  for (const Face& face : faces_) sum += expected_triangles(face, facet_size);
  return sum;
}

std::vector<std::string> Surface::solids() const {
  std::vector<std::string> used;
  for (std::size_t s = 0; s < solids_.size(); ++s)
    if (std::any_of(faces_.begin(), faces_.end(), [s](const Face& f) { return f.solid == static_cast<int>(s); }))
      used.push_back(solids_[s]);
  return used;
}

TriangleMesh Surface::close(double facet_size) const {
  if (!(expected_triangles(facet_size) <= largest_surface)) throw std::length_error(too_many);
  TriangleMesh mesh;
  mesh.solids = solids();
  std::vector<int> rank(solids_.size());
  for (std::size_t s = 0; s < solids_.size(); ++s)
    rank[s] = static_cast<int>(std::find(mesh.solids.begin(), mesh.solids.end(), solids_[s]) - mesh.solids.begin());
  double size = 0.0;
  for (const Face& face : faces_)
    for (const Vec3& p : face.loops[0]) size = std::max(size, (p - faces_[0].loops[0][0]).norm());
  const double tolerance = 1e-9 * size;
  Weld weld(tolerance, mesh.vertices);
  std::vector<Loops> faces;
  for (const Face& face : faces_) {
    faces.emplace_back();
    for (const Loop& loop : face.loops) {
      faces.back().emplace_back();
      for (const Vec3& p : loop) faces.back().back().push_back(weld.index(p));
    }
  }
  join_edges(mesh.vertices, tolerance, faces);
  std::vector<int> face_of;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const auto& t : triangulate_face(mesh.vertices, area_vector(faces_[f].loops[0]), faces[f])) {
      mesh.triangles.push_back(t);
      mesh.solid.push_back(rank[faces_[f].solid]);
      face_of.push_back(static_cast<int>(f));
    }
  require_closed(mesh);
  refine(facet_size, mesh, face_of);
  require_closed(mesh);
  return mesh;
}

double enclosed_volume(const TriangleMesh& mesh) {
  const Vec3 reference = mesh.vertices.empty() ? Vec3(Vec3::Zero()) : mesh.vertices.front();
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int i = static_cast<int>(t);
    sum += (mesh.corner(i, 0) - reference).dot((mesh.corner(i, 1) - reference).cross(mesh.corner(i, 2) - reference));
  }
  return sum / 6.0;
}

}  // namespace puffin::cases::generators
