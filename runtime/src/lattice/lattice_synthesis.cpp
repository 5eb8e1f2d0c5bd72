#include "lattice/lattice_synthesis.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "bitstream/edge_image.h"
#include "lattice/group_kernels.h"
#include "lattice/group_limit.h"
#include "lattice/strip_kernels.h"
#include "surface/local_filter.h"

namespace zerotree::surface {

namespace {

// Strips and corners are small; a unit is some of them.
constexpr std::size_t kStripsAtOnce = 16, kCornersAtOnce = 64;

std::size_t blocks_of(std::size_t count, std::size_t at_once) {
  return (count + at_once - 1) / at_once;
}

template <class Part>
void for_block(std::size_t unit, std::size_t at_once, std::size_t count, const Part& part) {
  for (std::size_t i = unit * at_once; i < std::min(count, (unit + 1) * at_once); ++i) part(i);
}

/// Calls part(i, lanes) for i = first, first + kLanes, .. below `end`; `lanes` of them are below
/// it.
template <class Part>
void for_lanes(std::size_t first, std::size_t end, const Part& part) {
  for (std::size_t i = first; i < end; i += kLanes) part(i, std::min(kLanes, end - i));
}

PointF point_in(const LanePoint& p, std::size_t lane) {
  return {p.x[lane], p.y[lane], p.z[lane]};
}

PointF unit_normal(const PointF& tangent1, const PointF& tangent2) {
  const auto in_all = [](const PointF& p) {
    return LanePoint{Lanes{} + p.x, Lanes{} + p.y, Lanes{} + p.z};
  };
  return point_in(unit_normals({in_all(tangent1), in_all(tangent2)}, 1), 0);
}

/// Lift of a point inside a strip per detail of an edge on it, and its dip in units of the lift.
EndWeights strip_weights(const BaseStrip& strip) {
  using Rule = OpenSubdiv::Sdc::Crease::Rule;
  return strip.is_sharp ? end_weights(Rule::RULE_CREASE, 6, true) : regular_weights();
}

}  // namespace

LatticeSynthesis::LatticeSynthesis(const LatticeMesh& mesh, std::pmr::memory_resource* memory)
    : mesh_(mesh), memory_(memory), strip_moves_(memory) {}

void LatticeSynthesis::reserve(int level, std::size_t workers) {
  if (level <= levels()) return;
  const LatticeLevel& finest = mesh_.lattice(level);
  std::vector<LatticePoints> points;
  for (int number = levels() + 1; number <= level; ++number)
    points.emplace_back(mesh_.triangle_count(), mesh_.lattice(number).point_count, memory_);
  points_.reserve(points_.size() + points.size());
  while (scratch_.size() < workers) scratch_.emplace_back(memory_);
  for (Scratch& scratch : scratch_) scratch.rows.resize(StripRows::floats_needed(finest));
  if (level > 0) {
    const LatticeLevel& last = mesh_.lattice(level - 1);
    strip_moves_.resize(mesh_.fans().strips().size() * static_cast<std::size_t>(last.segments));
    for (Scratch& scratch : scratch_) scratch.moves.resize(finest.point_count - last.point_count);
    lifts_ = LatticePoints(mesh_.triangle_count(), last.point_count, memory_);
  }
  // Only now: if memory ran out before, the levels there were can still be made.
  std::move(points.begin(), points.end(), std::back_inserter(points_));
}

void LatticeSynthesis::set_base(std::span<const float> positions) {
  for (std::size_t vertex = 0; vertex < mesh_.fans().vertex_count(); ++vertex)
    set_corner(mesh_.fans().fan(vertex),
               {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]},
               points_at(0));
}

void LatticeSynthesis::set_details(const LevelDetails& details, double mean_area) {
  details_ = details;
  mean_area_ = mean_area;
}

std::size_t LatticeSynthesis::unit_count(SynthesisPass pass) const {
  switch (pass) {
    case SynthesisPass::subdivide_strips:
    case SynthesisPass::move_strips:
    case SynthesisPass::lift_strips:
    case SynthesisPass::finish_strips:
    case SynthesisPass::limit_strips:
      return blocks_of(mesh_.fans().strips().size(), kStripsAtOnce);
    case SynthesisPass::subdivide_corners:
    case SynthesisPass::lift_corners:
    case SynthesisPass::finish_corners:
    case SynthesisPass::limit_corners:
      return blocks_of(mesh_.fans().vertex_count(), kCornersAtOnce);
    case SynthesisPass::subdivide_groups:
    case SynthesisPass::move_groups:
    case SynthesisPass::finish_groups:
    case SynthesisPass::limit_groups:
      break;
  }
  return mesh_.group_count();
}

void LatticeSynthesis::run(SynthesisPass pass, int level, std::size_t unit, std::size_t worker,
                           const LimitOutput& output) {
  Scratch& scratch = scratch_[worker];
  const auto strips = [&](const auto& part) {
    for_block(unit, kStripsAtOnce, mesh_.fans().strips().size(), part);
  };
  const auto corners = [&](const auto& part) {
    for_block(unit, kCornersAtOnce, mesh_.fans().vertex_count(), part);
  };
  switch (pass) {
    case SynthesisPass::subdivide_strips:
      return strips([&](std::size_t strip) { subdivide_strip(level, strip, scratch); });
    case SynthesisPass::subdivide_corners:
      return corners([&](std::size_t vertex) { subdivide_corner(level, vertex); });
    case SynthesisPass::subdivide_groups:
      return subdivide_inside(mesh_.lattice(level), points_at(level).group(unit),
                              points_at(level + 1).group(unit));
    case SynthesisPass::move_strips:
      return strips([&](std::size_t strip) { move_strip(level, strip, scratch); });
    case SynthesisPass::move_groups:
      return move_group(level, unit, scratch);
    case SynthesisPass::lift_strips:
      return strips([&](std::size_t strip) { lift_strip(level, strip); });
    case SynthesisPass::lift_corners:
      return corners([&](std::size_t vertex) { lift_corner(level, vertex); });
    case SynthesisPass::finish_strips:
      return strips([&](std::size_t strip) { finish_strip(level, strip, scratch); });
    case SynthesisPass::finish_corners:
      return corners([&](std::size_t vertex) { finish_corner(level, vertex); });
    case SynthesisPass::finish_groups:
      return lift_inside(mesh_.lattice(level), lifts_.group(unit),
                         points_at(level + 1).group(unit));
    case SynthesisPass::limit_strips:
      return strips([&](std::size_t strip) { limit_strip(level, strip, scratch, output); });
    case SynthesisPass::limit_corners:
      return corners([&](std::size_t vertex) { limit_corner(level, vertex, output); });
    case SynthesisPass::limit_groups:
      return write_limits_inside(mesh_, level, unit, points_at(level).group(unit), output);
  }
}

// --- strips ---

std::span<PointF> LatticeSynthesis::strip_moves(int level, std::size_t strip) {
  const auto n = static_cast<std::size_t>(mesh_.lattice(level).segments);
  return std::span(strip_moves_).subspan(strip * n, n);
}

void LatticeSynthesis::subdivide_strip(int level, std::size_t number, Scratch& scratch) {
  const BaseStrip& strip = mesh_.fans().strips()[number];
  const LatticeLevel& coarse = mesh_.lattice(level);
  const LatticeLevel& fine = mesh_.lattice(level + 1);
  const StripRows rows = gather_rows(strip, coarse, points_at(level), scratch.rows.data());
  const auto n = static_cast<std::size_t>(coarse.segments);
  for_lanes(1, n, [&](std::size_t i, std::size_t lanes) {
    const LanePoint even = even_on_strip(strip, rows, i);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      set_on_strip(strip, fine, 2 * (i + lane), point_in(even, lane), points_at(level + 1));
  });
  for_lanes(0, n, [&](std::size_t i, std::size_t lanes) {
    const LanePoint odd = odd_on_strip(strip, rows, i);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      set_on_strip(strip, fine, 2 * (i + lane) + 1, point_in(odd, lane), points_at(level + 1));
  });
}

/// The details of the strip's segments from `i` on: cells (i, i) of the base edge's image.
LanePoint LatticeSynthesis::strip_detail(int level, std::size_t strip, std::size_t i,
                                         std::size_t lanes) const {
  LanePoint detail{};
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto place = static_cast<std::uint32_t>(i + lane);
    const std::size_t cell = bitstream::cell_index(
        level, bitstream::EdgeCell{static_cast<std::uint32_t>(strip), place, place});
    const auto length = [&](std::size_t c) {
      return 0.5f * static_cast<float>(details_.channels[c][cell]) * details_.units[c];
    };
    detail.x[lane] = length(0);
    detail.y[lane] = length(1);
    detail.z[lane] = length(2);
  }
  return detail;
}

void LatticeSynthesis::move_strip(int level, std::size_t number, Scratch& scratch) {
  const BaseStrip& strip = mesh_.fans().strips()[number];
  const StripRows fine =
      gather_rows(strip, mesh_.lattice(level + 1), points_at(level + 1), scratch.rows.data());
  const std::span<PointF> moves = strip_moves(level, number);
  const AreaScale area(strip.is_boundary() ? kBoundaryAreaShare : kInteriorAreaShare, mean_area_);
  for_lanes(0, moves.size(), [&](std::size_t i, std::size_t lanes) {
    const LanePoint detail = strip_detail(level, number, i, lanes);
    const LanePoint move = moves_on_strip(strip, fine, i, detail, area, lanes);
    for (std::size_t lane = 0; lane < lanes; ++lane) moves[i + lane] = point_in(move, lane);
  });
}

void LatticeSynthesis::lift_strip(int level, std::size_t number) {
  const BaseStrip& strip = mesh_.fans().strips()[number];
  const LatticeLevel& lattice = mesh_.lattice(level);
  const std::span<const PointF> moves = strip_moves(level, number);
  const float weight = strip_weights(strip).lift;
  for (std::size_t i = 1; i < moves.size(); ++i) {
    PointF lift = weight * (moves[i - 1] + moves[i]);
    if (!strip.is_sharp) {
      const std::size_t back = moves.size() - i;
      lift += lifts_.get(strip.faces[0], lattice.side_points[strip.sides[0]][i]) +
              lifts_.get(strip.faces[1], lattice.side_points[strip.sides[1]][back]);
    }
    set_on_strip(strip, lattice, i, lift, lifts_);
  }
}

void LatticeSynthesis::finish_strip(int level, std::size_t number, Scratch& scratch) {
  const BaseStrip& strip = mesh_.fans().strips()[number];
  const LatticeLevel& fine = mesh_.lattice(level + 1);
  const StripRows lifts = gather_rows(strip, mesh_.lattice(level), lifts_, scratch.rows.data());
  const std::span<const PointF> moves = strip_moves(level, number);
  const EndWeights weights = strip_weights(strip);
  const float dip = weights.dip / weights.lift;
  LatticePoints& points = points_at(level + 1);
  const auto& row = fine.side_points[strip.sides[0]];
  const auto add = [&](std::size_t i, const PointF& move) {
    set_on_strip(strip, fine, i, points.get(strip.faces[0], row[i]) + move, points);
  };
  for_lanes(1, moves.size(), [&](std::size_t i, std::size_t lanes) {
    const LanePoint even = even_on_strip(strip, lifts, i) + dip * lifts.row.lanes(i);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      add(2 * (i + lane), -1.0f * point_in(even, lane));
  });
  for_lanes(0, moves.size(), [&](std::size_t i, std::size_t lanes) {
    const LanePoint odd = odd_on_strip(strip, lifts, i);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      add(2 * (i + lane) + 1, moves[i + lane] - point_in(odd, lane));
  });
}

void LatticeSynthesis::limit_strip(int level, std::size_t number, Scratch& scratch,
                                   const LimitOutput& output) {
  const BaseStrip& strip = mesh_.fans().strips()[number];
  const LatticeLevel& lattice = mesh_.lattice(level);
  const StripRows rows = gather_rows(strip, lattice, points_at(level), scratch.rows.data());
  const auto write = [&](const LanePoint& values, std::size_t i, std::size_t lanes,
                         const StridedVectors& target) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const PointF value = point_in(values, lane);
      target.write(mesh_.strip_vertex(static_cast<std::uint32_t>(number), level, i + lane), &value);
    }
  };
  for_lanes(1, static_cast<std::size_t>(lattice.segments), [&](std::size_t i, std::size_t lanes) {
    const float outward = output.outward;
    if (output.positions.data)
      write((1.0f - outward) * limits_on_strip(strip, rows, i) + outward * rows.row.lanes(i), i,
            lanes, output.positions);
    if (output.normals.data)
      write(normals_on_strip(strip, rows, i, lanes), i, lanes, output.normals);
  });
}

// --- corners ---

PointF LatticeSynthesis::spoke_point(const BaseSpoke& spoke, const LatticeLevel& level,
                                     const LatticePoints& points) const {
  const BaseStrip& strip = mesh_.fans().strips()[spoke.strip()];
  const auto& row = level.side_points[strip.sides[0]];
  return points.get(strip.faces[0], row[spoke.is_head() ? row.size() - 2 : 1]);
}

PointF LatticeSynthesis::child_at_corner(const BaseFans::View& fan, const LatticeLevel& level,
                                         const LatticePoints& points) const {
  const auto [face, corner] = mesh_.fans().corner_after(fan.spokes.front());
  PointF child = fan.vertex.child * points.get(face, level.side_points[corner][0]);
  for (std::size_t k = 0; k < fan.spokes.size(); ++k)
    child += fan.weights[k].child * spoke_point(fan.spokes[k], level, points);
  return child;
}

void LatticeSynthesis::set_corner(const BaseFans::View& fan, const PointF& value,
                                  LatticePoints& points) const {
  // Corner k is point k at every level.
  for (const BaseSpoke& spoke : fan.spokes) {
    const auto [face, corner] = mesh_.fans().corner_after(spoke);
    if (face != bitstream::kNone) points.set(face, corner, value);
  }
}

void LatticeSynthesis::subdivide_corner(int level, std::size_t vertex) {
  const BaseFans::View fan = mesh_.fans().fan(vertex);
  set_corner(fan, child_at_corner(fan, mesh_.lattice(level), points_at(level)),
             points_at(level + 1));
}

void LatticeSynthesis::move_group(int level, std::size_t group, Scratch& scratch) {
  GroupDetails details{};
  details.lanes_used = mesh_.lanes_used(group);
  details.details = &details_;
  details.mean_area = static_cast<float>(mean_area_);
  for (std::size_t lane = 0; lane < details.lanes_used; ++lane)
    for (std::size_t side = 0; side < 3; ++side) {
      const LatticeMesh::Side seen = mesh_.sides(group * kLanes + lane)[side];
      details.sides[lane][side] = {seen.strip(), seen.is_right() ? 1u : 0u};
    }
  move_inside(mesh_.lattice(level), mesh_.lattice(level + 1), details, scratch.moves.data(),
              points_at(level + 1).group(group), lifts_.group(group));
}

void LatticeSynthesis::lift_corner(int level, std::size_t vertex) {
  const BaseFans::View fan = mesh_.fans().fan(vertex);
  PointF lift;
  for (std::size_t k = 0; k < fan.spokes.size(); ++k) {
    const std::span<const PointF> moves = strip_moves(level, fan.spokes[k].strip());
    lift += fan.weights[k].lift * (fan.spokes[k].is_head() ? moves.back() : moves.front());
  }
  set_corner(fan, lift, lifts_);
}

void LatticeSynthesis::finish_corner(int level, std::size_t vertex) {
  const BaseFans::View fan = mesh_.fans().fan(vertex);
  const auto [face, corner] = mesh_.fans().corner_after(fan.spokes.front());
  LatticePoints& points = points_at(level + 1);
  const PointF dip = fan.dip_per_lift * lifts_.get(face, corner);
  set_corner(fan,
             points.get(face, corner) - (child_at_corner(fan, mesh_.lattice(level), lifts_) + dip),
             points);
}

void LatticeSynthesis::limit_corner(int level, std::size_t vertex, const LimitOutput& output) {
  const BaseFans::View fan = mesh_.fans().fan(vertex);
  const LatticeLevel& lattice = mesh_.lattice(level);
  const auto [face, corner] = mesh_.fans().corner_after(fan.spokes.front());
  const PointF centre = points_at(level).get(face, corner);
  PointF position = fan.vertex.position * centre, tangent1, tangent2;
  for (std::size_t k = 0; k < fan.spokes.size(); ++k) {
    const PointF point = spoke_point(fan.spokes[k], lattice, points_at(level));
    position += fan.weights[k].position * point;
    // Weights of a tangent sum to 0, so differences will do and lose no digits.
    tangent1 += fan.weights[k].tangent1 * (point - centre);
    tangent2 += fan.weights[k].tangent2 * (point - centre);
  }
  position = (1.0f - output.outward) * position + output.outward * centre;
  if (output.positions.data) output.positions.write(vertex, &position);
  if (!output.normals.data) return;
  const PointF normal = unit_normal(tangent1, tangent2);
  output.normals.write(vertex, &normal);
}

}  // namespace zerotree::surface
