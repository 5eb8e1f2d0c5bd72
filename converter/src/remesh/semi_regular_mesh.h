// What the remesher hands to the wavelet analysis.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bitstream/base_topology.h"

namespace zerotree::remesh {

/// A semi-regular mesh: `base` quadrisected `levels` times.
/// Vertices of level j + 1 are numbered as OpenSubdiv's uniform refinement does: the child of
/// vertex v is v, the child of edge e is V_j + e; children of face f are 4f + k; edges inside a
/// face are 3f + k, halves of edge e are 3F_j + 2e + {0, 1} (design: the child faces 4f + k, k < 3,
/// hold corner k, 4f + 3 is the middle one).
struct SemiRegularMesh {
  bitstream::BaseTopology base;
  int levels = 0;
  /// Positions of all vertices of level `levels`; the first base.vertex_count are the base's.
  std::vector<Eigen::Vector3d> positions;
};

}  // namespace zerotree::remesh
