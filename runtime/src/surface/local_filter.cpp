#include "surface/local_filter.h"

#include <cstddef>
#include <cstdint>

namespace zerotree::surface {

namespace {

constexpr EndWeights kSurface = {0.30f, 0.05f};
// A column of P sums to 2 along a curve, not 4, so this has zero mean there too:
// 1 - 2 * 0.30 - 2 * 0.10 * 2.
constexpr EndWeights kCurve = {0.30f, 0.10f};
constexpr EndWeights kUntouched = {0.0f, 0.0f};

}  // namespace

using Rule = OpenSubdiv::Sdc::Crease::Rule;

EndWeights end_weights(Rule rule, int valence, bool edge_is_sharp) {
  if (rule == Rule::RULE_CORNER) return kUntouched;
  if (rule == Rule::RULE_CREASE) return edge_is_sharp ? kCurve : kUntouched;
  const float scale = 6.0f / static_cast<float>(valence);
  return {kSurface.dip * scale, kSurface.lift * scale};
}

EndWeights regular_weights() {
  return kSurface;
}

float dip_per_lift(Rule rule) {
  if (rule == Rule::RULE_CORNER) return 0.0f;
  const EndWeights weights = rule == Rule::RULE_CREASE ? kCurve : kSurface;
  return weights.dip / weights.lift;
}

LocalFilter local_filter(const RefinerLevel& level, const EdgeLevel& edges) {
  LocalFilter filter;
  filter.dips.resize(edges.vertices.size());
  filter.lifts.resize(edges.vertices.size());
  for (std::size_t edge = 0; edge < edges.vertices.size(); ++edge) {
    const bool sharp = is_sharp(level, static_cast<int>(edge));
    for (std::size_t end = 0; end < 2; ++end) {
      const auto vertex = static_cast<int>(edges.vertices[edge][end]);
      const EndWeights weights =
          end_weights(level.GetVertexRule(vertex), level.GetVertexEdges(vertex).size(), sharp);
      filter.dips[edge][end] = weights.dip;
      filter.lifts[edge][end] = weights.lift;
    }
  }
  return filter;
}

}  // namespace zerotree::surface
