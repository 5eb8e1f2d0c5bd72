// Relaxing all vertices of the parameterisation, in parallel where they don't touch.
#pragma once

#include "remesh/vertex_relaxation.h"

namespace zerotree::remesh {

/// Sweeps over the vertices in the order of the base triangles that hold them, which keeps what a
/// vertex and its neighbours need close in time. The order is cut into parts: vertices whose
/// neighbours all lie in their own part are relaxed part by part in parallel, the others
/// afterwards. The parts do not depend on the number of threads, so neither does the result.
class RelaxationSweeps {
 public:
  RelaxationSweeps(const BaseDomain& base, const std::vector<Eigen::Vector3d>& positions,
                   const std::vector<domain::VertexKind>& kinds)
      : base_(base), positions_(positions), kinds_(kinds) {}

  /// `sweeps` sweeps over the vertices that `charts` has so far.
  void run(ConeCharts& charts, int sweeps);

 private:
  void order_vertices(const ConeCharts& charts);
  void find_inner_vertices(const ConeCharts& charts);

  const BaseDomain& base_;
  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<domain::VertexKind>& kinds_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint8_t> part_;      // of each vertex
  std::vector<std::uint8_t> is_inner_;  // of each in order_
  std::vector<std::uint32_t> inner_;    // by part
  std::vector<std::size_t> first_inner_;
  std::vector<std::uint32_t> border_;
};

}  // namespace zerotree::remesh
