#include "convert/base_grid.h"

#include <Eigen/Geometry>

#include "convert/short_decimal.h"

namespace zerotree::convert {
namespace {

constexpr double kLargestShort = 65535;
// The translation's last digit is less than this part of the size: it costs no bit of the grid.
constexpr double kSmallestShare = 1.0 / 64;
constexpr int kScaleDigits = 3;

}  // namespace

gltf::Placement grid_for(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  const double size = box.sizes().maxCoeff();
  gltf::Placement grid;
  if (!(size > 0)) return grid;
  for (int axis = 0; axis < 3; ++axis)
    grid.translation[axis] = rounded_down(box.min()[axis], kSmallestShare * size);
  const double reach = (box.max() - grid.translation).maxCoeff();
  grid.scale = rounded_up(reach / kLargestShort, kScaleDigits);
  return grid;
}

analysis::WaveletDecomposition on_grid(analysis::WaveletDecomposition wavelets,
                                       const gltf::Placement& grid) {
  for (Eigen::Vector3d& p : wavelets.base_control_points) {
    p = ((p - grid.translation) / grid.scale).array().round();
    // No negative zeros, and nothing off the grid by rounding: integers of 16 bits hold neither.
    p = p.cwiseMax(0).cwiseMin(kLargestShort).array() + 0.0;
  }
  for (std::vector<Eigen::Vector3d>& level : wavelets.details)
    for (Eigen::Vector3d& detail : level) detail /= grid.scale;
  return wavelets;
}

}  // namespace zerotree::convert
