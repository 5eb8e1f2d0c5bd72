#include "lattice/lattice_mesh.h"

#include <algorithm>

#include "lattice/lanes.h"

namespace zerotree::surface {

LevelCounts refined_counts(LevelCounts counts, int level) {
  for (int number = 0; number < level; ++number)
    counts = {counts.vertices + counts.edges, 2 * counts.edges + 3 * counts.triangles,
              4 * counts.triangles};
  return counts;
}

LatticeMesh::LatticeMesh(const bitstream::BaseTopology& base,
                         const std::vector<bitstream::BaseEdge>& edges,
                         std::pmr::memory_resource* memory)
    : memory_(memory),
      counts_{base.vertex_count, edges.size(), base.triangles.size()},
      corners_(base.triangles.begin(), base.triangles.end()),
      sides_(base.triangles.size()),
      fans_(base, edges, memory) {
  for (std::uint32_t strip = 0; strip < fans_.strips().size(); ++strip) {
    const BaseStrip& s = fans_.strips()[strip];
    sides_[s.faces[0]][s.sides[0]] = {strip, false};
    if (!s.is_boundary()) sides_[s.faces[1]][s.sides[1]] = {strip, true};
  }
}

void LatticeMesh::deepen(int levels) {
  if (levels <= this->levels()) return;
  for (int level = static_cast<int>(strip_points_.size()); level <= levels; ++level)
    strip_points_.push_back(strip_points(level));
  lattices_ = triangle_lattices(levels, memory_);  // last: they tell what is known
}

std::size_t LatticeMesh::group_count() const {
  return (sides_.size() + kLanes - 1) / kLanes;
}

std::size_t LatticeMesh::lanes_used(std::size_t group) const {
  return std::min(kLanes, sides_.size() - group * kLanes);
}

// At each level the edges inside the coarser triangles come first, then the halves of the coarser
// edges: where the descendants of the edges born at level `born` begin.
std::uint64_t LatticeMesh::edge_offset(int level, int born) const {
  std::uint64_t offset = 0;
  for (int number = born; number < level; ++number)
    offset = 2 * offset + 3 * (counts_.triangles << (2 * number));
  return offset;
}

std::vector<LatticeMesh::StripPoint> LatticeMesh::strip_points(int level) const {
  const EdgePoints places = edge_points(level);
  std::vector<StripPoint> points(places.born.size());
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const int shift = places.born[i] - 1;
    points[i].first = static_cast<std::uint32_t>(refined_counts(counts_, shift).vertices +
                                                 edge_offset(shift, 0) + places.number[i]);
    points[i].shift = shift;
  }
  return points;
}

std::vector<std::uint32_t> LatticeMesh::vertices_of(int level, std::size_t triangle) const {
  const LatticeLevel& points = lattice(level);
  std::vector<std::uint32_t> vertices(points.point_count);
  for (const PointRun& run : points.runs) {
    auto vertex = static_cast<std::uint32_t>(first_vertex(run, triangle));
    for (std::uint32_t point = run.first; point < run.first + run.count; ++point)
      vertices[point] = vertex++;
  }
  const auto n = static_cast<std::size_t>(points.segments);
  for (std::size_t side = 0; side < 3; ++side) {
    const Side seen = sides_[triangle][side];
    for (std::size_t i = 1; i < n; ++i)
      vertices[points.side_points[side][i]] =
          strip_vertex(seen.strip(), level, seen.is_right() ? n - i : i);
    vertices[points.side_points[side][0]] = corners_[triangle][side];
  }
  return vertices;
}

template <class Index>
void LatticeMesh::write_triangles(int level, std::size_t triangle, Index* indices) const {
  const std::vector<std::uint32_t> vertices = vertices_of(level, triangle);
  for (const auto& corners : lattice(level).triangles)
    for (const std::uint32_t point : corners) *indices++ = static_cast<Index>(vertices[point]);
}

template void LatticeMesh::write_triangles(int, std::size_t, std::uint16_t*) const;
template void LatticeMesh::write_triangles(int, std::size_t, std::uint32_t*) const;

}  // namespace zerotree::surface
