#include "domain/feature_edges.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "domain/crease_pruning.h"

namespace zerotree::domain {
namespace {

// How edges become creases. A chain starts from edges of the upper angle, goes on over edges of
// the lower angle and counts only if it is long and runs smoothly: scan noise makes sharp edges,
// but its chains are short or a thicket of branches and zigzags.
struct CreaseRule {
  double upper_cosine;
  double lower_cosine;
  double min_length;        // of the edges of connected chains, relative to the diagonal
  double min_arc;           // mean length between their ends, junctions and sharp turns, likewise
  double min_strong_share;  // of a chain's edges that reach the upper angle
  double max_neighbour;     // turn of the surface beside the edge, as a share of the edge's own
};

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

CreaseRule rule_for(double angle_degrees) {
  if (angle_degrees > 0) {
    const double cosine = std::cos(radians(angle_degrees));
    return {cosine, cosine, 0.0, 0.0, 0.0, 1e9};
  }
  return {std::cos(radians(40.0)), std::cos(radians(15.0)), 0.5, 0.04, 0.6, 0.35};
}

// The rim of a part's hole is shorter than chains must be that may be noise: it lies in a plane,
// closes without an end, a branch or a sharp turn, and bends by the upper angle almost everywhere.
constexpr std::uint32_t kRingEdges = 8;
constexpr double kRingStrongShare = 0.9;
constexpr double kRingLength = 0.02;  // relative to the diagonal

constexpr double kFlatTurn = radians(1.0);

// Arcs of fewer edges could not be followed by a base mesh, which keeps all their ends; they must
// be clear and long.
constexpr double kEdgesPerArc = 4.5;
constexpr double kClearStrongShare = 0.9;
constexpr double kClearArc = 0.1;  // relative to the diagonal

// Of a turn of 50 degrees.
constexpr double kSharpTurnCosine = 0.6428;

// Of the faces, searched for candidates in parallel.
constexpr std::size_t kParts = 16;

struct CandidateEdge {
  std::uint32_t face;
  int edge;
  bool strong;
  bool in_plane;  // the surface is flat beside it, on one side at least
};

// Disjoint sets of edges that meet in a vertex.
class ChainSets {
 public:
  explicit ChainSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

std::vector<Eigen::Vector3d> face_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, normals.size(), [&](std::size_t f) {
    const auto& [a, b, c] = mesh.triangles[f];
    normals[f] = (mesh.positions[b] - mesh.positions[a])
                     .cross(mesh.positions[c] - mesh.positions[a])
                     .stableNormalized();
  });
  return normals;
}

// How much the surface turns at the edges beside an edge: on either side the lesser of the two, as
// at a crease's bend one edge turns too, and the greater.
struct SideTurns {
  std::array<double, 2> least, most;
};

SideTurns turns_beside(const TriangleTopology& topology,
                       const std::vector<Eigen::Vector3d>& normals, std::uint32_t face, int edge) {
  const auto turn = [&](std::uint32_t f, int k) {
    const std::uint32_t g = topology.adjacent[f][k];
    return g == kNone ? 0.0 : std::acos(std::clamp(normals[f].dot(normals[g]), -1.0, 1.0));
  };
  const std::uint32_t other = topology.adjacent[face][edge];
  const int back = edge_towards(topology, other, face);
  SideTurns turns;
  for (int side : {0, 1}) {
    const std::uint32_t f = side == 0 ? face : other;
    const int k = side == 0 ? edge : back;
    const double next = turn(f, kNext[k]), previous = turn(f, kPrev[k]);
    turns.least[side] = std::min(next, previous);
    turns.most[side] = std::max(next, previous);
  }
  return turns;
}

// The candidates of the faces from `begin` to before `end`.
std::vector<CandidateEdge> find_candidates(const std::vector<Eigen::Vector3d>& normals,
                                           const CreaseRule& rule, const TriangleTopology& topology,
                                           std::uint32_t begin, std::uint32_t end) {
  std::vector<CandidateEdge> candidates;
  for (std::uint32_t f = begin; f < end; ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t g = topology.adjacent[f][k];
      if (g == kNone || g < f || normals[f].isZero() || normals[g].isZero()) continue;
      const double cosine = normals[f].dot(normals[g]);
      if (cosine > rule.lower_cosine) continue;
      // On a crease the surface turns at one edge; on a rounded or noisy ridge also beside it.
      const SideTurns beside = turns_beside(topology, normals, f, k);
      const double limit = rule.max_neighbour * std::acos(std::max(cosine, -1.0));
      if (std::max(beside.least[0], beside.least[1]) > limit) continue;
      candidates.push_back({f, k, cosine <= rule.upper_cosine,
                            std::min(beside.most[0], beside.most[1]) < kFlatTurn});
    }
  return candidates;
}

std::vector<CandidateEdge> find_candidates(const TriangleMesh& mesh, const CreaseRule& rule,
                                           const TriangleTopology& topology) {
  const std::vector<Eigen::Vector3d> normals = face_normals(mesh);
  std::array<std::vector<CandidateEdge>, kParts> parts;
  const auto begin = [&](std::size_t part) {
    return static_cast<std::uint32_t>(part * normals.size() / kParts);
  };
  tbb::parallel_for(std::size_t{0}, kParts, [&](std::size_t part) {
    parts[part] = find_candidates(normals, rule, topology, begin(part), begin(part + 1));
  });
  std::vector<CandidateEdge> candidates;
  for (const std::vector<CandidateEdge>& part : parts)
    candidates.insert(candidates.end(), part.begin(), part.end());
  return candidates;
}

// What connected candidate edges make up together.
struct ChainSum {
  std::uint32_t edges = 0;
  std::uint32_t strong = 0;
  std::uint32_t in_plane = 0;
  double length = 0;
  // Ends of arcs: at the ends and junctions of chains and where they turn sharply.
  std::uint32_t arc_ends = 0;

  double mean_arc() const { return 2 * length / std::max(arc_ends, 2u); }
};

// The candidate edges at each vertex, as far as arcs need them.
struct CandidateFan {
  std::uint32_t degree = 0;
  std::uint32_t first = kNone;                            // a candidate edge
  std::array<std::uint32_t, 2> neighbours{kNone, kNone};  // along the first two

  void add(std::uint32_t candidate, std::uint32_t neighbour) {
    if (degree == 0) first = candidate;
    if (degree < 2) neighbours[degree] = neighbour;
    ++degree;
  }
};

std::vector<CandidateFan> gather_fans(const TriangleTopology& topology,
                                      const std::vector<CandidateEdge>& candidates) {
  std::vector<CandidateFan> fans(topology.face_of_vertex.size());
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    const auto& [face, edge, strong, in_plane] = candidates[i];
    const std::uint32_t a = topology.faces[face][edge], b = topology.faces[face][kNext[edge]];
    fans[a].add(i, b);
    fans[b].add(i, a);
  }
  return fans;
}

// The set of each candidate edge, joined at common vertices.
ChainSets join_chains(const TriangleTopology& topology,
                      const std::vector<CandidateEdge>& candidates,
                      const std::vector<CandidateFan>& fans) {
  ChainSets sets(candidates.size());
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    const auto& [face, edge, strong, in_plane] = candidates[i];
    for (int end : {edge, kNext[edge]}) sets.join(i, fans[topology.faces[face][end]].first);
  }
  return sets;
}

// How many arcs end in vertex `v`: none if a chain passes through without a turn of 50 degrees.
std::uint32_t count_arc_ends(const TriangleMesh& mesh, const CandidateFan& fan, std::uint32_t v) {
  if (fan.degree != 2) return fan.degree;
  const Eigen::Vector3d in = mesh.positions[v] - mesh.positions[fan.neighbours[0]];
  const Eigen::Vector3d out = mesh.positions[fan.neighbours[1]] - mesh.positions[v];
  return in.stableNormalized().dot(out.stableNormalized()) < kSharpTurnCosine ? 2 : 0;
}

std::vector<ChainSum> sum_chains(const TriangleMesh& mesh, const TriangleTopology& topology,
                                 const std::vector<CandidateEdge>& candidates,
                                 const std::vector<CandidateFan>& fans, ChainSets& sets) {
  std::vector<ChainSum> sums(candidates.size());
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    const auto& [face, edge, is_strong, in_plane] = candidates[i];
    const Triangle& t = topology.faces[face];
    ChainSum& sum = sums[sets.find(i)];
    ++sum.edges;
    sum.strong += is_strong ? 1u : 0u;
    sum.in_plane += in_plane ? 1u : 0u;
    sum.length += (mesh.positions[t[edge]] - mesh.positions[t[kNext[edge]]]).norm();
  }
  for (std::uint32_t v = 0; v < fans.size(); ++v)
    if (fans[v].degree > 0)
      sums[sets.find(fans[v].first)].arc_ends += count_arc_ends(mesh, fans[v], v);
  return sums;
}

// Without the weak branches that noise hangs on chains.
std::vector<CandidateEdge> prune_candidates(const TriangleMesh& mesh,
                                            const TriangleTopology& topology,
                                            const std::vector<CandidateEdge>& candidates,
                                            double min_length) {
  std::vector<CreaseSegment> segments;
  segments.reserve(candidates.size());
  for (const auto& [face, edge, is_strong, in_plane] : candidates) {
    const std::uint32_t a = topology.faces[face][edge], b = topology.faces[face][kNext[edge]];
    segments.push_back({{a, b}, (mesh.positions[a] - mesh.positions[b]).norm(), is_strong});
  }
  const std::vector<std::uint8_t> stays =
      prune_weak_arcs(mesh.positions.size(), segments, {.min_length = min_length});
  std::vector<CandidateEdge> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (stays[i] != 0) kept.push_back(candidates[i]);
  return kept;
}

bool is_crease(const ChainSum& sum, const CreaseRule& rule, double diagonal) {
  if (sum.arc_ends == 0 && sum.edges >= kRingEdges && sum.length >= kRingLength * diagonal &&
      std::min(sum.strong, sum.in_plane) >= kRingStrongShare * sum.edges)
    return true;
  const bool is_clear =
      2 * sum.edges >= kEdgesPerArc * sum.arc_ends ||
      (sum.strong >= kClearStrongShare * sum.edges && sum.mean_arc() >= kClearArc * diagonal);
  return (is_clear || rule.min_arc == 0) && sum.length >= rule.min_length * diagonal &&
         sum.mean_arc() >= rule.min_arc * diagonal &&
         sum.strong >= rule.min_strong_share * sum.edges;
}

void tag_edge(std::uint32_t face, int edge, TriangleTopology& topology) {
  const std::uint32_t other = topology.adjacent[face][edge];
  const int back = edge_towards(topology, other, face);
  topology.creases[face] = static_cast<std::uint8_t>(topology.creases[face] | (1 << edge));
  topology.creases[other] = static_cast<std::uint8_t>(topology.creases[other] | (1 << back));
}

// Noise may bend the surface beside a single edge of a crease so much that it is no candidate: tags
// edges of the upper angle from an end of a crease to another crease.
std::uint32_t bridge_gaps(const TriangleMesh& mesh, double upper_cosine,
                          TriangleTopology& topology) {
  std::vector<std::uint8_t> degree(topology.face_of_vertex.size(), 0);
  const auto for_each_edge = [&](const auto& visit) {
    for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
      for (int k = 0; k < 3; ++k)
        if (topology.adjacent[f][k] != kNone && topology.adjacent[f][k] > f)
          visit(f, k, topology.faces[f][k], topology.faces[f][kNext[k]]);
  };
  for_each_edge([&](std::uint32_t f, int k, std::uint32_t a, std::uint32_t b) {
    if (((topology.creases[f] >> k) & 1) == 0) return;
    for (std::uint32_t v : {a, b})
      degree[v] = static_cast<std::uint8_t>(std::min(degree[v] + 1, 3));
  });
  if (std::ranges::count(degree, 1) == 0) return 0;
  const std::vector<Eigen::Vector3d> normals = face_normals(mesh);
  std::uint32_t count = 0;
  for_each_edge([&](std::uint32_t f, int k, std::uint32_t a, std::uint32_t b) {
    if (std::min(degree[a], degree[b]) != 1 || ((topology.creases[f] >> k) & 1) != 0) return;
    if (normals[f].dot(normals[topology.adjacent[f][k]]) > upper_cosine) return;
    tag_edge(f, k, topology);
    for (std::uint32_t v : {a, b}) ++degree[v];
    ++count;
  });
  return count;
}

}  // namespace

std::uint32_t tag_crease_edges(const TriangleMesh& mesh, double crease_angle_degrees,
                               TriangleTopology& topology) {
  if (crease_angle_degrees >= 180.0) return 0;
  const CreaseRule rule = rule_for(crease_angle_degrees);
  const double diagonal = bounding_box_diagonal(mesh.positions);
  std::vector<CandidateEdge> candidates = find_candidates(mesh, rule, topology);
  if (rule.min_arc > 0)
    candidates = prune_candidates(mesh, topology, candidates, rule.min_arc * diagonal);
  const std::vector<CandidateFan> fans = gather_fans(topology, candidates);
  ChainSets sets = join_chains(topology, candidates, fans);
  const std::vector<ChainSum> sums = sum_chains(mesh, topology, candidates, fans, sets);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    if (!is_crease(sums[sets.find(i)], rule, diagonal)) continue;
    tag_edge(candidates[i].face, candidates[i].edge, topology);
    ++count;
  }
  return rule.min_arc > 0 ? count + bridge_gaps(mesh, rule.upper_cosine, topology) : count;
}

}  // namespace zerotree::domain
