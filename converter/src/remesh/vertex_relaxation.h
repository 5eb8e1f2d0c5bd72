// Moving single vertices of the parameterisation towards less stretch.
#pragma once

#include "mesh/triangle_mesh.h"
#include "remesh/cone_charts.h"
#include "remesh/stretch_energy.h"

namespace zerotree::remesh {

/// Moves vertices inside the kernels of their rings: no step can flip a face. Holds scratch
/// memory, so one per thread.
class VertexRelaxation {
 public:
  VertexRelaxation(const BaseDomain& base, const std::vector<Eigen::Vector3d>& positions,
                   const std::vector<domain::VertexKind>& kinds)
      : base_(base), positions_(positions), kinds_(kinds) {}

  /// `steps` Newton steps of `vertex`. A cone stays; a chain vertex stays on its base edge.
  void relax(ConeCharts& charts, std::uint32_t vertex, int steps);

 private:
  void move_to(ConeCharts& charts, std::uint32_t vertex, const LatticePoint& target);

  const BaseDomain& base_;
  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<domain::VertexKind>& kinds_;
  domain::Star star_;
  Ring ring_;
  StretchEnergy energy_;
};

}  // namespace zerotree::remesh
