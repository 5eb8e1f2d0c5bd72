// A progressive glTF mesh as it lies in a file: the base in accessors, the rest as one payload.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "bitstream/base_topology.h"
#include "bitstream/stream_header.h"

namespace zerotree::gltf {

inline constexpr const char* kExtensionName = "ZEROTREE_mesh_progressive";
/// Largest value of the extension's property `levels`.
inline constexpr int kMaxLevels = bitstream::kMostLevels;

/// An entry of the extension's table of measured errors.
struct PrefixEntry {
  /// First bytes of the payload that are decoded.
  std::uint64_t byte_length = 0;
  /// Symmetric RMS distance from the source mesh, in the mesh's own unit (metres, glTF).
  double geometric_error = 0;
};

/// What a node does to the coordinates of its mesh: p -> scale p + translation. A mesh on a grid of
/// integers is made large and put in place so.
struct Placement {
  double scale = 1;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// A mesh with the extension ZEROTREE_mesh_progressive. Lengths are in the mesh's own unit.
struct ProgressiveAsset {
  /// Name of the mesh; may be empty.
  std::string name;
  std::string generator = "zerotree";
  /// Connectivity of the base. The order of vertices and triangles numbers the details. Creases
  /// and corners are part of the payload, not of the accessors: both lists are empty here.
  bitstream::BaseTopology base;
  /// Control points p^0, one per base vertex, bit for bit what the payload's hash covers.
  std::vector<Eigen::Vector3f> control_points;
  /// Unit normals of the base's limit surface, one per base vertex; or none, and viewers that do
  /// not know the extension show flat triangles.
  std::vector<Eigen::Vector3f> normals;
  /// Of the first node that shows the mesh; a rotation or different scales of the axes are left
  /// out.
  Placement placement;
  /// The zerotree stream bound to the base above. Shorter than `payload_length` if the file read
  /// was cut off.
  std::vector<std::uint8_t> payload;
  /// Length of the whole payload as the file states it; writing takes payload.size().
  std::uint64_t payload_length = 0;
  /// Times the base is quadrisected for the finest details.
  int levels = 0;
  /// Byte lengths strictly ascend to payload_length, errors never rise; at least one entry.
  std::vector<PrefixEntry> prefixes;
  /// Box around the decoded surface of every prefix.
  Eigen::Vector3f bounds_min = Eigen::Vector3f::Zero();
  Eigen::Vector3f bounds_max = Eigen::Vector3f::Zero();
  /// Bounding box diagonal of the source mesh: relative errors are errors over this length.
  double source_diagonal = 0;
};

}  // namespace zerotree::gltf
