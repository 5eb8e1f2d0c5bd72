// Where the mesh lies on the base surface: vertices in charts, faces with exact transitions.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/triangle_topology.h"
#include "remesh/base_domain.h"

namespace zerotree::remesh {

/// Where a vertex lies. A smooth vertex has the chart of the base triangle `triangle` that holds
/// it; a chain vertex lies at (t, 0), 0 < t < 1, in the chart of `triangle` turned so that corner
/// `corner` is (0,0): on its base edge, exactly. A cone is a base vertex and has position (0,0).
struct VertexChart {
  LatticePoint point = LatticePoint::Zero();
  std::uint32_t triangle = kNone;
  std::uint32_t cone = kNone;  ///< which base vertex it is, kNone if it is none
  std::uint8_t corner = 0;
};

/// A mesh on the base surface. `transitions[f][k]` maps the chart of corner k's vertex to that of
/// face f; a cone has no chart of its own, and there only the translation means anything (its place
/// in the face's chart). Flat surfaces have no holonomy, so all this is exact.
struct ConeCharts {
  domain::TriangleTopology topology;
  std::vector<std::array<LatticeIsometry, 3>> transitions;
  std::vector<VertexChart> vertices;

  /// Corner `k` of `face` in the face's chart.
  LatticePoint corner_point(std::uint32_t face, int k) const {
    return apply(transitions[face][k], vertices[topology.faces[face][k]].point);
  }
};

/// The base mesh on its own surface: each base vertex a cone, every face its base triangle.
ConeCharts build_base_charts(const domain::Domain& domain, const BaseDomain& base);

/// From the chart of the face across edge `k` of `face` to that of `face`.
LatticeIsometry face_transition(const ConeCharts& charts, std::uint32_t face, int k);

/// A place on the base surface for a face: a base triangle, the map from the face's chart to that
/// triangle's, and a point of the face in that triangle.
struct FaceAnchor {
  std::uint32_t triangle;
  LatticeIsometry map;
  LatticePoint point;  ///< in the triangle's chart
};

/// `base_of_face`: of each mesh face that is a base triangle at first, which; else kNone.
FaceAnchor anchor_of(const ConeCharts& charts, const BaseDomain& base, std::uint32_t face);

}  // namespace zerotree::remesh
