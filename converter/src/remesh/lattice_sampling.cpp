#include "remesh/lattice_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zerotree::remesh {
namespace {

// Lattice points on an edge may be missed by both faces through rounding: let each reach out.
constexpr double kReach = 1e-9;

class LatticeSampler {
 public:
  LatticeSampler(const BaseDomain& base, const LatticeNumbering& numbering)
      : base_(base),
        numbering_(numbering),
        depth_(numbering.vertex_count, -std::numeric_limits<double>::infinity()) {
    samples.faces.resize(numbering.vertex_count, kNone);
    samples.weights.resize(numbering.vertex_count, Eigen::Vector3d::Zero());
  }

  // A base vertex is a vertex of the mesh: nothing to interpolate.
  void set_base_vertex(std::uint32_t index, const domain::TriangleTopology& topology) {
    const std::uint32_t vertex = base_.mesh_vertex[index];
    samples.faces[index] = topology.face_of_vertex[vertex];
    samples.weights[index][domain::corner_of(topology.faces[samples.faces[index]], vertex)] = 1;
    depth_[index] = std::numeric_limits<double>::infinity();
  }

  void add_face(std::uint32_t index, const FaceAnchor& anchor,
                const std::array<LatticePoint, 3>& face) {
    const double steps = numbering_.steps();
    const double area = lattice_area(face[0], face[1], face[2]);
    if (!(area > 0)) return;
    const LatticePoint low = face[0].cwiseMin(face[1]).cwiseMin(face[2]) * steps;
    const LatticePoint high = face[0].cwiseMax(face[1]).cwiseMax(face[2]) * steps;
    const auto first_j = std::lround(std::ceil(low.y() - kReach));
    const auto last_j = std::lround(std::floor(high.y() + kReach));
    const auto first_i = std::lround(std::ceil(low.x() - kReach));
    const auto last_i = std::lround(std::floor(high.x() + kReach));
    for (auto j = first_j; j <= last_j; ++j)
      for (auto i = first_i; i <= last_i; ++i) {
        const LatticePoint p(static_cast<double>(i) / steps, static_cast<double>(j) / steps);
        const Eigen::Vector3d weights(lattice_area(p, face[1], face[2]) / area,
                                      lattice_area(p, face[2], face[0]) / area,
                                      lattice_area(p, face[0], face[1]) / area);
        if (weights.minCoeff() >= -kReach) offer(index, anchor, p, weights);
      }
  }

  std::uint32_t count_missing() const {
    return static_cast<std::uint32_t>(
        std::ranges::count(depth_, -std::numeric_limits<double>::infinity()));
  }

  LatticeSamples samples;

 private:
  void offer(std::uint32_t face, const FaceAnchor& anchor, const LatticePoint& p,
             const Eigen::Vector3d& weights) {
    const BasePlace place = walk(base_, anchor.triangle, anchor.point, p);
    if (!is_inside(place.point)) return;  // reached over the boundary
    // Lattice points have dyadic coordinates, so the walk has kept them exactly.
    const double steps = numbering_.steps();
    const std::uint32_t vertex =
        numbering_.at(place.triangle, static_cast<std::uint32_t>(place.point.x() * steps),
                      static_cast<std::uint32_t>(place.point.y() * steps));
    const double depth = weights.minCoeff();
    if (depth <= depth_[vertex]) return;
    depth_[vertex] = depth;
    samples.faces[vertex] = face;
    samples.weights[vertex] = weights.cwiseMax(0.0) / weights.cwiseMax(0.0).sum();
  }

  const BaseDomain& base_;
  const LatticeNumbering& numbering_;
  std::vector<double> depth_;
};

}  // namespace

LatticeSamples sample_lattice(const ConeCharts& charts, const BaseDomain& base,
                              const LatticeNumbering& numbering) {
  LatticeSampler sampler(base, numbering);
  for (std::uint32_t v = 0; v < base.mesh_vertex.size(); ++v)
    sampler.set_base_vertex(v, charts.topology);
  for (std::uint32_t f = 0; f < charts.topology.faces.size(); ++f) {
    const FaceAnchor anchor = anchor_of(charts, base, f);
    const auto corner = [&](int k) { return apply(anchor.map, charts.corner_point(f, k)); };
    sampler.add_face(f, anchor, {corner(0), corner(1), corner(2)});
  }
  sampler.samples.missing = sampler.count_missing();
  return std::move(sampler.samples);
}

}  // namespace zerotree::remesh
