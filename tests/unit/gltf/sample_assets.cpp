#include "sample_assets.h"

#include <unistd.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "bitstream/base_traversal.h"

namespace zerotree::test {
namespace {

std::vector<Eigen::Vector3f> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> normals(mesh.positions.size(), Eigen::Vector3f::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d n = (mesh.positions[t[1]] - mesh.positions[t[0]])
                                  .cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
    for (std::uint32_t v : t) normals[v] += n.cast<float>();
  }
  for (Eigen::Vector3f& n : normals) n.normalize();
  return normals;
}

}  // namespace

TriangleMesh in_canonical_order(const TriangleMesh& mesh) {
  bitstream::BaseTopology base;
  base.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  base.triangles = mesh.triangles;
  const bitstream::BaseOrder order = bitstream::canonical_base_order(base);
  TriangleMesh ordered;
  for (std::uint32_t old : order.vertices) ordered.positions.push_back(mesh.positions[old]);
  ordered.triangles = bitstream::reorder(base, order).triangles;
  return ordered;
}

gltf::ProgressiveAsset sample_asset(const Shape& shape, std::size_t payload_size) {
  gltf::ProgressiveAsset asset;
  asset.name = shape.name;
  asset.base.vertex_count = static_cast<std::uint32_t>(shape.mesh.positions.size());
  asset.base.triangles = shape.mesh.triangles;
  asset.bounds_min = asset.bounds_max = shape.mesh.positions[0].cast<float>();
  for (const Eigen::Vector3d& p : shape.mesh.positions) {
    asset.control_points.push_back(p.cast<float>());
    asset.bounds_min = asset.bounds_min.cwiseMin(p.cast<float>());
    asset.bounds_max = asset.bounds_max.cwiseMax(p.cast<float>());
  }
  asset.normals = vertex_normals(shape.mesh);
  for (std::size_t i = 0; i < payload_size; ++i)
    asset.payload.push_back(static_cast<std::uint8_t>(i * 37 + 11));
  asset.payload_length = payload_size;
  asset.levels = 3;
  asset.prefixes = {{0, 0.25}, {payload_size / 2, 0.125}, {payload_size, 0.0625f}};
  asset.source_diagonal = 3.25;
  return asset;
}

gltf::ProgressiveAsset grid_asset(const Shape& shape, std::size_t payload_size) {
  gltf::ProgressiveAsset asset = sample_asset(shape, payload_size);
  const Eigen::Vector3f low = asset.bounds_min;
  const float step = std::ldexp(1.0f, -13);  // the shapes are less than 8 long
  for (Eigen::Vector3f& p : asset.control_points) p = ((p - low) / step).array().round();
  for (Eigen::Vector3f& n : asset.normals) n = (127 * n).array().round() / 127;
  asset.placement = {step, low.cast<double>()};
  asset.bounds_max = (asset.bounds_max - low) / step;
  asset.bounds_min.setZero();
  asset.source_diagonal /= step;
  return asset;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "zerotree-test-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  std::filesystem::permissions(path_, std::filesystem::perms::owner_all, error);
  std::filesystem::remove_all(path_, error);
}

std::vector<std::string> TemporaryFolder::file_names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace zerotree::test
