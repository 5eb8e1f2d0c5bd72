#include "lattice/group_limit.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "lattice/lane_frames.h"
#include "lattice/loop_weights.h"

namespace zerotree::surface {

namespace {

using Ring = std::array<std::uint32_t, 7>;

struct PositionWeights {
  explicit PositionWeights(float outward)
      : centre(outward + (1.0f - outward) * kLimitCentre), ring((1.0f - outward) * kLimitRing) {}
  float centre, ring;
};

LanePoint limit_position(const LanePoint* points, const Ring& ring,
                         const PositionWeights& weights) {
  const LanePoint around = (points[ring[1]] + points[ring[2]]) +
                           (points[ring[3]] + points[ring[4]]) +
                           (points[ring[5]] + points[ring[6]]);
  return weights.centre * points[ring[0]] + weights.ring * around;
}

LaneTangents limit_tangents(const LanePoint* points, const Ring& ring) {
  return ring_tangents(points[ring[1]] - points[ring[4]], points[ring[2]] - points[ring[5]],
                       points[ring[3]] - points[ring[6]]);
}

// Points at a time: computed for all lanes, then written lane by lane.
constexpr std::size_t kBlock = 16;
using Block = std::array<std::array<Lanes, kBlock>, kLanes>;  // x, y, z of each point, lane by lane

void put(const LanePoint& point, std::size_t i, Block& block) {
  const auto lanes = by_lane(point);
  for (std::size_t lane = 0; lane < kLanes; ++lane) block[lane][i] = lanes[lane];
}

void write_lane(const std::array<Lanes, kBlock>& points, std::size_t count,
                std::size_t first_vertex, const StridedVectors& target) {
  for (std::size_t i = 0; i < count; ++i) target.write(first_vertex + i, &points[i]);
}

}  // namespace

void write_limits_inside(const LatticeMesh& mesh, int level, std::size_t group,
                         const LanePoint* points, const LimitOutput& output) {
  const LatticeLevel& lattice = mesh.lattice(level);
  const std::size_t lanes = mesh.lanes_used(group);
  std::span<const Ring> rings = lattice.rings;
  const PositionWeights weights(output.outward);
  Block positions, normals;
  for (const PointRun& run : lattice.runs) {
    std::array<std::size_t, kLanes> first_vertex{};
    for (std::size_t lane = 0; lane < lanes; ++lane)
      first_vertex[lane] = mesh.first_vertex(run, group * kLanes + lane);
    for (std::size_t done = 0; done < run.count; done += kBlock) {
      const std::size_t count = std::min(kBlock, run.count - done);
      if (output.positions.data)
        for (std::size_t i = 0; i < count; ++i)
          put(limit_position(points, rings[i], weights), i, positions);
      if (output.normals.data)
        for (std::size_t i = 0; i < count; ++i)
          put(unit_normals(limit_tangents(points, rings[i]), lanes), i, normals);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::size_t first = first_vertex[lane] + done;
        if (output.positions.data) write_lane(positions[lane], count, first, output.positions);
        if (output.normals.data) write_lane(normals[lane], count, first, output.normals);
      }
      rings = rings.subspan(count);
    }
  }
}

}  // namespace zerotree::surface
