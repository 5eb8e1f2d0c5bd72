#include "measure/surface_samples.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace zerotree::measure {
namespace {

// The R2 sequence as fractions of 2^64: 1/g and 1/g^2 with g the real root of x^3 = x + 1.
constexpr std::uint64_t r2_step_u = 0xC13FA9A902A6328FULL;
constexpr std::uint64_t r2_step_v = 0x91E10DA5C79E7B1DULL;

double unit_fraction(std::uint64_t i, std::uint64_t step) {
  const std::uint64_t wrapped = (i + 1) * step;  // overflow is the modulo of the sequence
  return static_cast<double>(wrapped >> 11) * 0x1p-53;
}

Eigen::Vector3d point_in_triangle(const TriangleMesh& mesh, const Triangle& t, std::uint64_t i) {
  double u = unit_fraction(i, r2_step_u), v = unit_fraction(i, r2_step_v);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const Eigen::Vector3d& a = mesh.positions[t[0]];
  return a + u * (mesh.positions[t[1]] - a) + v * (mesh.positions[t[2]] - a);
}

}  // namespace

SurfaceSamples::SurfaceSamples(const TriangleMesh& mesh, std::size_t count)
    : mesh_(&mesh), count_(count) {
  area_before_.reserve(mesh.triangles.size() + 1);
  double sum = 0.0;
  area_before_.push_back(sum);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& p = mesh.positions[a];
    sum += 0.5 * (mesh.positions[b] - p).cross(mesh.positions[c] - p).norm();
    area_before_.push_back(sum);
  }
}

std::vector<SurfaceSample> SurfaceSamples::range(std::size_t first, std::size_t last) const {
  std::vector<SurfaceSample> samples;
  samples.reserve(last - first);
  const double area_per_sample = area_before_.back() / static_cast<double>(count_);
  std::size_t triangle = 0;
  for (std::size_t i = first; i < last; ++i) {
    const double area = (static_cast<double>(i) + 0.5) * area_per_sample;
    if (i == first) {
      const auto after = std::upper_bound(area_before_.begin(), area_before_.end() - 1, area);
      triangle = static_cast<std::size_t>(after - area_before_.begin()) - 1;
    }
    while (triangle + 1 < mesh_->triangles.size() && area_before_[triangle + 1] <= area) ++triangle;
    samples.push_back({point_in_triangle(*mesh_, mesh_->triangles[triangle], i),
                       static_cast<std::uint32_t>(triangle)});
  }
  return samples;
}

}  // namespace zerotree::measure
