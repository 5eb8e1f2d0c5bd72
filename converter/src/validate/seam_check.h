// Seams of the base mesh: places where it is closed to the eye but not joined, so that its surface
// may come apart when it is refined.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/base_edges.h"
#include "bitstream/base_topology.h"
#include "lattice/lattice_mesh.h"

namespace zerotree::validate {

/// Two boundary edges of a base mesh that lie on each other.
struct BaseSeam {
  /// Numbers of the base edges.
  std::array<std::uint32_t, 2> edges;
  /// Of each edge the vertices at the common first and the common second end.
  std::array<std::array<std::uint32_t, 2>, 2> vertices;
  /// The first face of each edge.
  std::array<std::uint32_t, 2> faces;
};

/// Pairs of boundary edges whose ends have exactly the same `positions` (x, y, z per vertex) and
/// that run in opposite directions along their faces, as the two sides of one edge do. Where more
/// than two boundary edges lie on each other no surface could join them: those are left out, as are
/// edges of no length. In the order of the first edge's number. O(n log n).
std::vector<BaseSeam> find_base_seams(std::span<const bitstream::BaseEdge> edges,
                                      std::span<const float> positions);

/// The vertices of `level` on base edge `edge`, 2^level + 1 of them from its end 0 to its end 1
/// (extension-spec, Numbering); `base` counts those of level 0. The vertices must fit 32 bits.
std::vector<std::uint32_t> vertices_along(std::uint32_t edge, const bitstream::BaseEdge& ends,
                                          const surface::LevelCounts& base, int level);

/// How far the two sides of a seam are apart.
struct SeamGap {
  float distance = 0;
  /// Index of the widest seam.
  std::size_t seam = 0;
};

/// The widest gaps of a surface's seams; seams are told apart by whether they run between two
/// primitives.
struct SeamGaps {
  SeamGap between_primitives, within_primitive;
};

/// Watches the seams of one base mesh in the surfaces of its prefixes.
class SeamCheck {
 public:
  /// `primitive_ends`: of each primitive one beyond its last triangle; empty if there are none.
  /// Keeps 8 bytes per vertex of `level` on a seam.
  SeamCheck(std::span<const bitstream::BaseEdge> edges, const surface::LevelCounts& base,
            std::span<const float> base_positions, std::span<const std::uint64_t> primitive_ends,
            int level);

  const std::vector<BaseSeam>& seams() const { return seams_; }
  /// Whether the seam's sides belong to two primitives.
  bool is_between_primitives(std::size_t seam) const { return between_primitives_[seam]; }
  /// In the surface with these limit positions (x, y, z per vertex) of `level`.
  SeamGaps measure(std::span<const float> limits) const;

 private:
  std::vector<BaseSeam> seams_;
  std::vector<bool> between_primitives_;
  std::size_t points_each_;
  /// Per seam, `points_each_` pairs of vertices that lie on each other in the base.
  std::vector<std::array<std::uint32_t, 2>> pairs_;
};

}  // namespace zerotree::validate
