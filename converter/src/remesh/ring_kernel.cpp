#include "remesh/ring_kernel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace zerotree::remesh {

double least_doubled_area(const Ring& ring, const Eigen::Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.edge_count(); ++i)
    least = std::min(least, doubled_area(p, ring.points[i], ring.points[ring.after(i)]));
  return least;
}

std::optional<Eigen::Vector2d> kernel_centroid(const Ring& ring) {
  Eigen::Vector2d low = ring.points.front(), high = low;
  for (const Eigen::Vector2d& p : ring.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<Eigen::Vector2d> kernel{low, {high.x(), low.y()}, high, {low.x(), high.y()}}, clipped;
  for (std::size_t i = 0; i < ring.edge_count(); ++i) {
    const Eigen::Vector2d &a = ring.points[i], &b = ring.points[ring.after(i)];
    clipped.clear();
    for (std::size_t j = 0; j < kernel.size(); ++j) {
      const Eigen::Vector2d &p = kernel[j], &q = kernel[(j + 1) % kernel.size()];
      const double at_p = doubled_area(a, b, p), at_q = doubled_area(a, b, q);
      if (at_p >= 0) clipped.push_back(p);
      if ((at_p < 0) != (at_q < 0)) clipped.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    kernel.swap(clipped);
    if (kernel.size() < 3) return std::nullopt;
  }
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double area = 0;
  for (std::size_t j = 1; j + 1 < kernel.size(); ++j) {
    const double part = doubled_area(kernel[0], kernel[j], kernel[j + 1]);
    sum += part * ((kernel[j] - kernel[0]) + (kernel[j + 1] - kernel[0])) / 3;
    area += part;
  }
  if (!(area > 0)) return std::nullopt;
  return kernel[0] + sum / area;
}

std::optional<std::array<double, 2>> kernel_interval(const Ring& ring, const Eigen::Vector2d& a,
                                                     const Eigen::Vector2d& b) {
  double low = 0, high = 1;
  for (std::size_t i = 0; i < ring.edge_count(); ++i) {
    const Eigen::Vector2d &p = ring.points[i], &q = ring.points[ring.after(i)];
    const double at_a = doubled_area(p, q, a), at_b = doubled_area(p, q, b);
    // An edge that begins or ends in a or b is zero there up to rounding.
    if (at_a < at_b) {
      low = std::max(low, -at_a / (at_b - at_a));
    } else if (at_a > at_b) {
      high = std::min(high, at_a / (at_a - at_b));
    } else if (at_a <= 0) {
      return std::nullopt;
    }
  }
  if (!(high - low > 1e-9)) return std::nullopt;
  return std::array<double, 2>{low, high};
}

Eigen::Vector2d mean_value_average(const Ring& ring, const Eigen::Vector3d& position) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double total = 0;
  for (std::size_t i = 0; i < ring.edge_count(); ++i) {
    const std::size_t j = ring.after(i);
    const Eigen::Vector3d a = ring.positions[i] - position, b = ring.positions[j] - position;
    const double length_a = std::max(a.norm(), 1e-300), length_b = std::max(b.norm(), 1e-300);
    // tan(angle / 2) = sin / (1 + cos), kept finite where the angle nears pi.
    const double cosine = a.dot(b) / (length_a * length_b);
    const double sine = a.cross(b).norm() / (length_a * length_b);
    const double half_tangent = sine / std::max(1 + cosine, 1e-3) + 1e-6;
    sum += half_tangent * (ring.points[i] / length_a + ring.points[j] / length_b);
    total += half_tangent * (1 / length_a + 1 / length_b);
  }
  return sum / total;
}

}  // namespace zerotree::remesh
