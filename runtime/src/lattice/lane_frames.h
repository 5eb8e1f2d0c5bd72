// Local frames and normals of several edges or points at once; floats, and doubles in the lanes
// where floats would be too coarse or overflow.
#pragma once

#include <cstddef>

#include "lattice/lanes.h"
#include "surface/detail_weights.h"
#include "surface/edge_frames.h"

namespace zerotree::surface {

/// Two tangents of the surface per lane.
struct LaneTangents {
  LanePoint along, across;
};

inline Vector3 vector_in(const LanePoint& p, std::size_t lane) {
  return {p.x[lane], p.y[lane], p.z[lane]};
}
inline void set_lane(LanePoint& p, std::size_t lane, const Vector3& value) {
  p.x[lane] = static_cast<float>(value[0]);
  p.y[lane] = static_cast<float>(value[1]);
  p.z[lane] = static_cast<float>(value[2]);
}

/// Squared lengths by which a cross product is judged.
struct CrossLengths {
  Lanes first2, second2, cross2;

  LaneMask suffice_as_floats() const {
    return (cross2 > kLeastNormal2) & (cross2 < kLargestNormal2) &
           (cross2 > kLeastSine2 * first2 * second2);
  }
};

/// The unit normals of the first `lanes` lanes, finite and of length 1 whatever the tangents are.
inline LanePoint unit_normals(const LaneTangents& tangents, std::size_t lanes) {
  const auto& [along, across] = tangents;
  LanePoint normal = cross_product(along, across);
  const CrossLengths lengths{dot_product(along, along), dot_product(across, across),
                             dot_product(normal, normal)};
  normal = (1.0f / square_root(lengths.cross2)) * normal;
  const LaneMask good = lengths.suffice_as_floats();
  if (!all_of(good))
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (!good[lane])
        set_lane(normal, lane,
                 frame_from_tangents(vector_in(along, lane), vector_in(across, lane)).normal);
  return normal;
}

/// surface/edge_frames.h of edges with two triangles, and of boundary edges.
inline LaneTangents inner_edge_tangents(const LanePoint& tail, const LanePoint& head,
                                        const LanePoint& left_tail, const LanePoint& left_head,
                                        const LanePoint& right_tail, const LanePoint& right_head) {
  return {2.0f * (head - tail) + (left_head - left_tail) + (right_head - right_tail),
          (left_tail - right_tail) + (left_head - right_head)};
}
inline LaneTangents boundary_edge_tangents(const LanePoint& tail, const LanePoint& head,
                                           const LanePoint& left_tail, const LanePoint& left_head) {
  return {head - tail, (left_tail - tail) + (left_head - head)};
}

/// How the length of a cross product of tangents becomes an area weight: surface/detail_weights.h.
struct AreaScale {
  AreaScale(double share_of_area, double mean)
      : area_share(share_of_area),
        mean_area(mean),
        weight2_per_length(static_cast<float>((1.0 - kMeanAreaShare) * share_of_area / mean)) {}

  double area_share, mean_area;
  float weight2_per_length;
};

/// Moves that floats are too coarse for: of the lanes not `good` with a detail. Zero details move
/// nothing.
inline void settle_moves(const LaneTangents& tangents, const LanePoint& detail,
                         const AreaScale& area, const LaneMask& good, std::size_t lanes,
                         LanePoint& move) {
  const LaneMask zero = (detail.x == 0.0f) & (detail.y == 0.0f) & (detail.z == 0.0f);
  const LaneMask keep = good & ~zero;
  move = {keep ? move.x : Lanes{}, keep ? move.y : Lanes{}, keep ? move.z : Lanes{}};
  if (all_of(good | zero)) return;
  for (std::size_t lane = 0; lane < lanes; ++lane)
    if (!(good[lane] | zero[lane]))
      set_lane(move, lane,
               detail_move({vector_in(tangents.along, lane), vector_in(tangents.across, lane),
                            area.area_share},
                           vector_in(detail, lane), area.mean_area));
}

/// What details (normal, tangent 1, tangent 2) move the odd vertices of the first `lanes` lanes.
/// `is_normal`: all tangential details are zero, as most are.
inline LanePoint detail_moves(const LaneTangents& tangents, const LanePoint& detail, bool is_normal,
                              const AreaScale& area, std::size_t lanes) {
  const auto& [along, across] = tangents;
  const LanePoint normal = cross_product(along, across);
  const CrossLengths lengths{dot_product(along, along), dot_product(across, across),
                             dot_product(normal, normal)};
  const Lanes normal_length = square_root(lengths.cross2);
  const Lanes weight2 =
      area.weight2_per_length * normal_length + static_cast<float>(kMeanAreaShare);
  const auto largest2 = static_cast<float>(kLargestAreaWeight * kLargestAreaWeight);
  const Lanes weight = square_root(weight2 < largest2 ? weight2 : Lanes{} + largest2);

  LanePoint move;
  if (is_normal) {
    move = (detail.x / (normal_length * weight)) * normal;
  } else {
    const Lanes along_length = square_root(lengths.first2);
    const Lanes scale = 1.0f / (normal_length * along_length * weight);
    move = (detail.x * along_length * scale) * normal;
    move += (detail.y * normal_length * scale) * along;
    move += (detail.z * scale) * cross_product(normal, along);
  }
  const LaneMask good = lengths.suffice_as_floats() & (lengths.first2 > 1e-15f) &
                        (lengths.first2 < 1e15f) & (weight2 > 0.0f);
  settle_moves(tangents, detail, area, good, lanes, move);
  return move;
}

/// Loop's limit tangents in a regular, smooth ring, opposite neighbours in pairs: cosines and sines
/// of 60 degrees. Differences lose no digits to the length of the positions.
inline LaneTangents ring_tangents(const LanePoint& a, const LanePoint& b, const LanePoint& c) {
  return {2.0f * a + (b - c), b + c};
}

}  // namespace zerotree::surface
