// Where the points of all base triangles lie at one level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "surface/lanes.h"

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
  explicit LatticePoints(std::pmr::memory_resource* memory) : points_(memory) {}

  void resize(std::size_t triangles, std::size_t points_each) {
    points_each_ = points_each;
    points_.resize((triangles + kLanes - 1) / kLanes * points_each);
  }
  bool empty() const { return points_.empty(); }

  LanePoint* group(std::size_t number) { return points_.data() + number * points_each_; }
  const LanePoint* group(std::size_t number) const {
    return points_.data() + number * points_each_;
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
  std::pmr::vector<LanePoint> points_;
};

}  // namespace zerotree::surface
