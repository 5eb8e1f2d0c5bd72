#include "surface/limit_stencils.h"

#include <cstdint>
#include <vector>

#include "surface/fan_masks.h"

namespace zerotree::surface {

SharedStencils limit_stencils(const RefinerLevel& level) {
  SharedStencilBuilder builder;
  builder.reserve(static_cast<std::size_t>(level.GetNumVertices()), 7);
  std::vector<std::uint32_t> ring;
  std::vector<float> weights;
  Fan fan;
  using Rule = OpenSubdiv::Sdc::Crease::Rule;
  const LimitMasks regular = limit_masks(regular_fan(), Rule::RULE_SMOOTH);
  for (int vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
    const auto edges = level.GetVertexEdges(vertex);
    ring.assign(1, static_cast<std::uint32_t>(vertex));
    fan.sharpness.clear();
    fan.is_boundary = level.IsVertexBoundary(vertex);
    for (const int edge : edges) {
      const auto ends = level.GetEdgeVertices(edge);
      ring.push_back(static_cast<std::uint32_t>(ends[0] == vertex ? ends[1] : ends[0]));
      fan.sharpness.push_back(level.GetEdgeSharpness(edge));
    }
    const Rule rule = level.GetVertexRule(vertex);
    const bool is_regular = rule == Rule::RULE_SMOOTH && edges.size() == 6;
    const LimitMasks irregular = is_regular ? LimitMasks{} : limit_masks(fan, rule);
    const LimitMasks& masks = is_regular ? regular : irregular;
    weights.clear();
    for (const FanMask* mask : {&masks.position, &masks.tangent1, &masks.tangent2}) {
      weights.push_back(mask->vertex);
      weights.insert(weights.end(), mask->edges.begin(), mask->edges.end());
    }
    builder.add_row(ring, weights);
  }
  return builder.take();
}

}  // namespace zerotree::surface
