// Exact maps between charts of the flat cone metric.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace zerotree::remesh {

/// A point of a chart in lattice coordinates (x, y): the point x + y w of the plane, w = e^(i
/// pi/3).
using LatticePoint = Eigen::Vector2d;

/// A rotation by `turns` x 60 degrees about the origin, then a translation by the Eisenstein
/// integer (dx, dy): integers, so that compositions stay exact however long they get.
struct LatticeIsometry {
  std::int16_t dx = 0, dy = 0;
  std::int16_t turns = 0;  // 0..5

  bool operator==(const LatticeIsometry&) const = default;
};

/// Rows of the rotations by 0..5 times 60 degrees in lattice coordinates.
inline constexpr std::array<std::array<int, 4>, 6> kRotations{
    {{1, 0, 0, 1}, {0, -1, 1, 1}, {-1, -1, 1, 0}, {-1, 0, 0, -1}, {0, 1, -1, -1}, {1, 1, -1, 0}}};

inline LatticePoint apply(const LatticeIsometry& map, const LatticePoint& p) {
  const auto& r = kRotations[map.turns];
  return {r[0] * p.x() + r[1] * p.y() + map.dx, r[2] * p.x() + r[3] * p.y() + map.dy};
}

/// The map p -> outer(inner(p)).
inline LatticeIsometry compose(const LatticeIsometry& outer, const LatticeIsometry& inner) {
  const auto& r = kRotations[outer.turns];
  return {static_cast<std::int16_t>(r[0] * inner.dx + r[1] * inner.dy + outer.dx),
          static_cast<std::int16_t>(r[2] * inner.dx + r[3] * inner.dy + outer.dy),
          static_cast<std::int16_t>((outer.turns + inner.turns) % 6)};
}

inline LatticeIsometry inverse(const LatticeIsometry& map) {
  const int turns = (6 - map.turns) % 6;
  const auto& r = kRotations[turns];
  return {static_cast<std::int16_t>(-(r[0] * map.dx + r[1] * map.dy)),
          static_cast<std::int16_t>(-(r[2] * map.dx + r[3] * map.dy)),
          static_cast<std::int16_t>(turns)};
}

/// The plane's usual coordinates of a lattice point: base triangles have unit edges.
inline Eigen::Vector2d to_plane(const LatticePoint& p) {
  return {p.x() + 0.5 * p.y(), 0.86602540378443864676 * p.y()};
}
inline LatticePoint to_lattice(const Eigen::Vector2d& p) {
  const double y = p.y() * 1.15470053837925152902;
  return {p.x() - 0.5 * y, y};
}

/// Twice the signed area of a triangle in units of a base triangle's doubled area: 1 for a base
/// triangle itself.
inline double lattice_area(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace zerotree::remesh
