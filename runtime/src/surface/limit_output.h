// Where limit positions and normals go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace zerotree::surface {

/// Three floats per vertex, those of vertex v `v * stride` bytes from `data`, which needs no
/// alignment. Null: not asked for.
struct StridedVectors {
  void* data = nullptr;
  std::size_t stride = 3 * sizeof(float);

  /// `value` points to three floats.
  void write(std::size_t vertex, const void* value) const {
    std::memcpy(static_cast<char*>(data) + vertex * stride, value, 3 * sizeof(float));
  }
  friend bool operator==(const StridedVectors&, const StridedVectors&) = default;
};

/// The caller's buffers.
struct LimitOutput {
  StridedVectors positions, normals;
  /// Where positions lie between the limit (0) and the control point (1).
  float outward = 0.0f;
  friend bool operator==(const LimitOutput&, const LimitOutput&) = default;
};

/// Chords of limit positions lie inside a convex surface. Where it curves like a sphere of
/// curvature k and edges are h long, triangles lie k h^2 / 8 inside in the mean and control points
/// k h^2 / 4 outside; along a curve it is 1 / 12 and 1 / 6. So one half would balance them; a
/// little less errs least on scans, whose curvature changes from vertex to vertex.
inline constexpr float kBalanced = 0.35f;

}  // namespace zerotree::surface
