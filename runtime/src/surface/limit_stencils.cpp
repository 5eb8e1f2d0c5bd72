#include "surface/limit_stencils.h"

#include <opensubdiv/sdc/loopScheme.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace zerotree::surface {

namespace Sdc = OpenSubdiv::Sdc;

namespace {

/// The weights of one vertex and its fan, in the form OpenSubdiv writes them.
class FanMask {
 public:
  using Weight = float;
  void SetNumVertexWeights(int) {}
  void SetNumEdgeWeights(int count) { edges.assign(static_cast<std::size_t>(count), 0.0f); }
  void SetNumFaceWeights(int) {}
  void SetFaceWeightsForFaceCenters(bool) {}
  Weight& VertexWeight(int) { return vertex; }
  Weight& EdgeWeight(int edge) { return edges[static_cast<std::size_t>(edge)]; }

  Weight vertex = 0.0f;
  std::vector<Weight> edges;
};

/// The fan of a vertex in the form OpenSubdiv reads it.
struct Fan {
  int GetNumEdges() const { return static_cast<int>(sharpness.size()); }
  int GetNumFaces() const { return GetNumEdges() - (is_boundary ? 1 : 0); }
  float* GetSharpnessPerEdge(float* buffer) const {
    std::copy(sharpness.begin(), sharpness.end(), buffer);
    return buffer;
  }

  bool is_boundary = false;
  std::vector<float> sharpness;  ///< per edge, counter-clockwise
};

struct LimitMasks {
  FanMask position, tangent1, tangent2;
};

LimitMasks masks_by_rule(const Fan& fan, Sdc::Crease::Rule rule) {
  LimitMasks masks;
  const Sdc::Scheme<Sdc::SCHEME_LOOP> loop;
  loop.ComputeVertexLimitMask(fan, masks.position, masks.tangent1, masks.tangent2, rule);
  return masks;
}

/// OpenSubdiv gives the tangents of the first side of an interior crease. Both sides share the
/// tangent along the crease, so the sum of both cross products is a cross product again.
LimitMasks interior_crease_masks(const Fan& fan) {
  LimitMasks masks = masks_by_rule(fan, Sdc::Crease::RULE_CREASE);
  const auto is_sharp_edge = [](float sharpness) { return sharpness > 0.0f; };
  const auto second_end =
      std::find_if(fan.sharpness.rbegin(), fan.sharpness.rend(), is_sharp_edge).base() - 1;
  const auto turn = second_end - fan.sharpness.begin();
  Fan turned = fan;
  std::rotate(turned.sharpness.begin(), turned.sharpness.begin() + turn, turned.sharpness.end());
  LimitMasks beyond = masks_by_rule(turned, Sdc::Crease::RULE_CREASE);
  auto& back = beyond.tangent2.edges;
  std::rotate(back.begin(), back.end() - turn, back.end());
  masks.tangent2.vertex -= beyond.tangent2.vertex;
  for (std::size_t k = 0; k < back.size(); ++k) masks.tangent2.edges[k] -= back[k];
  return masks;
}

LimitMasks corner_masks(const Fan& fan) {
  LimitMasks masks;
  if (fan.is_boundary) {
    // The whole fan's tangents instead of those of its first face.
    Fan half_disk = fan;
    std::fill(half_disk.sharpness.begin(), half_disk.sharpness.end(), 0.0f);
    half_disk.sharpness.front() = half_disk.sharpness.back() = Sdc::Crease::SHARPNESS_INFINITE;
    masks = masks_by_rule(half_disk, Sdc::Crease::RULE_CREASE);
  } else {
    masks = masks_by_rule(fan, Sdc::Crease::RULE_SMOOTH);
  }
  masks.position.vertex = 1.0f;
  std::fill(masks.position.edges.begin(), masks.position.edges.end(), 0.0f);
  return masks;
}

LimitMasks masks_of(const Fan& fan, Sdc::Crease::Rule rule) {
  if (rule == Sdc::Crease::RULE_CORNER) return corner_masks(fan);
  if (rule == Sdc::Crease::RULE_CREASE && !fan.is_boundary) return interior_crease_masks(fan);
  return masks_by_rule(fan, rule);
}

}  // namespace

SharedStencils limit_stencils(const RefinerLevel& level) {
  SharedStencilBuilder builder;
  builder.reserve(static_cast<std::size_t>(level.GetNumVertices()), 7);
  std::vector<std::uint32_t> ring;
  std::vector<float> weights;
  Fan fan;
  const LimitMasks regular = [] {
    const Fan six{false, std::vector<float>(6, 0.0f)};
    return masks_by_rule(six, Sdc::Crease::RULE_SMOOTH);
  }();
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
    const Sdc::Crease::Rule rule = level.GetVertexRule(vertex);
    const bool is_regular = rule == Sdc::Crease::RULE_SMOOTH && edges.size() == 6;
    const LimitMasks irregular = is_regular ? LimitMasks{} : masks_of(fan, rule);
    const LimitMasks& masks = is_regular ? regular : irregular;
    weights.clear();
    for (const FanMask* mask : {&masks.position, &masks.tangent1, &masks.tangent2}) {
      weights.push_back(mask->vertex);
      weights.insert(weights.end(), mask->edges.begin(), mask->edges.end());
      weights.resize(weights.size() + edges.size() - mask->edges.size(), 0.0f);
    }
    builder.add_row(ring, weights);
  }
  return builder.take();
}

}  // namespace zerotree::surface
