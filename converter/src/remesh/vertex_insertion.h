// Undoing collapses on the base surface.
#pragma once

#include "mesh/triangle_mesh.h"
#include "remesh/cone_charts.h"
#include "remesh/stretch_energy.h"

namespace zerotree::remesh {

/// Puts removed vertices back into the charts, each inside the kernel of its ring. Holds scratch
/// memory, so one per thread.
class VertexInsertion {
 public:
  VertexInsertion(BaseDomain& base, const std::vector<Eigen::Vector3d>& positions,
                  const std::vector<domain::VertexKind>& kinds)
      : base_(base), positions_(positions), kinds_(kinds) {}

  /// Undoes `collapse` and places its vertex. Returns whether there was room; if not, the place is
  /// to be found by `swap_in` before anything around is touched. Touches no face but those at
  /// `kept` and changes nothing of the base.
  bool insert(ConeCharts& charts, const domain::CollapseRecord& collapse);

  /// Where the fan at a cone leaves the vertex no room: it takes the cone's place, and the other
  /// one moves into the rest of the cone's fan. Returns whether there was room; if not, `charts` is
  /// no longer usable.
  bool swap_in(ConeCharts& charts, const domain::CollapseRecord& collapse);

  /// After an insertion: the faces around the vertex are so small that those that come yet may find
  /// no room among them.
  bool is_squeezed() const { return least_area_ < kSqueezedArea; }
  /// The faces around the vertex inserted last.
  const domain::Star& star() const { return star_; }

  /// How often a vertex took a cone's place.
  std::uint32_t cone_swaps() const { return cone_swaps_; }

 private:
  // The vertex `free` beside the vertex `fixed`: the faces between them, on the far side of the two
  // faces of their edge, in the order around `fixed`'s place, and the charts of those faces.
  struct Sector {
    std::uint32_t free = kNone, fixed = kNone;
    std::uint32_t first_gap = kNone, last_gap = kNone;  // the edge's faces before and after
    std::vector<domain::Corner> faces;
    std::vector<LatticeIsometry> charts;  // of each face, to that of the first
    std::size_t chain = kNone;            // ring entry of the free vertex's other chain neighbour
    double angle = 0;                     // around a cone
  };

  void unfold(const ConeCharts& charts);
  void gather_complement(const ConeCharts& charts, const domain::CollapseRecord& collapse);
  bool place(ConeCharts& charts);
  bool place_in_plane(ConeCharts& charts);
  bool place_on_chain(ConeCharts& charts);
  LatticeIsometry chain_chart(const ConeCharts& charts, VertexChart& vertex, double& t_fixed,
                              double& t_chain) const;
  void set_transitions(ConeCharts& charts, const LatticeIsometry& from_vertex);
  bool is_positive(const ConeCharts& charts, std::uint32_t vertex);
  bool may_swap(const ConeCharts& charts, const domain::CollapseRecord& collapse);

  BaseDomain& base_;
  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<domain::VertexKind>& kinds_;
  static constexpr double kSqueezedArea = 1e-9;  // a base triangle is 1

  std::uint32_t cone_swaps_ = 0;
  double least_area_ = 1;
  Sector sector_;
  std::vector<std::uint32_t> fan_;
  domain::Star star_;
  Ring ring_;
  std::vector<LatticePoint> ring_lattice_;
  std::vector<LatticeIsometry> transitions_before_;
  StretchEnergy energy_;
};

}  // namespace zerotree::remesh
