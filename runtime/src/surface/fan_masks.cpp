#include "surface/fan_masks.h"

#include <opensubdiv/sdc/loopScheme.h>

#include <algorithm>

namespace zerotree::surface {

namespace Sdc = OpenSubdiv::Sdc;

namespace {

/// A mask in the form OpenSubdiv writes it.
class WrittenMask {
 public:
  using Weight = float;
  explicit WrittenMask(FanMask& mask) : mask_(mask) {}
  void SetNumVertexWeights(int) {}
  void SetNumEdgeWeights(int count) { mask_.edges.assign(static_cast<std::size_t>(count), 0.0f); }
  void SetNumFaceWeights(int) {}
  void SetFaceWeightsForFaceCenters(bool) {}
  Weight& VertexWeight(int) { return mask_.vertex; }
  Weight& EdgeWeight(int edge) { return mask_.edges[static_cast<std::size_t>(edge)]; }
  Weight& FaceWeight(int) { return unused_; }
  int GetNumEdgeWeights() const { return static_cast<int>(mask_.edges.size()); }
  int GetNumFaceWeights() const { return 0; }
  bool AreFaceWeightsForFaceCenters() const { return false; }

 private:
  FanMask& mask_;
  float unused_ = 0.0f;
};

/// A fan in the form OpenSubdiv reads it.
struct ReadFan {
  int GetNumEdges() const { return static_cast<int>(fan.sharpness.size()); }
  int GetNumFaces() const { return GetNumEdges() - (fan.is_boundary ? 1 : 0); }
  float GetSharpness() const { return 0.0f; }
  float* GetSharpnessPerEdge(float* buffer) const {
    std::copy(fan.sharpness.begin(), fan.sharpness.end(), buffer);
    return buffer;
  }
  float* GetChildSharpnessPerEdge(const Sdc::Crease&, float* buffer) const {
    return GetSharpnessPerEdge(buffer);
  }
  float GetChildSharpness(const Sdc::Crease&) const { return 0.0f; }

  const Fan& fan;
};

LimitMasks masks_by_rule(const Fan& fan, Sdc::Crease::Rule rule) {
  LimitMasks masks;
  WrittenMask position(masks.position), tangent1(masks.tangent1), tangent2(masks.tangent2);
  const Sdc::Scheme<Sdc::SCHEME_LOOP> loop;
  loop.ComputeVertexLimitMask(ReadFan{fan}, position, tangent1, tangent2, rule);
  // OpenSubdiv leaves out the neighbours of a corner.
  for (FanMask* mask : {&masks.position, &masks.tangent1, &masks.tangent2})
    mask->edges.resize(fan.sharpness.size(), 0.0f);
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

}  // namespace

Fan regular_fan() {
  return {false, std::vector<float>(6, 0.0f)};
}

FanMask child_mask(const Fan& fan, Sdc::Crease::Rule rule) {
  FanMask mask;
  WrittenMask written(mask);
  const Sdc::Scheme<Sdc::SCHEME_LOOP> loop;
  loop.ComputeVertexVertexMask(ReadFan{fan}, written, rule, rule);
  mask.edges.resize(fan.sharpness.size(), 0.0f);
  return mask;
}

LimitMasks limit_masks(const Fan& fan, Sdc::Crease::Rule rule) {
  if (rule == Sdc::Crease::RULE_CORNER) return corner_masks(fan);
  if (rule == Sdc::Crease::RULE_CREASE && !fan.is_boundary) return interior_crease_masks(fan);
  return masks_by_rule(fan, rule);
}

}  // namespace zerotree::surface
