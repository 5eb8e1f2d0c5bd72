// The room a vertex has inside the ring of its neighbours.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace zerotree::remesh {

/// The neighbours of a vertex, counter-clockwise: in the plane of a chart, and on the input mesh.
/// A closed ring goes on from the last to the first. Meant to be reused.
struct Ring {
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector3d> positions;
  bool closed = true;

  std::size_t edge_count() const { return closed ? points.size() : points.size() - 1; }
  std::size_t after(std::size_t i) const { return i + 1 == points.size() ? 0 : i + 1; }
};

/// Twice the signed area of a triangle of the plane.
inline double doubled_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                           const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The least doubled area of the triangles between `p` and the ring's edges.
double least_doubled_area(const Ring& ring, const Eigen::Vector2d& p);

/// The centroid of the ring's kernel, the part that sees every edge from its left; empty if there
/// is none. O(n^2) for n edges.
std::optional<Eigen::Vector2d> kernel_centroid(const Ring& ring);

/// The part of the line a + s (b - a), 0 < s < 1, that lies in the kernel: {low, high} with
/// low < high; empty if there is none.
std::optional<std::array<double, 2>> kernel_interval(const Ring& ring, const Eigen::Vector2d& a,
                                                     const Eigen::Vector2d& b);

/// Floater's mean value average of the ring's points, with the angles and lengths that the ring has
/// around `position` on the input mesh.
Eigen::Vector2d mean_value_average(const Ring& ring, const Eigen::Vector3d& position);

}  // namespace zerotree::remesh
