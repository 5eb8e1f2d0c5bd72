// Places on the flat base surface and the orientation of triangles between them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "relax/surface_walk.h"
#include "remesh/base_domain.h"
#include "remesh/cone_charts.h"

namespace zerotree::relax {

/// A point of the base surface in the chart of a base triangle that holds it.
struct ChartPlace {
  std::uint32_t triangle = 0;
  remesh::LatticePoint point = remesh::LatticePoint::Zero();
};

/// The parameterisation of the input as points on it see it. Refers to its parts.
class ParameterChart {
 public:
  ParameterChart(const remesh::BaseDomain& base, const remesh::ConeCharts& charts);

  /// Where `point` of the input lies on the base surface.
  ChartPlace place_of(const SurfacePoint& point) const;

  /// Whether the triangle a, b, c of straight lines on the base surface is positively oriented.
  /// It must be small: inside one base triangle, two neighbours or the fan of one base vertex; else
  /// the answer is no. A triangle that holds a base vertex inside is one around it.
  bool is_positive(const ChartPlace& a, const ChartPlace& b, const ChartPlace& c) const;

  /// The point of the input halfway between `a` and `b` along their straight line; none where they
  /// do not see each other.
  std::optional<SurfacePoint> midpoint(const SurfacePoint& a, const SurfacePoint& b) const;

 private:
  // A corner of a base triangle: which one of its vertex's fan, counter-clockwise.
  struct FanPosition {
    std::uint16_t index = 0, size = 0;
    bool is_closed = false;
  };
  // A point seen from a base vertex: `sector` is which triangle of the fan, `point` is in the chart
  // with the vertex at the origin and the triangle's first edge along x.
  struct FanPlace {
    FanPosition fan;
    remesh::LatticePoint point;
    double turn() const;  // grows with the angle, one per triangle
  };

  FanPlace seen_from(std::uint32_t vertex, const ChartPlace& place) const;
  std::optional<std::uint32_t> common_vertex(std::uint32_t s, std::uint32_t t,
                                             std::uint32_t u) const;
  std::optional<std::uint32_t> narrow_cone(const ChartPlace& place, std::uint32_t triangle) const;
  bool is_positive_in_fan(const FanPlace& a, const FanPlace& b, const FanPlace& c) const;
  std::optional<remesh::LatticePoint> unfold(const ChartPlace& place, std::uint32_t triangle) const;

  const remesh::BaseDomain& base_;
  const remesh::ConeCharts& charts_;
  std::vector<std::array<FanPosition, 3>> fans_;
};

}  // namespace zerotree::relax
