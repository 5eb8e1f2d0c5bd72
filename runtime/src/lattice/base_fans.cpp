#include "lattice/base_fans.h"

#include "surface/fan_masks.h"
#include "surface/local_filter.h"
#include "surface/loop_refiner.h"

namespace zerotree::surface {

namespace {

BaseStrip strip_of(const bitstream::BaseEdge& edge, const RefinerLevel& base) {
  BaseStrip strip{};
  strip.left = {edge.faces[0], edge.local[0]};
  strip.right = {edge.faces[1], edge.local[1]};
  strip.vertices = edge.vertices;
  const int number =
      base.FindEdge(static_cast<int>(edge.vertices[0]), static_cast<int>(edge.vertices[1]));
  strip.refiner_edge = static_cast<std::uint32_t>(number);
  strip.is_reversed = base.GetEdgeVertices(number)[0] != static_cast<int>(edge.vertices[0]);
  strip.is_sharp = is_sharp(base, number);
  return strip;
}

Fan fan_of(const RefinerLevel& base, int vertex) {
  Fan fan{base.IsVertexBoundary(vertex), {}};
  for (const int edge : base.GetVertexEdges(vertex))
    fan.sharpness.push_back(base.GetEdgeSharpness(edge));
  return fan;
}

}  // namespace

BaseFans::BaseFans(const bitstream::BaseTopology& topology,
                   const std::vector<bitstream::BaseEdge>& edges, std::pmr::memory_resource* memory)
    : strips_(memory),
      vertex_weights_(memory),
      dips_per_lift_(memory),
      spoke_begin_(memory),
      corner_begin_(memory),
      spokes_(memory),
      spoke_weights_(memory),
      corners_(memory) {
  const auto refiner = make_loop_refiner(topology, edges, 0);
  const RefinerLevel& base = refiner->GetLevel(0);
  strips_.reserve(edges.size());
  for (const bitstream::BaseEdge& edge : edges) strips_.push_back(strip_of(edge, base));
  std::vector<std::uint32_t> strip_of_edge(strips_.size());
  for (std::uint32_t strip = 0; strip < strips_.size(); ++strip)
    strip_of_edge[strips_[strip].refiner_edge] = strip;

  const std::size_t vertices = topology.vertex_count;
  vertex_weights_.reserve(vertices);
  dips_per_lift_.reserve(vertices);
  spoke_begin_.reserve(vertices + 1);
  corner_begin_.reserve(vertices + 1);
  spokes_.reserve(2 * strips_.size());
  spoke_weights_.reserve(2 * strips_.size());
  corners_.reserve(3 * topology.triangles.size());
  for (int vertex = 0; vertex < base.GetNumVertices(); ++vertex) {
    const Fan fan = fan_of(base, vertex);
    const auto rule = base.GetVertexRule(vertex);
    const FanMask child = child_mask(fan, rule);
    const LimitMasks limit = limit_masks(fan, rule);
    vertex_weights_.push_back(
        {child.vertex, limit.position.vertex, limit.tangent1.vertex, limit.tangent2.vertex, 0.0f});
    dips_per_lift_.push_back(dip_per_lift(rule));
    spoke_begin_.push_back(static_cast<std::uint32_t>(spokes_.size()));
    const auto around = base.GetVertexEdges(vertex);
    for (int k = 0; k < around.size(); ++k) {
      const std::uint32_t strip = strip_of_edge[static_cast<std::size_t>(around[k])];
      const auto spoke = static_cast<std::size_t>(k);
      spokes_.push_back({strip, strips_[strip].vertices[1] == static_cast<std::uint32_t>(vertex)});
      spoke_weights_.push_back({child.edges[spoke], limit.position.edges[spoke],
                                limit.tangent1.edges[spoke], limit.tangent2.edges[spoke],
                                end_weights(rule, around.size(), strips_[strip].is_sharp).lift});
    }
    corner_begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
    const auto faces = base.GetVertexFaces(vertex);
    const auto locals = base.GetVertexFaceLocalIndices(vertex);
    for (int k = 0; k < faces.size(); ++k)
      corners_.push_back(
          {static_cast<std::uint32_t>(faces[k]), static_cast<std::uint32_t>(locals[k])});
  }
  spoke_begin_.push_back(static_cast<std::uint32_t>(spokes_.size()));
  corner_begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
}

BaseFans::View BaseFans::fan(std::size_t vertex) const {
  const std::size_t first = spoke_begin_[vertex], count = spoke_begin_[vertex + 1] - first;
  const std::size_t corner = corner_begin_[vertex];
  return {vertex_weights_[vertex], dips_per_lift_[vertex], std::span(spokes_).subspan(first, count),
          std::span(spoke_weights_).subspan(first, count),
          std::span(corners_).subspan(corner, corner_begin_[vertex + 1] - corner)};
}

}  // namespace zerotree::surface
