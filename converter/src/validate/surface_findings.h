// What the surfaces of a payload's prefixes show.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "gltf/issue_table.h"
#include "gltf/progressive_asset.h"
#include "validate/prefix_plan.h"
#include "validate/seam_check.h"

namespace zerotree::validate {

/// The part of an asset that surfaces are compared with.
struct StatedSurface {
  /// JSON pointer to the extension object; empty for an elementary stream.
  std::string extension;
  /// JSON pointer to the mesh; empty for an elementary stream.
  std::string mesh;
  Eigen::AlignedBox3f bounds;
  double source_diagonal = 0;
};

/// Looks at one surface after the other and keeps the worst of each kind.
class SurfaceFindings {
 public:
  /// Without `stated`, an elementary stream's, surfaces have no bounds. Refers to it.
  explicit SurfaceFindings(const StatedSurface* stated) : stated_(stated) {}

  /// From now on seams are looked at. Refers to `seams`.
  void watch(const SeamCheck& seams) { seams_ = &seams; }

  /// The surface of a prefix: limit positions (x, y, z per vertex) of the finest level.
  void look_at(const Checkpoint& checkpoint, std::span<const float> limits);

  std::uint64_t surfaces() const { return surfaces_; }
  /// What is wrong with the surfaces and, if they have all been seen up to that of the whole stream
  /// (`is_whole`), with the size of the bounds.
  void add_issues(bool is_whole, gltf::Issues& issues) const;

 private:
  struct WidestGap {
    float relative = 0;  ///< to the surface's diagonal
    std::size_t seam = 0;
    std::uint64_t bytes = 0;
  };
  std::string pointer_to(const Checkpoint& checkpoint) const;
  void check_bounds(const Checkpoint& checkpoint, const Eigen::AlignedBox3f& box);
  void check_seams(const Checkpoint& checkpoint, float diagonal, std::span<const float> limits);
  void add_loose_bounds(gltf::Issues& issues) const;
  void add_seams(gltf::Issues& issues) const;
  std::string describe(const WidestGap& gap) const;

  const StatedSurface* stated_;
  const SeamCheck* seams_ = nullptr;
  std::uint64_t surfaces_ = 0;
  gltf::Issues found_;
  Eigen::AlignedBox3f box_;  ///< of all finite surfaces
  WidestGap between_primitives_, within_primitive_;
  std::optional<gltf::Issue> outside_between_entries_;
  float farthest_between_entries_ = 0;
};

}  // namespace zerotree::validate
