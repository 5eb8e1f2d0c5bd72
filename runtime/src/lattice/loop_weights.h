// Loop's weights where the lattice is regular. OpenSubdiv's masks have the same; tests compare.
#pragma once

namespace zerotree::surface {

/// Child of a smooth vertex of valence 6, of a vertex on a crease or boundary; and of an edge.
inline constexpr float kEvenCentre = 10.0f / 16, kEvenRing = 1.0f / 16;
inline constexpr float kCurveCentre = 3.0f / 4, kCurveNext = 1.0f / 8;
inline constexpr float kOddEnd = 3.0f / 8, kOddOpposite = 1.0f / 8;
inline constexpr float kCurveEnd = 1.0f / 2;

/// Limit position of such a vertex.
inline constexpr float kLimitCentre = 1.0f / 2, kLimitRing = 1.0f / 12;
inline constexpr float kCurveLimitCentre = 2.0f / 3, kCurveLimitNext = 1.0f / 6;

}  // namespace zerotree::surface
