#include "lattice/triangle_lattice.h"

#include <cstddef>
#include <utility>

#include "bitstream/edge_image.h"

namespace zerotree::surface {

namespace {

/// A point by its steps from corner 0 towards corners 1 and 2, or a difference of two.
struct Step {
  int a = 0, b = 0;

  friend Step operator+(Step p, Step q) { return {p.a + q.a, p.b + q.b}; }
  friend Step operator*(int s, Step p) { return {s * p.a, s * p.b}; }
};

/// Along side k; its left neighbour is kAround[2k + 1], its right one kAround[2k + 5].
constexpr std::array<Step, 6> kAround = {{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
constexpr Step around(std::size_t direction) {
  return kAround[direction % 6];
}

/// Numbers of the points of one level, by their steps.
class PointNumbers {
 public:
  explicit PointNumbers(int segments)
      : row_(segments + 1),
        numbers_(static_cast<std::size_t>(row_) * static_cast<std::size_t>(row_)) {}

  std::uint32_t& operator[](Step p) { return numbers_[place(p)]; }
  std::uint32_t operator[](Step p) const { return numbers_[place(p)]; }

 private:
  std::size_t place(Step p) const {
    return static_cast<std::size_t>(p.b) * static_cast<std::size_t>(row_) +
           static_cast<std::size_t>(p.a);
  }
  int row_;
  std::vector<std::uint32_t> numbers_;
};

/// What OpenSubdiv's refinement of a single triangle numbers, by steps.
struct Refinement {
  std::vector<std::array<Step, 3>> triangles;
  std::vector<std::array<Step, 2>> edges;
  std::vector<Step> points;
};

Refinement single_triangle() {
  const Step c0{0, 0}, c1{1, 0}, c2{0, 1};
  return {{{c0, c1, c2}}, {{c0, c1}, {c1, c2}, {c2, c0}}, {c0, c1, c2}};
}

Refinement refined(const Refinement& coarse) {
  Refinement fine;
  for (const Step p : coarse.points) fine.points.push_back(2 * p);
  for (const auto& [p, q] : coarse.edges) fine.points.push_back(p + q);
  for (const auto& [c0, c1, c2] : coarse.triangles) {
    const Step m0 = c0 + c1, m1 = c1 + c2, m2 = c2 + c0;
    const std::array<std::array<Step, 3>, 4> children = {
        {{2 * c0, m0, m2}, {m0, 2 * c1, m1}, {m2, m1, 2 * c2}, {m1, m2, m0}}};
    fine.triangles.insert(fine.triangles.end(), children.begin(), children.end());
    const std::array<std::array<Step, 2>, 3> inner = {{{m0, m2}, {m1, m0}, {m2, m1}}};
    fine.edges.insert(fine.edges.end(), inner.begin(), inner.end());
  }
  for (const auto& [p, q] : coarse.edges) {
    fine.edges.push_back({p + q, 2 * p});
    fine.edges.push_back({p + q, 2 * q});
  }
  return fine;
}

PointNumbers number_points(const Refinement& refinement, int segments) {
  PointNumbers numbers(segments);
  for (std::uint32_t point = 0; point < refinement.points.size(); ++point)
    numbers[refinement.points[point]] = point;
  return numbers;
}

/// Steps of point `i` of side k, counted from corner k.
Step on_side(std::size_t side, int segments, int i) {
  const std::array<Step, 3> corners = {{{0, 0}, {segments, 0}, {0, segments}}};
  return corners[side] + i * around(2 * side);
}

/// Where the points born at `level` on the edges born at `edge_born` inside begin.
void add_runs(int level, std::pmr::vector<PointRun>& runs) {
  std::uint32_t points = 3, edges = 3, triangles = 1;
  for (int born = 1; born <= level; ++born) {
    // The newest edges come first, the descendants of the oldest, the sides, last.
    std::uint32_t first = points, count = 3 * triangles / 4;
    for (int edge_born = born - 1; edge_born >= 1; --edge_born) {
      runs.push_back({first, count, born, edge_born});
      first += count;
      count /= 2;
    }
    points += edges;
    edges = 2 * edges + 3 * triangles;
    triangles *= 4;
  }
}

class LevelBuilder {
 public:
  LevelBuilder(const Refinement& refinement, int segments, std::pmr::memory_resource* memory)
      : refinement_(refinement),
        n_(segments),
        numbers_(number_points(refinement, segments)),
        level_(memory) {
    level_.segments = segments;
    level_.point_count = static_cast<std::uint32_t>(refinement.points.size());
  }

  LatticeLevel build(int level) {
    level_.triangles.reserve(refinement_.triangles.size());
    for (const auto& [p, q, r] : refinement_.triangles)
      level_.triangles.push_back({numbers_[p], numbers_[q], numbers_[r]});
    add_runs(level, level_.runs);
    level_.rings.reserve(level_.point_count - 3 * static_cast<std::size_t>(n_));
    for (const PointRun& run : level_.runs)
      for (std::uint32_t point = run.first; point < run.first + run.count; ++point) add_ring(point);
    for (std::size_t side = 0; side < 3; ++side) {
      for (int i = 0; i <= n_; ++i)
        level_.side_points[side].push_back(numbers_[on_side(side, n_, i)]);
      for (int i = 0; i < n_; ++i)
        level_.near_points[side].push_back(numbers_[on_side(side, n_, i) + around(2 * side + 1)]);
    }
    return std::move(level_);
  }

  /// The edges to the level whose points are `finer`.
  static void add_edges(LatticeLevel& level, const PointNumbers& numbers,
                        const PointNumbers& finer) {
    const int n = level.segments;
    for (std::size_t side = 0; side < 3; ++side) {
      level.edges[side].reserve(static_cast<std::size_t>(n * (n - 1) / 2));
      for (int row = 1; row < n; ++row)
        for (int place = 0; place < n - row; ++place) {
          const Step tail = on_side(side, n, place) + row * around(2 * side + 1);
          level.edges[side].push_back(edge_at(numbers, finer, tail, side));
          const auto last = static_cast<std::uint32_t>(n - 1);
          const auto r = static_cast<std::uint32_t>(row), s = static_cast<std::uint32_t>(place);
          const auto morton = [](std::uint32_t p, std::uint32_t q) {
            return (bitstream::spread_bits(p) << 1) | bitstream::spread_bits(q);
          };
          level.edges[side].back().cells = {morton(s + r, s), morton(last - r - s, last - s)};
        }
    }
  }

  const PointNumbers& numbers() const { return numbers_; }

 private:
  static LatticeEdge edge_at(const PointNumbers& numbers, const PointNumbers& finer, Step tail,
                             std::size_t side) {
    const Step along = around(2 * side), left = around(2 * side + 1), right = around(2 * side + 5);
    LatticeEdge edge{};
    edge.odd = finer[2 * tail + along];
    edge.tail = numbers[tail];
    edge.head = numbers[tail + along];
    edge.left = numbers[tail + left];
    edge.right = numbers[tail + right];
    edge.wings = {finer[2 * tail + left], finer[2 * tail + along + left], finer[2 * tail + right],
                  finer[2 * tail + along + right]};
    return edge;
  }

  void add_ring(std::uint32_t point) {
    std::array<std::uint32_t, 7> ring{point};
    for (std::size_t k = 0; k < 6; ++k)
      ring[k + 1] = numbers_[refinement_.points[point] + around(k)];
    level_.rings.push_back(ring);
  }

  const Refinement& refinement_;
  int n_;
  PointNumbers numbers_;
  LatticeLevel level_;
};

}  // namespace

std::vector<LatticeLevel> triangle_lattices(int levels, std::pmr::memory_resource* memory) {
  std::vector<LatticeLevel> result;
  Refinement refinement = single_triangle();
  PointNumbers coarser(0);
  for (int level = 0; level <= levels; ++level) {
    LevelBuilder builder(refinement, 1 << level, memory);
    if (level > 0) LevelBuilder::add_edges(result.back(), coarser, builder.numbers());
    result.push_back(builder.build(level));
    coarser = builder.numbers();
    if (level < levels) refinement = refined(refinement);
  }
  return result;
}

EdgePoints edge_points(int level) {
  struct Segment {
    int first, last;  // from OpenSubdiv's first vertex of the segment to its second
  };
  const int n = 1 << level;
  EdgePoints points;
  points.born.assign(static_cast<std::size_t>(n) + 1, 0);
  points.number.assign(static_cast<std::size_t>(n) + 1, 0);
  std::vector<Segment> segments = {{0, n}};
  for (int born = 1; born <= level; ++born) {
    std::vector<Segment> halves;
    for (std::size_t number = 0; number < segments.size(); ++number) {
      const auto [first, last] = segments[number];
      const int middle = (first + last) / 2;
      points.born[static_cast<std::size_t>(middle)] = born;
      points.number[static_cast<std::size_t>(middle)] = static_cast<std::uint32_t>(number);
      halves.push_back({middle, first});
      halves.push_back({middle, last});
    }
    segments = std::move(halves);
  }
  return points;
}

}  // namespace zerotree::surface
