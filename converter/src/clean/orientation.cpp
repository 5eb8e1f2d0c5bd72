#include "clean/orientation.h"

#include <Eigen/Geometry>
#include <numeric>

#include "clean/half_edges.h"

namespace zerotree::clean {
namespace {

// What is known of a set of connected faces, kept at its root.
struct FaceSet {
  std::uint64_t faces = 0;
  std::uint64_t against_majority = 0;
  double volume = 0;
  bool closed = true;
  bool turn = false;
};

double signed_volume(const WorkingMesh& mesh, std::size_t face, const Eigen::Vector3d& origin) {
  const Triangle& t = mesh.triangles[face];
  const Eigen::Vector3d a = mesh.positions[t[0]] - origin, b = mesh.positions[t[1]] - origin,
                        c = mesh.positions[t[2]] - origin;
  return a.dot(b.cross(c)) / 6.0;
}

std::vector<FaceSet> measure_sets(const WorkingMesh& mesh, OrientationForest& forest,
                                  const std::vector<std::uint32_t>& mates,
                                  const std::vector<std::uint8_t>& turned) {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // near the mesh, so that little cancels
  for (const Eigen::Vector3d& p : mesh.positions)
    origin += p / static_cast<double>(mesh.positions.size());
  std::vector<FaceSet> sets(mesh.triangles.size());
  for (std::uint32_t f = 0; f < sets.size(); ++f) {
    FaceSet& set = sets[forest.find(f).first];
    ++set.faces;
    set.against_majority += turned[f];
    const double volume = signed_volume(mesh, f, origin);
    set.volume += turned[f] != 0 ? -volume : volume;
    for (std::uint32_t k = 0; k < 3; ++k) set.closed &= mates[3 * f + k] != no_half_edge;
  }
  return sets;
}

// Sets whose orientation the file leaves open get their outside outside; a mesh of mostly closed
// sets that is inside out as a whole is turned as a whole, so that cavities stay cavities.
void decide_by_volume(std::vector<FaceSet>& sets, std::size_t face_count) {
  std::uint64_t closed_faces = 0;
  double closed_volume = 0;
  for (FaceSet& set : sets) {
    if (!set.closed || set.faces == 0) continue;
    if (set.against_majority > 0 && set.volume < 0) {
      set.turn = true;
      set.volume = -set.volume;
    }
    closed_faces += set.faces;
    closed_volume += set.volume;
  }
  if (closed_volume < 0 && 2 * closed_faces > face_count)
    for (FaceSet& set : sets)
      if (set.closed) set.turn = !set.turn;
}

// Turning a face exchanges its first and last half-edge.
std::uint32_t renumbered(std::uint32_t h, const std::vector<std::uint8_t>& turned) {
  return turned[h / 3] != 0 ? h - h % 3 + (2 - h % 3) : h;
}

void turn_faces(WorkingMesh& mesh, const std::vector<std::uint8_t>& turned,
                std::vector<std::uint32_t>& mates) {
  for (std::size_t f = 0; f < turned.size(); ++f) {
    if (turned[f] == 0) continue;
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
    std::swap(mates[3 * f], mates[3 * f + 2]);
  }
  for (std::uint32_t& mate : mates)
    if (mate != no_half_edge) mate = renumbered(mate, turned);
}

}  // namespace

OrientationForest::OrientationForest(std::size_t face_count)
    : parent_(face_count), turned_(face_count, 0) {
  std::iota(parent_.begin(), parent_.end(), 0u);
}

std::pair<std::uint32_t, bool> OrientationForest::find(std::uint32_t face) {
  std::uint32_t root = face;
  std::uint8_t turned = 0;
  while (parent_[root] != root) {
    turned ^= turned_[root];
    root = parent_[root];
  }
  // Second walk: everything on the way hangs under the root.
  std::uint8_t left = turned;
  while (parent_[face] != face) {
    const std::uint32_t up = parent_[face];
    const std::uint8_t own = turned_[face];
    parent_[face] = root;
    turned_[face] = left;
    left ^= own;
    face = up;
  }
  return {root, turned != 0};
}

bool OrientationForest::unite(std::uint32_t a, std::uint32_t b, bool turned) {
  auto [root_a, turned_a] = find(a);
  auto [root_b, turned_b] = find(b);
  const bool between_roots = turned != (turned_a != turned_b);
  if (root_a == root_b) return !between_roots;
  if (root_b < root_a) std::swap(root_a, root_b);
  parent_[root_b] = root_a;
  turned_[root_b] = between_roots ? 1 : 0;
  return true;
}

std::vector<std::uint8_t> turn_to_majority(OrientationForest& forest, std::size_t face_count) {
  std::vector<std::int64_t> balance(face_count, 0);
  std::vector<std::uint8_t> turned(face_count);
  for (std::uint32_t f = 0; f < face_count; ++f) {
    const auto [root, against_root] = forest.find(f);
    turned[f] = against_root ? 1 : 0;
    balance[root] += against_root ? 1 : -1;
  }
  for (std::uint32_t f = 0; f < face_count; ++f)
    if (balance[forest.find(f).first] > 0) turned[f] ^= 1;
  return turned;
}

OrientationCounts orient_faces(WorkingMesh& mesh, OrientationForest& forest,
                               std::vector<std::uint32_t>& mates) {
  std::vector<std::uint8_t> turned = turn_to_majority(forest, mesh.triangles.size());
  std::vector<FaceSet> sets = measure_sets(mesh, forest, mates, turned);
  decide_by_volume(sets, mesh.triangles.size());
  OrientationCounts counts;
  for (const FaceSet& set : sets) {
    counts.turned_faces += set.against_majority;
    counts.turned_components += set.turn && set.faces > 0;
  }
  for (std::uint32_t f = 0; f < turned.size(); ++f)
    if (sets[forest.find(f).first].turn) turned[f] ^= 1;
  turn_faces(mesh, turned, mates);
  return counts;
}

}  // namespace zerotree::clean
