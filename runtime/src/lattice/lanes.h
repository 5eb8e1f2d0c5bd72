// Vectors over several base triangles at once: what all of them do alike, one instruction does.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace zerotree::surface {

/// Triangles side by side. Four floats fill a register of every 64 bit machine.
inline constexpr std::size_t kLanes = 4;

/// A number per lane (vector extension of GCC and Clang).
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));
/// All bits set where a comparison of Lanes holds, otherwise none.
typedef int LaneMask __attribute__((vector_size(kLanes * sizeof(int))));

/// An integer per lane.
typedef std::int32_t LaneIntegers __attribute__((vector_size(kLanes * sizeof(std::int32_t))));

/// A point or vector per lane.
struct LanePoint {
  Lanes x, y, z;

  LanePoint& operator+=(const LanePoint& p) {
    x += p.x;
    y += p.y;
    z += p.z;
    return *this;
  }
  LanePoint& operator-=(const LanePoint& p) {
    x -= p.x;
    y -= p.y;
    z -= p.z;
    return *this;
  }
  friend LanePoint operator+(LanePoint p, const LanePoint& q) { return p += q; }
  friend LanePoint operator-(LanePoint p, const LanePoint& q) { return p -= q; }
  friend LanePoint operator*(float s, const LanePoint& p) { return {s * p.x, s * p.y, s * p.z}; }
  friend LanePoint operator*(const Lanes& s, const LanePoint& p) {
    return {s * p.x, s * p.y, s * p.z};
  }
};

inline Lanes dot_product(const LanePoint& p, const LanePoint& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
inline LanePoint cross_product(const LanePoint& p, const LanePoint& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
inline Lanes square_root(const Lanes& x) {
  Lanes root = x;
  for (std::size_t lane = 0; lane < kLanes; ++lane) root[lane] = std::sqrt(root[lane]);
  return root;
}
inline Lanes to_floats(const LaneIntegers& values) {
  return __builtin_convertvector(values, Lanes);
}
inline bool any_of(const LaneIntegers& values) {
  static_assert(kLanes * sizeof(std::int32_t) == 2 * sizeof(std::uint64_t));
  std::uint64_t halves[2];
  std::memcpy(halves, &values, sizeof halves);
  return (halves[0] | halves[1]) != 0;
}

/// x, y, z and something of each lane.
inline std::array<Lanes, kLanes> by_lane(const LanePoint& p) {
  static_assert(kLanes == 4, "a transposed 4 x 4 matrix");
  const Lanes xy_low = __builtin_shufflevector(p.x, p.y, 0, 4, 1, 5);
  const Lanes xy_high = __builtin_shufflevector(p.x, p.y, 2, 6, 3, 7);
  const Lanes z_low = __builtin_shufflevector(p.z, p.z, 0, 4, 1, 5);
  const Lanes z_high = __builtin_shufflevector(p.z, p.z, 2, 6, 3, 7);
  return {__builtin_shufflevector(xy_low, z_low, 0, 1, 4, 5),
          __builtin_shufflevector(xy_low, z_low, 2, 3, 6, 7),
          __builtin_shufflevector(xy_high, z_high, 0, 1, 4, 5),
          __builtin_shufflevector(xy_high, z_high, 2, 3, 6, 7)};
}
inline bool all_of(const LaneMask& mask) {
  return !any_of(~mask);
}

}  // namespace zerotree::surface
