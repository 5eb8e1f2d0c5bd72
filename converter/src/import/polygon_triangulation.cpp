#include "import/polygon_triangulation.h"

#include <Eigen/Geometry>
#include <span>

namespace zerotree::importer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

Triangle triangle_of(std::span<const std::uint32_t> polygon, std::size_t a, std::size_t b,
                     std::size_t c) {
  return {polygon[a], polygon[b], polygon[c]};
}

Vector3d area_vector(const Positions& positions, const Triangle& t) {
  return (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
}

// Newell's normal: the sum of the fan's area vectors, whether the polygon is flat and convex or
// not.
Vector3d area_vector(const Positions& positions, std::span<const std::uint32_t> polygon) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += area_vector(positions, triangle_of(polygon, 0, i, i + 1));
  return sum;
}

void cut_quad(const Positions& positions, std::span<const std::uint32_t> quad,
              std::vector<Triangle>& triangles) {
  const Vector3d normal = area_vector(positions, quad);
  std::size_t best = 0;
  double best_length = 0;
  bool best_inside = false;
  for (std::size_t first : {0, 1}) {  // the diagonal from corner `first` to the opposite one
    const Triangle a = triangle_of(quad, first, first + 1, first + 2);
    const Triangle b = triangle_of(quad, first, first + 2, (first + 3) % 4);
    const bool inside =
        area_vector(positions, a).dot(normal) > 0 && area_vector(positions, b).dot(normal) > 0;
    const double length = (positions[a[0]] - positions[a[2]]).squaredNorm();
    const bool better = inside != best_inside ? inside : length < best_length;
    if (first == 0 || better) {
      best = first;
      best_length = length;
      best_inside = inside;
    }
  }
  triangles.push_back(triangle_of(quad, best, best + 1, best + 2));
  triangles.push_back(triangle_of(quad, best, best + 2, (best + 3) % 4));
}

// A polygon in the plane, counter-clockwise, as a ring that loses one corner after the other.
class EarClipper {
 public:
  EarClipper(const Positions& positions, std::span<const std::uint32_t> polygon)
      : polygon_(polygon) {
    const Vector3d normal = area_vector(positions, polygon);
    int drop = 0;  // project along the axis the polygon faces most
    normal.cwiseAbs().maxCoeff(&drop);
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
    const double side = normal[drop] < 0 ? -1.0 : 1.0;
    for (std::uint32_t vertex : polygon)
      points_.emplace_back(positions[vertex][u], side * positions[vertex][v]);
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
      next_.push_back((i + 1) % n);
      previous_.push_back((i + n - 1) % n);
    }
  }

  void cut(std::vector<Triangle>& triangles) {
    std::size_t corner = 0;
    for (std::size_t left = polygon_.size(); left > 3; --left) {
      // A polygon that crosses itself may have no ear: then the corner at hand goes.
      for (std::size_t tries = 0; tries < left && !is_ear(corner); ++tries) corner = next_[corner];
      triangles.push_back(triangle_of(polygon_, previous_[corner], corner, next_[corner]));
      next_[previous_[corner]] = next_[corner];
      previous_[next_[corner]] = previous_[corner];
      corner = next_[next_[corner]];  // skipping one keeps the triangles from forming a fan
    }
    triangles.push_back(triangle_of(polygon_, previous_[corner], corner, next_[corner]));
  }

 private:
  double turn(std::size_t a, std::size_t b, std::size_t c) const {
    const Vector2d ab = points_[b] - points_[a], ac = points_[c] - points_[a];
    return ab.x() * ac.y() - ab.y() * ac.x();
  }

  bool is_ear(std::size_t corner) const {
    const std::size_t a = previous_[corner], c = next_[corner];
    if (!(turn(a, corner, c) > 0)) return false;
    for (std::size_t i = next_[c]; i != a; i = next_[i]) {
      const Vector2d& p = points_[i];
      if (p == points_[a] || p == points_[corner] || p == points_[c]) continue;
      if (turn(a, corner, i) >= 0 && turn(corner, c, i) >= 0 && turn(c, a, i) >= 0) return false;
    }
    return true;
  }

  std::span<const std::uint32_t> polygon_;
  std::vector<Vector2d> points_;
  std::vector<std::size_t> next_, previous_;
};

}  // namespace

std::vector<Triangle> triangulate(const PolygonMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.corners.size() - 2 * mesh.polygon_ends.size());
  std::uint32_t begin = 0;
  for (std::uint32_t end : mesh.polygon_ends) {
    const std::span<const std::uint32_t> polygon(mesh.corners.data() + begin, end - begin);
    if (polygon.size() == 3) {
      triangles.push_back(triangle_of(polygon, 0, 1, 2));
    } else if (polygon.size() == 4) {
      cut_quad(mesh.positions, polygon, triangles);
    } else {
      EarClipper(mesh.positions, polygon).cut(triangles);
    }
    begin = end;
  }
  return triangles;
}

}  // namespace zerotree::importer
