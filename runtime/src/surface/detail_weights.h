// How large a quantised detail is: basis norms, area weights and the step.
//
// One threshold serves all levels and places if a detail's integer is proportional to the error it
// makes in the surface, so a detail is divided by its basis function's L2 norm and by the square
// root of the area it acts on before it is compared with the step. Encoder and decoder call this.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/base_topology.h"
#include "bitstream/coefficient_layout.h"
#include "surface/wavelet_transform.h"

namespace zerotree::surface {

/// What a stream says about the size of its integers.
struct Dequantisation {
  WaveletTransform transform = WaveletTransform::loop_quadrature_mirror;
  /// Finest quantisation step of a normal detail of basis norm and edge weight 1, in the unit of
  /// the control points.
  float step = 1.0f;
  /// Step of the tangential details in units of `step`.
  float tangent_ratio = 4.0f;
};

/// L2 norm of the basis function of a unit detail, `levels_above_finest` levels above the finest
/// details (those of level J - 1 have 0), relative to that of the finest. From 6 on it doubles
/// per level. Throws nothing; a negative argument counts as 0.
float basis_norm(WaveletTransform transform, int levels_above_finest);

/// Per base edge the square root of (mean area of its one or two base faces / mean area of all
/// base faces), held within 1/8 .. 8 so that a degenerate base stays finite.
/// `base_positions` holds x, y, z of each base vertex.
std::vector<float> base_edge_weights(const bitstream::BaseTopology& topology,
                                     const std::vector<bitstream::BaseEdge>& base_edges,
                                     std::span<const float> base_positions);

/// What a value of 2 in a `CoefficientSet` is worth: the length of the detail component of
/// `channel` at `level` (0 .. levels - 1) below a base edge of weight `edge_weight`. A value v
/// stands for v / 2 times this length.
float detail_unit(const Dequantisation& dequantisation, int levels, int level,
                  bitstream::Channel channel, float edge_weight);

}  // namespace zerotree::surface
