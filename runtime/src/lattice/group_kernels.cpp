#include "lattice/group_kernels.h"

#include <bit>

#include "lattice/lane_frames.h"
#include "lattice/loop_weights.h"
#include "surface/local_filter.h"

namespace zerotree::surface {

namespace {

LanePoint even_child(const LanePoint* points, const std::array<std::uint32_t, 7>& ring) {
  const LanePoint around = (points[ring[1]] + points[ring[2]]) +
                           (points[ring[3]] + points[ring[4]]) +
                           (points[ring[5]] + points[ring[6]]);
  return kEvenCentre * points[ring[0]] + kEvenRing * around;
}

LanePoint odd_child(const LanePoint* points, const LatticeEdge& edge) {
  return kOddEnd * (points[edge.tail] + points[edge.head]) +
         kOddOpposite * (points[edge.left] + points[edge.right]);
}

/// The details of a group's edges that are parallel to one side, as lengths in the frames of edges
/// that run as the side does.
class SideDetails {
 public:
  SideDetails(const GroupDetails& group, int level, std::size_t side) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      // A lane without a triangle reads what another one reads.
      const GroupDetails::Side seen = group.sides[lane < group.lanes_used ? lane : 0][side];
      seen_from_[lane] = seen.seen_from;
      const std::size_t image = std::size_t{seen.base_edge} << (2 * level);
      for (std::size_t c = 0; c < channels_.size(); ++c) {
        // Seen from side 1 the edge runs the other way: both tangents turn round, the normal does
        // not.
        const bool turns = c != bitstream::kNormal && seen.seen_from == 1;
        channels_[c].units[lane] = group.details->units[c] * (turns ? -0.5f : 0.5f);
        const ChannelValues& values = group.details->channels[c];
        if (values.narrow) channels_[c].narrow[lane] = values.narrow + image;
        if (values.wide) channels_[c].wide[lane] = values.wide + image;
      }
    }
  }

  enum class Found : std::uint8_t { nothing, normal, any };
  /// What the lanes have there.
  Found read(const LatticeEdge& edge, LanePoint& detail) const {
    const LaneIntegers normal = values(channels_[0], edge), first = values(channels_[1], edge),
                       second = values(channels_[2], edge);
    detail = {channels_[0].units * to_floats(normal), channels_[1].units * to_floats(first),
              channels_[2].units * to_floats(second)};
    if (any_of(first | second)) return Found::any;
    return any_of(normal) ? Found::normal : Found::nothing;
  }

 private:
  struct Channel {
    std::array<const std::int16_t*, kLanes> narrow{};
    std::array<const std::int32_t*, kLanes> wide{};
    Lanes units{};
  };

  LaneIntegers values(const Channel& channel, const LatticeEdge& edge) const {
    if (channel.narrow[0]) return values(channel.narrow, edge);
    if (channel.wide[0]) return values(channel.wide, edge);
    return LaneIntegers{};
  }
  template <class Value>
  LaneIntegers values(const std::array<const Value*, kLanes>& images,
                      const LatticeEdge& edge) const {
    static_assert(kLanes == 4);
    return LaneIntegers{images[0][edge.cells[seen_from_[0]]], images[1][edge.cells[seen_from_[1]]],
                        images[2][edge.cells[seen_from_[2]]], images[3][edge.cells[seen_from_[3]]]};
  }

  std::array<Channel, bitstream::kChannelCount> channels_;
  std::array<std::uint32_t, kLanes> seen_from_{};
};

void find_moves(const LatticeLevel& level, const GroupDetails& group, const LanePoint* fine,
                LanePoint* moves) {
  const int number = std::countr_zero(static_cast<unsigned>(level.segments));
  const AreaScale area(kInteriorAreaShare, group.mean_area);
  using Found = SideDetails::Found;
  const auto move_of = [&](const LatticeEdge& edge, const LanePoint& detail, bool is_normal) {
    const auto& wings = edge.wings;
    const LaneTangents tangents =
        inner_edge_tangents(fine[edge.tail], fine[edge.head], fine[wings[0]], fine[wings[1]],
                            fine[wings[2]], fine[wings[3]]);
    return detail_moves(tangents, detail, is_normal, area, group.lanes_used);
  };
  for (std::size_t side = 0; side < 3; ++side) {
    const SideDetails details(group, number, side);
    for (const LatticeEdge& edge : level.edges[side]) {
      LanePoint detail{};
      const Found found = details.read(edge, detail);
      moves[edge.odd - level.point_count] =
          found == Found::nothing ? LanePoint{} : move_of(edge, detail, found == Found::normal);
    }
  }
}

void find_lifts(const LatticeLevel& level, const LatticeLevel& finer, const LanePoint* moves,
                LanePoint* lifts) {
  const float weight = regular_weights().lift;
  const auto move = [&](std::uint32_t odd) -> const LanePoint& {
    return moves[odd - level.point_count];
  };
  for (std::size_t row = 0; row < level.rings.size(); ++row) {
    const auto& ring = finer.rings[row];  // its even points come first, in the coarser order
    lifts[ring[0]] = weight * ((move(ring[1]) + move(ring[2])) + (move(ring[3]) + move(ring[4])) +
                               (move(ring[5]) + move(ring[6])));
  }
  for (std::size_t side = 0; side < 3; ++side) {
    const auto& near = finer.near_points[side];
    for (std::size_t i = 1; i + 1 < level.side_points[side].size(); ++i)
      lifts[level.side_points[side][i]] = weight * (move(near[2 * i - 1]) + move(near[2 * i]));
  }
}

}  // namespace

void subdivide_inside(const LatticeLevel& level, const LanePoint* coarse, LanePoint* fine) {
  for (const auto& ring : level.rings) fine[ring[0]] = even_child(coarse, ring);
  for (const auto& edges : level.edges)
    for (const LatticeEdge& edge : edges) fine[edge.odd] = odd_child(coarse, edge);
}

void move_inside(const LatticeLevel& level, const LatticeLevel& finer, const GroupDetails& group,
                 LanePoint* moves, LanePoint* fine, LanePoint* lifts) {
  find_moves(level, group, fine, moves);
  find_lifts(level, finer, moves, lifts);
  for (const auto& edges : level.edges)
    for (const LatticeEdge& edge : edges) fine[edge.odd] += moves[edge.odd - level.point_count];
}

void lift_inside(const LatticeLevel& level, const LanePoint* lifts, LanePoint* fine) {
  const float dip = regular_weights().dip / regular_weights().lift;
  for (const auto& ring : level.rings)
    fine[ring[0]] -= even_child(lifts, ring) + dip * lifts[ring[0]];
  for (const auto& edges : level.edges)
    for (const LatticeEdge& edge : edges) fine[edge.odd] -= odd_child(lifts, edge);
}

}  // namespace zerotree::surface
