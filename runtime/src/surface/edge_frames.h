// The local frame that a detail is expressed in (paper, section 3.3).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bitstream/base_topology.h"

namespace zerotree::surface {

using Vector3 = std::array<double, 3>;

inline Vector3 cross_product(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double dot_product(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// An orthonormal, right-handed frame: tangent1 x tangent2 = normal.
struct EdgeFrame {
  Vector3 normal, tangent1, tangent2;

  /// `vector` as (normal, tangent 1, tangent 2).
  Vector3 components(const Vector3& vector) const {
    return {dot_product(normal, vector), dot_product(tangent1, vector),
            dot_product(tangent2, vector)};
  }
};

/// The frame of the surface whose tangents are `along` and `across`: tangent 1 points along,
/// tangent 2 to the side of `across`. Orthonormal and finite for any arguments: where they do not
/// span a plane (zero, parallel, not finite) a fixed choice takes their place.
inline EdgeFrame frame_from_tangents(const Vector3& along, const Vector3& across) {
  const auto scaled = [](const Vector3& a, double s) {
    return Vector3{a[0] * s, a[1] * s, a[2] * s};
  };
  const auto is_usable = [](double squared) { return squared > 1e-60 && squared < 1e200; };

  EdgeFrame frame;
  const double along2 = dot_product(along, along);
  frame.tangent1 =
      is_usable(along2) ? scaled(along, 1.0 / std::sqrt(along2)) : Vector3{1.0, 0.0, 0.0};
  Vector3 normal = cross_product(frame.tangent1, across);
  double normal2 = dot_product(normal, normal);
  const double across2 = dot_product(across, across);
  if (!is_usable(across2) || !(normal2 > 1e-12 * across2)) {
    // The axis that tangent 1 is farthest from.
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (std::abs(frame.tangent1[k]) < std::abs(frame.tangent1[axis])) axis = k;
    Vector3 unit{};
    unit[axis] = 1.0;
    normal = cross_product(frame.tangent1, unit);
    normal2 = dot_product(normal, normal);
  }
  frame.normal = scaled(normal, 1.0 / std::sqrt(normal2));
  frame.tangent2 = cross_product(frame.normal, frame.tangent1);
  return frame;
}

/// Where floats suffice for a normal: its squared length before scaling is in this range, and the
/// squared sine between the tangents is at least this. Elsewhere doubles decide.
inline constexpr float kLeastNormal2 = 1e-30f, kLargestNormal2 = 1e30f, kLeastSine2 = 1e-4f;

/// Two tangents of the coarser level's surface at an odd vertex.
struct EdgeTangents {
  Vector3 along, across;
  /// A triangle of the coarser level beside the edge in units of |along x across|.
  double area_share;

  EdgeFrame frame() const { return frame_from_tangents(along, across); }
  /// Mean area of these triangles, as the surface has it there.
  double triangle_area() const {
    const Vector3 normal = cross_product(along, across);
    return area_share * std::sqrt(dot_product(normal, normal));
  }
};

/// A triangle beside an edge with two triangles, and beside a boundary edge, in units of
/// |along x across|.
inline constexpr double kInteriorAreaShare = 1.0 / 12.0;
inline constexpr double kBoundaryAreaShare = 1.0 / 2.0;

/// The tangents from the control points of the finer level before the detail is added, each x, y,
/// z: the edge's even vertices and the odd ones on the other edges of its two faces, `wings` of
/// surface/edge_forest.h; those of the right face are null at a boundary. In the interior these are
/// Loop's limit tangents of the (always regular) odd vertex; on a crease the mean of both sides; on
/// a boundary the B-spline curve and the surface beside it.
template <class Real>
EdgeTangents edge_tangents(const Real* tail, const Real* head,
                           const std::array<const Real*, 4>& wings) {
  const auto& [left_tail, left_head, right_tail, right_head] = wings;
  EdgeTangents tangents;
  auto& [along, across, area_share] = tangents;
  if (!right_tail) {
    area_share = kBoundaryAreaShare;
    for (std::size_t k = 0; k < 3; ++k) {
      along[k] = static_cast<double>(head[k]) - tail[k];
      across[k] = static_cast<double>(left_tail[k]) + left_head[k] - tail[k] - head[k];
    }
  } else {
    area_share = kInteriorAreaShare;
    for (std::size_t k = 0; k < 3; ++k) {
      along[k] = 2.0 * (static_cast<double>(head[k]) - tail[k]) + left_head[k] - left_tail[k] +
                 right_head[k] - right_tail[k];
      across[k] = static_cast<double>(left_tail[k]) + left_head[k] - right_tail[k] - right_head[k];
    }
  }
  return tangents;
}

/// The same from a whole level: `predicted` = P * coarse, x, y, z per vertex. {tail, head} are the
/// edge's even vertices, `wings` those of its EdgeLevel, `first_odd` the coarser level's number of
/// vertices.
template <class Real>
EdgeTangents edge_tangents(const Real* predicted, std::uint32_t first_odd,
                           const std::array<std::uint32_t, 2>& vertices,
                           const std::array<std::uint32_t, 4>& wings) {
  const auto even = [&](std::size_t k) { return predicted + 3 * std::size_t{vertices[k]}; };
  const auto odd = [&](std::size_t k) {
    return wings[k] == bitstream::kNone ? nullptr
                                        : predicted + 3 * (std::size_t{first_odd} + wings[k]);
  };
  return edge_tangents<Real>(even(0), even(1), {odd(0), odd(1), odd(2), odd(3)});
}

}  // namespace zerotree::surface
