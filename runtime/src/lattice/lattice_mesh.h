// The subdivided base mesh as lattices: which points meet at base edges and vertices, and which
// vertex each point is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "bitstream/base_edges.h"
#include "bitstream/base_topology.h"
#include "lattice/base_fans.h"
#include "lattice/triangle_lattice.h"

namespace zerotree::surface {

/// What a level of the mesh has.
struct LevelCounts {
  std::uint64_t vertices = 0, edges = 0, triangles = 0;
};

/// Of a base with so many vertices, edges and triangles, refined `level` times.
LevelCounts refined_counts(LevelCounts base, int level);

/// Vertices are numbered as OpenSubdiv's uniform refinement does. Costs about a microsecond per
/// base vertex, and per level what triangle_lattices costs.
class LatticeMesh {
 public:
  /// Throws std::invalid_argument if the base is no oriented 2-manifold; see make_loop_refiner.
  LatticeMesh(const bitstream::BaseTopology& base, const std::vector<bitstream::BaseEdge>& edges,
              std::pmr::memory_resource* memory);

  /// Makes levels up to `levels` known.
  void deepen(int levels);
  int levels() const { return static_cast<int>(lattices_.size()) - 1; }

  const LatticeLevel& lattice(int level) const {
    return lattices_[static_cast<std::size_t>(level)];
  }
  const BaseFans& fans() const { return fans_; }
  std::size_t triangle_count() const { return sides_.size(); }
  std::size_t group_count() const;
  /// Triangles of the group that there are; the last group may have fewer than kLanes.
  std::size_t lanes_used(std::size_t group) const;

  /// A side of a base triangle: its strip, and whether the triangle is on its right. Packed, for
  /// there may be millions.
  class Side {
   public:
    Side() = default;
    Side(std::uint32_t strip, bool is_right) : packed_((strip << 1) | (is_right ? 1u : 0u)) {}
    std::uint32_t strip() const { return packed_ >> 1; }
    bool is_right() const { return (packed_ & 1) != 0; }

   private:
    std::uint32_t packed_ = 0;
  };
  const std::array<Side, 3>& sides(std::size_t triangle) const { return sides_[triangle]; }

  /// Vertex of the first point of a run in base triangle `triangle`.
  std::uint32_t first_vertex(const PointRun& run, std::size_t triangle) const {
    return static_cast<std::uint32_t>(refined_counts(counts_, run.born - 1).vertices +
                                      edge_offset(run.born - 1, run.edge_born) +
                                      std::uint64_t{run.count} * triangle);
  }
  /// Vertex of point `i` of a strip at `level`, which is no end of it.
  std::uint32_t strip_vertex(std::uint32_t strip, int level, std::size_t i) const {
    const StripPoint& point = strip_points_[static_cast<std::size_t>(level)][i];
    return point.first + (strip << point.shift);
  }

  /// Vertex of each point of `level` in base triangle `triangle`.
  std::vector<std::uint32_t> vertices_of(int level, std::size_t triangle) const;
  /// Writes the three vertices of each triangle of `level` inside base triangle `triangle`.
  template <class Index>
  void write_triangles(int level, std::size_t triangle, Index* indices) const;

 private:
  /// Vertex of a point on base edge e: first + (e << shift).
  struct StripPoint {
    std::uint32_t first;
    int shift;
  };

  std::vector<StripPoint> strip_points(int level) const;
  std::uint64_t edge_offset(int level, int born) const;

  std::pmr::memory_resource* memory_;
  LevelCounts counts_;
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::vector<std::array<Side, 3>> sides_;
  BaseFans fans_;
  std::vector<LatticeLevel> lattices_;
  std::vector<std::vector<StripPoint>> strip_points_;
};

}  // namespace zerotree::surface
