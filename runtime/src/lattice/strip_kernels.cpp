#include "lattice/strip_kernels.h"

#include "lattice/loop_weights.h"

namespace zerotree::surface {

namespace {

LanePoint neighbours_of(const StripRows& rows, std::size_t i) {
  return (rows.row.lanes(i + 1) + rows.row.lanes(i - 1)) +
         (rows.left.lanes(i) + rows.left.lanes(i - 1)) +
         (rows.right.lanes(i - 1) + rows.right.lanes(i));
}

LanePoint curve_neighbours_of(const StripRows& rows, std::size_t i) {
  return rows.row.lanes(i + 1) + rows.row.lanes(i - 1);
}

/// The limit tangent across a crease or boundary towards the side with the row `beside`.
LanePoint outward_tangents(const StripRows& rows, const PointRow& beside, std::size_t i) {
  const LanePoint centre = rows.row.lanes(i);
  const LanePoint curve = (rows.row.lanes(i + 1) - centre) + (rows.row.lanes(i - 1) - centre);
  return ((beside.lanes(i) - centre) + (beside.lanes(i - 1) - centre)) - 0.5f * curve;
}

}  // namespace

StripRows gather_rows(const BaseStrip& strip, const LatticeLevel& level,
                      const LatticePoints& points, float* memory) {
  const auto n = static_cast<std::size_t>(level.segments);
  const std::size_t room = PointRow::floats_needed(n + 1 + kLanes);
  StripRows rows{{memory, n + 1 + kLanes},
                 {memory + room, n + 1 + kLanes},
                 {memory + 2 * room, n + 1 + kLanes}};
  const auto& row = level.side_points[strip.sides[0]];
  const auto& left = level.near_points[strip.sides[0]];
  for (std::size_t i = 0; i <= n; ++i) rows.row.set(i, points.get(strip.faces[0], row[i]));
  for (std::size_t i = 0; i < n; ++i) rows.left.set(i, points.get(strip.faces[0], left[i]));
  if (strip.is_boundary()) return rows;
  const auto& right = level.near_points[strip.sides[1]];
  for (std::size_t i = 0; i < n; ++i)
    rows.right.set(i, points.get(strip.faces[1], right[n - 1 - i]));
  return rows;
}

LanePoint even_on_strip(const BaseStrip& strip, const StripRows& rows, std::size_t i) {
  if (strip.is_sharp)
    return kCurveCentre * rows.row.lanes(i) + kCurveNext * curve_neighbours_of(rows, i);
  return kEvenCentre * rows.row.lanes(i) + kEvenRing * neighbours_of(rows, i);
}

LanePoint odd_on_strip(const BaseStrip& strip, const StripRows& rows, std::size_t i) {
  const LanePoint ends = rows.row.lanes(i) + rows.row.lanes(i + 1);
  if (strip.is_sharp) return kCurveEnd * ends;
  return kOddEnd * ends + kOddOpposite * (rows.left.lanes(i) + rows.right.lanes(i));
}

LanePoint moves_on_strip(const BaseStrip& strip, const StripRows& fine, std::size_t i,
                         const LanePoint& detail, const AreaScale& area, std::size_t lanes) {
  const std::size_t k = 2 * i;
  const LanePoint tail = fine.row.every_second(k), head = fine.row.every_second(k + 2);
  const LanePoint left_tail = fine.left.every_second(k), left_head = fine.left.every_second(k + 1);
  if (strip.is_boundary())
    return detail_moves(boundary_edge_tangents(tail, head, left_tail, left_head), detail, false,
                        area, lanes);
  return detail_moves(
      inner_edge_tangents(tail, head, left_tail, left_head, fine.right.every_second(k),
                          fine.right.every_second(k + 1)),
      detail, false, area, lanes);
}

LanePoint limits_on_strip(const BaseStrip& strip, const StripRows& rows, std::size_t i) {
  if (strip.is_sharp)
    return kCurveLimitCentre * rows.row.lanes(i) + kCurveLimitNext * curve_neighbours_of(rows, i);
  return kLimitCentre * rows.row.lanes(i) + kLimitRing * neighbours_of(rows, i);
}

LanePoint normals_on_strip(const BaseStrip& strip, const StripRows& rows, std::size_t i,
                           std::size_t lanes) {
  const LanePoint along = rows.row.lanes(i + 1) - rows.row.lanes(i - 1);
  if (!strip.is_sharp)
    return unit_normals(ring_tangents(along, rows.left.lanes(i) - rows.right.lanes(i - 1),
                                      rows.left.lanes(i - 1) - rows.right.lanes(i)),
                        lanes);
  // Across a crease OpenSubdiv's tangent is the sum of both sides'; at a boundary there is one.
  LanePoint across = outward_tangents(rows, rows.left, i);
  if (!strip.is_boundary()) across -= outward_tangents(rows, rows.right, i);
  return unit_normals({along, across}, lanes);
}

}  // namespace zerotree::surface
