#include "domain/shape_complexity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

namespace zerotree::domain {
namespace {

using Eigen::Vector3d;

// Radius of a patch, relative to the diagonal.
constexpr double kPatchRadius = 0.015;
// Mean squared deviation of a patch's normals from their mean that noise may cause (25 degrees).
// What goes beyond is a limb or an edge thinner than the patch.
constexpr double kNoiseVariance = 0.2;

struct Patch {
  Vector3d normal = Vector3d::Zero();  // mean over the area, so shorter than 1
  Vector3d centre = Vector3d::Zero();
  double area = 0;
};

struct Border {
  std::uint32_t first, second;  // patches, first < second
  double length;
};

// Connected faces around a seed, in the order of the faces; creases and boundaries are not crossed.
class Patches {
 public:
  Patches(const TriangleMesh& mesh, const TriangleTopology& topology, double radius)
      : mesh_(mesh), topology_(topology), patch_of_(topology.faces.size(), kNone) {
    std::vector<std::uint32_t> queue;
    for (std::uint32_t seed = 0; seed < patch_of_.size(); ++seed) {
      if (patch_of_[seed] != kNone) continue;
      const auto index = static_cast<std::uint32_t>(patches_.size());
      patches_.emplace_back();
      const Vector3d middle = centroid(seed);
      queue.assign(1, seed);
      patch_of_[seed] = index;
      for (std::size_t i = 0; i < queue.size(); ++i) {
        add_face(queue[i], patches_.back());
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t next = topology.adjacent[queue[i]][k];
          if (is_feature(topology, queue[i], k) || patch_of_[next] != kNone ||
              (centroid(next) - middle).squaredNorm() > radius * radius)
            continue;
          patch_of_[next] = index;
          queue.push_back(next);
        }
      }
      Patch& patch = patches_.back();
      if (patch.area <= 0) continue;
      patch.normal /= patch.area;
      patch.centre /= patch.area;
    }
  }

  const std::vector<Patch>& all() const { return patches_; }

  // Common borders of patches that no crease divides, each pair once.
  std::vector<Border> borders() const {
    std::vector<Border> borders;
    for (std::uint32_t f = 0; f < patch_of_.size(); ++f)
      for (int k = 0; k < 3; ++k) {
        if (is_feature(topology_, f, k)) continue;
        const std::uint32_t a = patch_of_[f], b = patch_of_[topology_.adjacent[f][k]];
        if (a >= b) continue;
        const Triangle& t = topology_.faces[f];
        borders.push_back({a, b, (mesh_.positions[t[k]] - mesh_.positions[t[kNext[k]]]).norm()});
      }
    std::ranges::stable_sort(
        borders, {}, [](const Border& border) { return std::tuple(border.first, border.second); });
    std::size_t last = 0;
    for (std::size_t i = 1; i < borders.size(); ++i)
      if (borders[i].first == borders[last].first && borders[i].second == borders[last].second)
        borders[last].length += borders[i].length;
      else
        borders[++last] = borders[i];
    if (!borders.empty()) borders.resize(last + 1);
    return borders;
  }

 private:
  Vector3d centroid(std::uint32_t face) const {
    const Triangle& t = topology_.faces[face];
    return (mesh_.positions[t[0]] + mesh_.positions[t[1]] + mesh_.positions[t[2]]) / 3;
  }
  void add_face(std::uint32_t face, Patch& patch) const {
    const Triangle& t = topology_.faces[face];
    const Vector3d& p = mesh_.positions[t[0]];
    const Vector3d normal = (mesh_.positions[t[1]] - p).cross(mesh_.positions[t[2]] - p) / 2;
    const double area = normal.norm();
    patch.normal += normal;
    patch.centre += area * centroid(face);
    patch.area += area;
  }

  const TriangleMesh& mesh_;
  const TriangleTopology& topology_;
  std::vector<std::uint32_t> patch_of_;
  std::vector<Patch> patches_;
};

}  // namespace

double shape_complexity(const TriangleMesh& mesh, const TriangleTopology& topology) {
  const double radius = kPatchRadius * bounding_box_diagonal(mesh.positions);
  if (!(radius > 0)) return 0;
  const Patches patches(mesh, topology, radius);
  double sum = 0;
  // The turn of the normal from patch to patch, as finite volumes take a gradient's square.
  for (const Border& border : patches.borders()) {
    const Patch &a = patches.all()[border.first], &b = patches.all()[border.second];
    const double distance = std::max((a.centre - b.centre).norm(), radius);
    sum += border.length / distance * (a.normal - b.normal).squaredNorm();
  }
  // ... and within patches, where they are too large to see it: a disc of radius r and curvature k
  // has normals of variance (k r / 2)^2.
  for (const Patch& patch : patches.all()) {
    const double variance = 1 - patch.normal.squaredNorm() - kNoiseVariance;
    sum += patch.area * std::max(0.0, variance) * 4 / (radius * radius);
  }
  return sum;
}

}  // namespace zerotree::domain
