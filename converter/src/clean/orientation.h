// Which faces to turn so that neighbours agree, and each surface has its outside outside.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "clean/index_repairs.h"

namespace zerotree::clean {

/// Union-find over faces in which each face knows whether it is turned against its root, which is
/// the lowest face of its set.
class OrientationForest {
 public:
  explicit OrientationForest(std::size_t face_count);
  /// Root of the face's set, and whether the face is turned against it.
  std::pair<std::uint32_t, bool> find(std::uint32_t face);
  /// Says that a and b are neighbours, turned against each other or not; false if that contradicts
  /// what was said before.
  bool unite(std::uint32_t a, std::uint32_t b, bool turned);

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> turned_;
};

/// Per face 1 if it must be turned to agree with most faces of its set; in a tie with the lowest.
std::vector<std::uint8_t> turn_to_majority(OrientationForest& forest, std::size_t face_count);

struct OrientationCounts {
  std::uint64_t turned_faces = 0;
  std::uint64_t turned_components = 0;
};

/// Turns faces by the majority of their set, then closed sets by volume (clean_mesh.h has the
/// rule). `mates` pairs the half-edges of neighbours and is renumbered along.
OrientationCounts orient_faces(WorkingMesh& mesh, OrientationForest& forest,
                               std::vector<std::uint32_t>& mates);

}  // namespace zerotree::clean
