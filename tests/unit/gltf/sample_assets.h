// Progressive assets without a real payload, for tests of the container alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gltf/progressive_asset.h"
#include "shapes.h"

namespace zerotree::test {

/// `mesh` with vertices, triangles and first corners in the order the converter gives a base.
TriangleMesh in_canonical_order(const TriangleMesh& mesh);

/// An asset over the base mesh `shape`; its payload is `payload_size` arbitrary bytes.
gltf::ProgressiveAsset sample_asset(const Shape& shape, std::size_t payload_size);

/// The same with control points on a grid of 16-bit integers, which a node puts back in place, and
/// with normals that bytes hold.
gltf::ProgressiveAsset grid_asset(const Shape& shape, std::size_t payload_size);

/// An empty folder that is removed with all it holds at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  /// Names of the files in it, ascending.
  std::vector<std::string> file_names() const;

 private:
  std::filesystem::path path_;
};

}  // namespace zerotree::test
