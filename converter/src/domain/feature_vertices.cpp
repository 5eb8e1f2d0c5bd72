#include "domain/feature_vertices.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace zerotree::domain {
namespace {

// A sharp turn is one of more than 50 degrees, both between the two edges and between the ends of
// four edges each way: the first finds the very vertex, the second ignores a jagged border.
constexpr double kSharpTurnCosine = 0.6428;
constexpr int kTurnWindow = 4;

using ChainEnds = std::array<std::uint32_t, 2>;

struct FeatureGraph {
  std::vector<std::uint8_t> degree;  // saturates at 3
  std::vector<ChainEnds> ends;       // the neighbours along the first two feature edges
};

FeatureGraph build_feature_graph(const TriangleTopology& topology) {
  FeatureGraph graph;
  graph.degree.assign(topology.face_of_vertex.size(), 0);
  graph.ends.assign(topology.face_of_vertex.size(), {kNone, kNone});
  const auto add = [&](std::uint32_t from, std::uint32_t to) {
    std::uint8_t& degree = graph.degree[from];
    if (degree < 2) graph.ends[from][degree] = to;
    degree = static_cast<std::uint8_t>(std::min(degree + 1, 3));
  };
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      if (!is_feature(topology, f, k)) continue;
      const std::uint32_t other = topology.adjacent[f][k];
      if (other != kNone && other < f) continue;
      add(topology.faces[f][k], topology.faces[f][kNext[k]]);
      add(topology.faces[f][kNext[k]], topology.faces[f][k]);
    }
  return graph;
}

// The vertex `steps` along the chain from `v` by way of `next`; stops where the chain ends.
std::uint32_t follow(const FeatureGraph& graph, std::uint32_t v, std::uint32_t next, int steps) {
  for (int i = 1; i < steps && graph.degree[next] == 2; ++i) {
    const ChainEnds& ends = graph.ends[next];
    const std::uint32_t after = ends[0] == v ? ends[1] : ends[0];
    v = next;
    next = after;
  }
  return next;
}

bool turns_sharply(const TriangleMesh& mesh, const FeatureGraph& graph, std::uint32_t v) {
  for (int steps : {1, kTurnWindow}) {
    const Eigen::Vector3d& p = mesh.positions[v];
    const Eigen::Vector3d& q0 = mesh.positions[follow(graph, v, graph.ends[v][0], steps)];
    const Eigen::Vector3d& q1 = mesh.positions[follow(graph, v, graph.ends[v][1], steps)];
    const Eigen::Vector3d in = (p - q0).stableNormalized(), out = (q1 - p).stableNormalized();
    if (in.dot(out) > kSharpTurnCosine) return false;
  }
  return true;
}

}  // namespace

std::vector<VertexKind> classify_vertices(const TriangleMesh& mesh,
                                          const TriangleTopology& topology) {
  const FeatureGraph graph = build_feature_graph(topology);
  std::vector<VertexKind> kinds(topology.face_of_vertex.size(), VertexKind::smooth);
  for (std::uint32_t v = 0; v < kinds.size(); ++v) {
    if (graph.degree[v] == 0) continue;
    const bool passes = graph.degree[v] == 2 && !turns_sharply(mesh, graph, v);
    kinds[v] = passes ? VertexKind::chain : VertexKind::corner;
  }
  return kinds;
}

}  // namespace zerotree::domain
