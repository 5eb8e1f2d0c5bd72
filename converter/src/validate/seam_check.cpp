#include "validate/seam_check.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace zerotree::validate {
namespace {

using bitstream::BaseEdge;
using bitstream::kNone;

using Point = std::array<float, 3>;

Point point_at(std::span<const float> positions, std::uint32_t vertex) {
  const float* p = &positions[3 * std::size_t{vertex}];
  // The sum makes a zero positive: zeros of both signs are the same place.
  return {p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f};
}

// A boundary edge by its place: the lower end first.
struct PlacedEdge {
  Point low, high;
  std::uint32_t edge;
  /// Its face runs along it from the high end to the low one.
  bool is_downward;

  bool is_at(const PlacedEdge& other) const { return low == other.low && high == other.high; }
  friend bool operator<(const PlacedEdge& a, const PlacedEdge& b) {
    return std::tie(a.low, a.high, a.edge) < std::tie(b.low, b.high, b.edge);
  }
};

std::vector<PlacedEdge> place_boundary(std::span<const BaseEdge> edges,
                                       std::span<const float> positions) {
  std::vector<PlacedEdge> placed;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (edges[e].faces[1] != kNone) continue;
    Point low = point_at(positions, edges[e].vertices[0]);
    Point high = point_at(positions, edges[e].vertices[1]);
    const bool is_downward = high < low;
    if (is_downward) std::swap(low, high);
    if (low != high) placed.push_back({low, high, e, is_downward});
  }
  std::sort(placed.begin(), placed.end());
  return placed;
}

std::array<std::uint32_t, 2> ends_upward(const PlacedEdge& placed, const BaseEdge& edge) {
  if (placed.is_downward) return {edge.vertices[1], edge.vertices[0]};
  return edge.vertices;
}

}  // namespace

std::vector<BaseSeam> find_base_seams(std::span<const BaseEdge> edges,
                                      std::span<const float> positions) {
  const std::vector<PlacedEdge> placed = place_boundary(edges, positions);
  std::vector<BaseSeam> seams;
  for (std::size_t first = 0, last; first < placed.size(); first = last) {
    last = first + 1;
    while (last < placed.size() && placed[last].is_at(placed[first])) ++last;
    const PlacedEdge &a = placed[first], &b = placed[last - 1];
    if (last - first != 2 || a.is_downward == b.is_downward) continue;
    seams.push_back({{a.edge, b.edge},
                     {ends_upward(a, edges[a.edge]), ends_upward(b, edges[b.edge])},
                     {edges[a.edge].faces[0], edges[b.edge].faces[0]}});
  }
  std::sort(seams.begin(), seams.end(),
            [](const BaseSeam& a, const BaseSeam& b) { return a.edges < b.edges; });
  return seams;
}

std::vector<std::uint32_t> vertices_along(std::uint32_t edge, const BaseEdge& ends,
                                          const surface::LevelCounts& base, int level) {
  // An edge of the level at hand; reversed: the way goes from its end 1 to its end 0.
  struct Step {
    std::uint64_t edge;
    bool is_reversed;
  };
  std::vector<std::uint32_t> vertices{ends.vertices[0], ends.vertices[1]};
  std::vector<Step> steps{{edge, false}};
  for (int j = 0; j < level; ++j) {
    const surface::LevelCounts counts = surface::refined_counts(base, j);
    std::vector<std::uint32_t> finer_vertices{vertices.front()};
    std::vector<Step> finer_steps;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      // Half 0 lies at the edge's end 0; end 0 of both is the odd vertex between them.
      const std::uint64_t half = 3 * counts.triangles + 2 * steps[i].edge;
      const std::uint64_t reversed = steps[i].is_reversed ? 1 : 0;
      finer_steps.push_back({half + reversed, true});
      finer_steps.push_back({half + 1 - reversed, false});
      finer_vertices.push_back(static_cast<std::uint32_t>(counts.vertices + steps[i].edge));
      finer_vertices.push_back(vertices[i + 1]);
    }
    vertices = std::move(finer_vertices);
    steps = std::move(finer_steps);
  }
  return vertices;
}

SeamCheck::SeamCheck(std::span<const BaseEdge> edges, const surface::LevelCounts& base,
                     std::span<const float> base_positions,
                     std::span<const std::uint64_t> primitive_ends, int level)
    : seams_(find_base_seams(edges, base_positions)), points_each_((std::size_t{1} << level) + 1) {
  const auto primitive_of = [&](std::uint32_t face) {
    return std::upper_bound(primitive_ends.begin(), primitive_ends.end(), face);
  };
  for (const BaseSeam& seam : seams_) {
    between_primitives_.push_back(primitive_of(seam.faces[0]) != primitive_of(seam.faces[1]));
    std::array<std::vector<std::uint32_t>, 2> sides;
    for (std::size_t k = 0; k < 2; ++k) {
      const BaseEdge& edge = edges[seam.edges[k]];
      sides[k] = vertices_along(seam.edges[k], edge, base, level);
      if (edge.vertices != seam.vertices[k]) std::reverse(sides[k].begin(), sides[k].end());
    }
    for (std::size_t i = 0; i < points_each_; ++i) pairs_.push_back({sides[0][i], sides[1][i]});
  }
}

SeamGaps SeamCheck::measure(std::span<const float> limits) const {
  SeamGaps gaps;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Point a = point_at(limits, pairs_[i][0]), b = point_at(limits, pairs_[i][1]);
    const float distance = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    const std::size_t seam = i / points_each_;
    SeamGap& widest = between_primitives_[seam] ? gaps.between_primitives : gaps.within_primitive;
    if (distance > widest.distance) widest = {distance, seam};
  }
  return gaps;
}

}  // namespace zerotree::validate
