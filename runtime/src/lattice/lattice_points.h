// Where the points of all base triangles lie at one level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory_resource>

#include "bitstream/raw_memory.h"
#include "lattice/lanes.h"

namespace zerotree::surface {

/// x, y and z of a point.
struct PointF {
  float x = 0.0f, y = 0.0f, z = 0.0f;

  PointF& operator+=(const PointF& p) {
    x += p.x;
    y += p.y;
    z += p.z;
    return *this;
  }
  friend PointF operator+(PointF p, const PointF& q) { return p += q; }
  friend PointF operator-(const PointF& p, const PointF& q) {
    return {p.x - q.x, p.y - q.y, p.z - q.z};
  }
  friend PointF operator*(float s, const PointF& p) { return {s * p.x, s * p.y, s * p.z}; }
};

/// The same lattice for each base triangle, kLanes triangles interleaved: a group's points are one
/// after the other. Lanes beyond the last triangle hold nothing of meaning.
class LatticePoints {
 public:
  LatticePoints() = default;
  /// Takes memory but does not write it, for its pages are new: only lanes without a triangle,
  /// which are computed too, become zero.
  LatticePoints(std::size_t triangles, std::size_t points_each, std::pmr::memory_resource* memory)
      : points_each_(points_each),
        memory_((triangles + kLanes - 1) / kLanes * points_each * sizeof(LanePoint), memory) {
    if (triangles % kLanes != 0)
      std::memset(static_cast<void*>(group(triangles / kLanes)), 0,
                  points_each * sizeof(LanePoint));
  }

  LanePoint* group(std::size_t number) {
    return static_cast<LanePoint*>(memory_.data()) + number * points_each_;
  }
  const LanePoint* group(std::size_t number) const {
    return static_cast<const LanePoint*>(memory_.data()) + number * points_each_;
  }

  PointF get(std::size_t triangle, std::uint32_t point) const {
    const float* p = lane_of(triangle, point);
    return {p[0], p[kLanes], p[2 * kLanes]};
  }
  void set(std::size_t triangle, std::uint32_t point, const PointF& value) {
    float* p = const_cast<float*>(lane_of(triangle, point));
    p[0] = value.x;
    p[kLanes] = value.y;
    p[2 * kLanes] = value.z;
  }

 private:
  // Float by float: threads may write the lanes of one point at the same time.
  const float* lane_of(std::size_t triangle, std::uint32_t point) const {
    return reinterpret_cast<const float*>(group(triangle / kLanes) + point) + triangle % kLanes;
  }

  std::size_t points_each_ = 0;
  bitstream::RawMemory memory_;
};

}  // namespace zerotree::surface
