#include "bitstream/sharp_tag_coding.h"

namespace zerotree::bitstream {
namespace {

std::array<std::uint32_t, 2> ascending(const BaseEdge& edge) {
  return {std::min(edge.vertices[0], edge.vertices[1]),
          std::max(edge.vertices[0], edge.vertices[1])};
}

}  // namespace

SharpTagCoding::SharpTagCoding(std::span<const BaseEdge> edges, std::uint32_t vertex_count,
                               std::pmr::memory_resource* resource)
    : edges_(edges),
      creases_at_(vertex_count, 0, resource),
      edges_left_(vertex_count, 0, resource),
      edge_flags_(edges_.size(), 0, resource),
      vertex_flags_(vertex_count, 0, resource) {
  for (const BaseEdge& edge : edges_) {
    if (edge.faces[1] == kNone) continue;
    for (const std::uint32_t v : edge.vertices) ++edges_left_[v];
  }
}

void SharpTagCoding::set_tags(const BaseTopology& base) {
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    edge_flags_[e] =
        std::binary_search(base.crease_edges.begin(), base.crease_edges.end(), ascending(edges_[e]))
            ? 1
            : 0;
  }
  for (const std::uint32_t v : base.corner_vertices) vertex_flags_[v] = 1;
}

void SharpTagCoding::get_tags(BaseTopology& base) const {
  base.crease_edges.clear();
  base.corner_vertices.clear();
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (edge_flags_[e] != 0) base.crease_edges.push_back(ascending(edges_[e]));
  }
  std::sort(base.crease_edges.begin(), base.crease_edges.end());
  for (std::uint32_t v = 0; v < vertex_flags_.size(); ++v) {
    if (vertex_flags_[v] != 0) base.corner_vertices.push_back(v);
  }
}

}  // namespace zerotree::bitstream
