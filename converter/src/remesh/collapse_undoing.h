// Undoing many collapses on the base surface, in parallel where they are independent.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "remesh/vertex_insertion.h"
#include "remesh/vertex_relaxation.h"

namespace zerotree::remesh {

/// Puts the vertices of collapses back into the charts. The vertices of the mesh are cut into parts
/// by their numbers, which are close in space (clean/spatial_order.h). Of independent collapses
/// those that touch the vertices of one part only are undone part by part in parallel, the others
/// afterwards. The parts do not depend on the number of threads, so neither does the result.
class CollapseUndoing {
 public:
  CollapseUndoing(BaseDomain& base, const std::vector<Eigen::Vector3d>& positions,
                  const std::vector<domain::VertexKind>& kinds)
      : base_(base),
        positions_(positions),
        kinds_(kinds),
        insertion_(base, positions, kinds),
        relaxation_(base, positions, kinds) {}

  /// Undoes `collapses` from the last to the first. Returns whether all found room; if not,
  /// `stuck()` is the index of one that didn't.
  bool undo(ConeCharts& charts, std::span<const domain::CollapseRecord> collapses);
  /// The same for independent collapses, in the order of their vertices.
  bool undo_independent(ConeCharts& charts, std::span<const domain::CollapseRecord> collapses);

  std::size_t stuck() const { return stuck_; }
  /// How often a vertex took a cone's place.
  std::uint32_t cone_swaps() const { return insertion_.cone_swaps(); }

 private:
  // What a part leaves for later, by the index of the collapse.
  struct Rest {
    std::vector<std::size_t> at_border;  // not undone
    std::vector<std::size_t> homeless;   // undone, but there was no room
    std::vector<std::size_t> squeezed;   // placed, and the neighbours need more room
  };

  void undo_part(ConeCharts& charts, std::span<const domain::CollapseRecord> collapses,
                 std::size_t part, Rest& rest) const;
  bool finish(ConeCharts& charts, std::span<const domain::CollapseRecord> collapses,
              std::span<Rest> rests);
  bool undo_one(ConeCharts& charts, const domain::CollapseRecord& collapse);
  void relax_ring(ConeCharts& charts, const domain::Star& star);
  std::size_t part_of(std::uint32_t vertex) const;

  BaseDomain& base_;
  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<domain::VertexKind>& kinds_;
  VertexInsertion insertion_;
  VertexRelaxation relaxation_;
  domain::Star star_;
  std::size_t stuck_ = 0;
};

}  // namespace zerotree::remesh
