// OpenSubdiv's Loop weights of one vertex: of its child and of its limit.
#pragma once

#include <opensubdiv/sdc/crease.h>

#include <vector>

namespace zerotree::surface {

/// Weights of a vertex and of its neighbours, these counter-clockwise.
struct FanMask {
  float vertex = 0.0f;
  std::vector<float> edges;
};

/// The fan of a vertex. At a boundary the first and the last edge are the boundary's.
struct Fan {
  bool is_boundary = false;
  std::vector<float> sharpness;  ///< per edge, counter-clockwise
};

/// The fan of a vertex inside a regular, smooth region.
Fan regular_fan();

/// The even vertex of the next finer level. Its rule there is the same.
FanMask child_mask(const Fan& fan, OpenSubdiv::Sdc::Crease::Rule rule);

/// Limit position and tangents; tangent 1 x tangent 2 points outward. Where the surface has several
/// tangent planes the tangents span a mean of them: at a crease the mean of both sides, at a corner
/// that of the control mesh's fan.
struct LimitMasks {
  FanMask position, tangent1, tangent2;
};
LimitMasks limit_masks(const Fan& fan, OpenSubdiv::Sdc::Crease::Rule rule);

}  // namespace zerotree::surface
