// Points spread evenly over the area of a mesh, the same ones on every run.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace zerotree::measure {

/// A point of a surface and the triangle it lies on.
struct SurfaceSample {
  Eigen::Vector3d position;
  std::uint32_t triangle;
};

/// `count` area-uniform samples of a mesh: sample i lies at share (i + 1/2) / count of the area
/// summed in triangle order, so a triangle receives its share of the samples rounded up or down,
/// and consecutive samples lie near each other in meshes whose triangles do. Inside the triangles
/// the samples follow the R2 low-discrepancy sequence (Roberts 2018).
class SurfaceSamples {
 public:
  /// Refers to `mesh`, which must outlive it and have positive area and valid indices.
  SurfaceSamples(const TriangleMesh& mesh, std::size_t count);

  std::size_t size() const { return count_; }
  /// The samples first..last-1.
  std::vector<SurfaceSample> range(std::size_t first, std::size_t last) const;

 private:
  const TriangleMesh* mesh_;
  std::size_t count_;
  std::vector<double> area_before_;  // of the triangles before each, and the whole area at the end
};

}  // namespace zerotree::measure
