// Topology and linear operators of every level of the Loop surface over a base mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"
#include "surface/edge_forest.h"
#include "surface/local_filter.h"
#include "surface/shared_stencils.h"
#include "surface/wavelet_transform.h"

namespace zerotree::surface {

/// P of one level, rows in the finer level's vertex order; the layout OpenSubdiv evaluates.
struct SubdivisionStencils {
  std::vector<int> sizes, offsets, indices;
  std::vector<float> weights;
};

/// One level. What leads to the next finer level is empty at the finest one.
struct SubdivisionLevel {
  std::uint32_t vertex_count = 0, edge_count = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  SharedStencils limit;             ///< see limit_stencils.h
  EdgeLevel edges;                  ///< to the next level: where details belong
  SubdivisionStencils subdivision;  ///< to the next level: P
  SharedStencils details;           ///< to the next level: Q, one row per edge; or, if the
  LocalFilter local_details;        ///< transform is loop_local, this
};

/// All levels 0 .. levels() of a base mesh, numbered as OpenSubdiv's uniform refinement does: the
/// child of vertex v is v, that of edge e is V + e, those of face f are 4f .. 4f + 3. About 250
/// bytes and 2 microseconds per finest vertex; while it is being built three times the bytes.
class SubdivisionHierarchy {
 public:
  /// Throws std::invalid_argument with a sentence if `base` is not an oriented 2-manifold (see
  /// bitstream::number_base_edges and make_loop_refiner), `levels` is out of 0 .. 14 or the finest
  /// level would pass 2^31 vertices.
  SubdivisionHierarchy(const bitstream::BaseTopology& base, int levels, WaveletTransform transform);

  WaveletTransform transform() const { return transform_; }
  int levels() const { return static_cast<int>(levels_.size()) - 1; }
  const SubdivisionLevel& level(int number) const {
    return levels_[static_cast<std::size_t>(number)];
  }
  const bitstream::BaseTopology& base() const { return base_; }
  /// In the order in which the stream numbers them.
  const std::vector<bitstream::BaseEdge>& base_edges() const { return base_edges_; }

 private:
  bitstream::BaseTopology base_;
  WaveletTransform transform_;
  std::vector<bitstream::BaseEdge> base_edges_;
  std::vector<SubdivisionLevel> levels_;
};

}  // namespace zerotree::surface
