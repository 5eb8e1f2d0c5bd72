#include "relax/surface_roughness.h"

#include <Eigen/Geometry>
#include <cmath>

namespace zerotree::relax {
namespace {

using domain::kNext;

// Averages over neighbours: the root of it in rings is felt.
constexpr int kAverages = 6;

// Squared turns of the normal per squared length times their weights, and the weights: areas.
struct Bend {
  float squared_curvature = 0, weight = 0;
};

std::vector<Bend> bends_at_vertices(const InputSurface& input) {
  const std::vector<Triangle>& faces = input.topology.faces;
  std::vector<Eigen::Vector3f> normals(input.mesh.positions.size(), Eigen::Vector3f::Zero());
  std::vector<float> areas(faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const Eigen::Vector3d normal = input.face_normal(f);
    areas[f] = static_cast<float>(normal.norm());
    for (std::uint32_t v : faces[f]) normals[v] += normal.cast<float>();
  }
  for (Eigen::Vector3f& normal : normals) normal.stableNormalize();
  std::vector<Bend> bends(normals.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = faces[f][k], b = faces[f][kNext[k]];
      const auto length =
          static_cast<float>((input.mesh.positions[a] - input.mesh.positions[b]).squaredNorm());
      if (domain::is_feature(input.topology, f, k) || !(length > 0)) continue;
      const float turn = (normals[a] - normals[b]).squaredNorm();
      for (std::uint32_t v : {a, b}) {
        bends[v].squared_curvature += areas[f] * turn / length;
        bends[v].weight += areas[f];
      }
    }
  return bends;
}

// Each becomes the sum of its own and its neighbours', once for each face between them.
void spread(const std::vector<Triangle>& faces, std::vector<Bend>& bends, std::vector<Bend>& sums) {
  sums = bends;
  for (const Triangle& t : faces)
    for (int k = 0; k < 3; ++k) {
      Bend& sum = sums[t[k]];
      for (std::uint32_t other : {t[kNext[k]], t[domain::kPrev[k]]}) {
        sum.squared_curvature += bends[other].squared_curvature;
        sum.weight += bends[other].weight;
      }
    }
  bends.swap(sums);
}

}  // namespace

std::vector<float> relative_roughness(const InputSurface& input) {
  std::vector<Bend> bends = bends_at_vertices(input), sums;
  double curvature = 0, weight = 0;
  for (const Bend& bend : bends) {
    curvature += static_cast<double>(bend.squared_curvature);
    weight += static_cast<double>(bend.weight);
  }
  std::vector<float> roughness(bends.size(), 1.0f);
  if (!(curvature > 0) || !std::isfinite(curvature)) return roughness;
  for (int i = 0; i < kAverages; ++i) spread(input.topology.faces, bends, sums);
  const double mean = curvature / weight;
  for (std::size_t v = 0; v < bends.size(); ++v) {
    const double here = static_cast<double>(bends[v].squared_curvature) /
                        static_cast<double>(bends[v].weight) / mean;
    if (std::isfinite(here)) roughness[v] = static_cast<float>(std::sqrt(here));
  }
  return roughness;
}

}  // namespace zerotree::relax
