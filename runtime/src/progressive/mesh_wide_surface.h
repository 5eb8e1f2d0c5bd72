// Control points by mesh-wide stencils: for the transform whose filter reaches beyond one triangle.
#pragma once

#include <memory>
#include <utility>

#include "bitstream/base_topology.h"
#include "bitstream/coefficient_layout.h"
#include "surface/detail_weights.h"
#include "surface/subdivision_hierarchy.h"
#include "surface/surface_synthesis.h"

namespace zerotree::surface {

/// Keeps the topology of the deepest level asked for until the sharp tags change; 250 bytes and 2
/// microseconds a vertex, on the heap.
class MeshWideSurface {
 public:
  /// A hierarchy to use wherever its transform, sharp tags and levels suffice, so that several
  /// surfaces of one base share it. Its base has this surface's triangles.
  void share(std::shared_ptr<const SubdivisionHierarchy> hierarchy) {
    shared_ = std::move(hierarchy);
  }

  /// Throws std::invalid_argument if the base is no surface.
  const SubdivisionHierarchy& hierarchy(const bitstream::BaseTopology& base,
                                        WaveletTransform transform, int level) {
    if (suits(shared_.get(), base, transform, level)) return *shared_;
    if (!suits(own_.get(), base, transform, level)) {
      own_.reset();  // before the next one takes its memory
      own_ = std::make_unique<const SubdivisionHierarchy>(base, level, transform);
    }
    return *own_;
  }

 private:
  static bool suits(const SubdivisionHierarchy* hierarchy, const bitstream::BaseTopology& base,
                    WaveletTransform transform, int level) {
    return hierarchy && hierarchy->levels() >= level && hierarchy->transform() == transform &&
           hierarchy->base().crease_edges == base.crease_edges &&
           hierarchy->base().corner_vertices == base.corner_vertices;
  }

  std::shared_ptr<const SubdivisionHierarchy> shared_;
  std::unique_ptr<const SubdivisionHierarchy> own_;
};

}  // namespace zerotree::surface
