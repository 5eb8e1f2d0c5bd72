// Synthesis along base edges: the points on one base edge, from the rows beside it, kLanes of them
// at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "lattice/base_fans.h"
#include "lattice/lane_frames.h"
#include "lattice/lattice_points.h"
#include "lattice/level_details.h"
#include "lattice/triangle_lattice.h"

namespace zerotree::surface {

/// Points in a row, coordinate by coordinate: x of all, y of all, z of all.
class PointRow {
 public:
  PointRow() = default;
  /// Uses `floats_needed` floats of `memory`.
  PointRow(float* memory, std::size_t points) : x_(memory), stride_(points + kLanes) {}
  static std::size_t floats_needed(std::size_t points) { return 3 * (points + kLanes); }

  PointF operator[](std::size_t i) const { return {x_[i], x_[stride_ + i], x_[2 * stride_ + i]}; }
  void set(std::size_t i, const PointF& p) {
    x_[i] = p.x;
    x_[stride_ + i] = p.y;
    x_[2 * stride_ + i] = p.z;
  }
  /// Points i .. i + kLanes - 1; those beyond the row's end are of no meaning.
  LanePoint lanes(std::size_t i) const {
    return {load(i), load(stride_ + i), load(2 * stride_ + i)};
  }
  /// Points i, i + 2, .. i + 2 kLanes - 2.
  LanePoint every_second(std::size_t i) const {
    const auto pick = [&](std::size_t at) {
      return Lanes{x_[at], x_[at + 2], x_[at + 4], x_[at + 6]};
    };
    return {pick(i), pick(stride_ + i), pick(2 * stride_ + i)};
  }

 private:
  Lanes load(std::size_t i) const {
    Lanes values;
    std::memcpy(&values, x_ + i, sizeof values);
    return values;
  }

  float* x_ = nullptr;
  std::size_t stride_ = 0;
};

/// The points on a strip of n segments in its direction, its ends included, and the n points beside
/// its segments to the left and to the right.
struct StripRows {
  PointRow row, left, right;
  static std::size_t floats_needed(const LatticeLevel& level) {
    const auto n = static_cast<std::size_t>(level.segments);
    return 3 * PointRow::floats_needed(n + 1 + kLanes);
  }
};
/// Copies the rows of `points` at `level` to `memory`. Right of a boundary there is nothing.
StripRows gather_rows(const BaseStrip& strip, const LatticeLevel& level,
                      const LatticePoints& points, float* memory);

/// Writes point `i` of the strip into the lattices on both sides.
inline void set_on_strip(const BaseStrip& strip, const LatticeLevel& level, std::size_t i,
                         const PointF& value, LatticePoints& points) {
  points.set(strip.faces[0], level.side_points[strip.sides[0]][i], value);
  if (strip.is_boundary()) return;
  const auto n = static_cast<std::size_t>(level.segments);
  points.set(strip.faces[1], level.side_points[strip.sides[1]][n - i], value);
}

/// The children from point i on, which is no end, and of the segments from i on.
LanePoint even_on_strip(const BaseStrip& strip, const StripRows& rows, std::size_t i);
LanePoint odd_on_strip(const BaseStrip& strip, const StripRows& rows, std::size_t i);

/// What details of `lanes` segments from `i` on move their odd points. `fine` are the rows of the
/// finer level before any detail.
LanePoint moves_on_strip(const BaseStrip& strip, const StripRows& fine, std::size_t i,
                         const LanePoint& detail, const AreaScale& area, std::size_t lanes);

/// Limit positions from point `i` on, which is no end, and unit normals of `lanes` of them.
LanePoint limits_on_strip(const BaseStrip& strip, const StripRows& rows, std::size_t i);
LanePoint normals_on_strip(const BaseStrip& strip, const StripRows& rows, std::size_t i,
                           std::size_t lanes);

}  // namespace zerotree::surface
