// How large a quantised detail is: basis norms, area weights and the step.
//
// One threshold serves all levels and places if a detail's integer is proportional to the error it
// makes in the surface, so a detail is divided by its basis function's L2 norm and by the square
// root of the area it acts on before it is compared with the step. Encoder and decoder call this.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/base_topology.h"
#include "bitstream/coefficient_layout.h"
#include "surface/edge_frames.h"

namespace zerotree::surface {

/// What a stream says about the size of its integers.
struct Dequantisation {
  /// Finest quantisation step of a normal detail of basis norm and area weight 1, in the unit of
  /// the control points.
  float step = 1.0f;
  /// Step of the tangential details in units of `step`.
  float tangent_ratio = 4.0f;
};

/// L2 norm of a detail's basis function, `levels_above_finest` (>= 0) levels above the finest
/// details, relative to that of the finest: it is the same function, twice as wide per level.
constexpr float basis_norm(int levels_above_finest) {
  float norm = 1.0f;
  for (int level = 0; level < levels_above_finest; ++level) norm *= 2.0f;
  return norm;
}

/// Of the area weight: see area_weight.
inline constexpr double kMeanAreaShare = 0.2;
inline constexpr double kLargestAreaWeight = 16.0;

/// Mean area of the flat triangles of a base mesh; `positions` holds x, y, z of each vertex.
double mean_face_area(const bitstream::BaseTopology& topology, std::span<const float> positions);

/// The weight of a detail whose edge has triangles of `area` where the level's mean is `mean_area`:
/// sqrt(0.8 area / mean_area + 0.2), at most 16; 1 if that is no number. The share of the mean
/// keeps a detail in its place while a prefix shows a triangle smaller than it will be.
float area_weight(double area, double mean_area);

/// What `detail` (normal, tangent 1, tangent 2; of area weight 1) moves its odd vertex, x, y, z,
/// where the coarser surface has these tangents.
Vector3 detail_move(const EdgeTangents& tangents, const Vector3& detail, double mean_area);

/// What a value of 2 in a `CoefficientSet` is worth: the length of the detail component of
/// `channel` at `level` (0 .. levels - 1) where the area weight is 1. A value v of weight w stands
/// for v / 2 times this length over w.
float detail_unit(const Dequantisation& dequantisation, int levels, int level,
                  bitstream::Channel channel);

}  // namespace zerotree::surface
