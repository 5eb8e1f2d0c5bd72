// Interpolating subdivision: where a smooth surface through the vertices of a mesh may lie.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "domain/domain.h"
#include "domain/triangle_topology.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::discretisation {

/// A mesh with its neighbours and features. `mesh.triangles` equals `topology.faces`.
struct FeaturedMesh {
  TriangleMesh mesh;
  domain::TriangleTopology topology;
  std::vector<domain::VertexKind> kinds;
};

/// The clean `mesh` with the creases of the feature stage (domain/feature_edges.h).
/// Throws Error(refused_topology) if it is no manifold. About a microsecond a vertex.
FeaturedMesh find_features(const TriangleMesh& mesh, double crease_angle_degrees);

/// Modified Butterfly subdivision (Zorin, Schroeder, Sweldens 1996; the rules beside creases and
/// boundaries from the SIGGRAPH 2000 course notes). Features are curves of the four-point rule,
/// which corners end; the end of a crease in a smooth region is smooth. Refers to `input`, which
/// must outlive it. Holds scratch memory: one per thread.
class ButterflyStencils {
 public:
  explicit ButterflyStencils(const FeaturedMesh& input) : input_(input) {}

  /// The new vertex of edge `k` of `face`. Constant time but for the valence of its ends.
  Eigen::Vector3d edge_point(std::uint32_t face, int k);

 private:
  // How much an end of an edge decides on its new vertex.
  enum class Rank { regular, feature, irregular };
  struct EndRule {
    Rank rank;
    Eigen::Vector3d point;  // by this end's own rule; not set where it is regular
  };

  const Eigen::Vector3d& position(std::uint32_t v) const { return input_.mesh.positions[v]; }
  Eigen::Vector3d curve_point(std::uint32_t a, std::uint32_t b);
  std::uint32_t previous_on_curve(std::uint32_t vertex, std::uint32_t next);
  EndRule end_rule(std::uint32_t vertex, std::uint32_t other);
  Eigen::Vector3d regular_point(std::uint32_t face, int k) const;
  Eigen::Vector3d irregular_point(std::uint32_t vertex, int spoke) const;
  Eigen::Vector3d sector_point(std::uint32_t vertex, int spoke) const;
  void gather_spokes(std::uint32_t vertex);

  const FeaturedMesh& input_;
  domain::Star star_;
  std::vector<std::uint32_t> spokes_;  // the neighbours, counter-clockwise
  std::vector<std::uint8_t> is_feature_;
  int features_ = 0;
};

/// One step of the subdivision: vertices stay, face f becomes the faces 4f to 4f + 3.
FeaturedMesh butterfly_subdivide(const FeaturedMesh& input);

}  // namespace zerotree::discretisation
