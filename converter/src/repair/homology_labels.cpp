#include "repair/homology_labels.h"

#include <algorithm>
#include <numeric>

namespace zerotree::repair {
namespace {

using domain::kNext;
using domain::kNone;
using domain::TriangleTopology;

struct Link {
  std::uint32_t to, edge;
};

// A spanning forest by breadth first search.
struct Forest {
  std::vector<std::uint32_t> parent, parent_edge, depth;

  explicit Forest(std::size_t count)
      : parent(count, kNone), parent_edge(count, kNone), depth(count, kNone) {}

  // Edges from `a` and `b` to where their ways to the root meet; the nodes likewise.
  void path_between(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& edges,
                    std::vector<std::uint32_t>& nodes) const {
    edges.clear();
    nodes.assign({a, b});
    while (a != b) {
      std::uint32_t& deeper = depth[a] >= depth[b] ? a : b;
      edges.push_back(parent_edge[deeper]);
      deeper = parent[deeper];
      nodes.push_back(deeper);
    }
  }
};

template <class ForEachLink>
Forest grow_forest(std::size_t count, const ForEachLink& for_each_link) {
  Forest forest(count);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t root = 0; root < count; ++root) {
    if (forest.depth[root] != kNone) continue;
    forest.depth[root] = 0;
    queue.assign(1, root);
    for (std::size_t i = 0; i < queue.size(); ++i)
      for_each_link(queue[i], [&](const Link& link) {
        if (forest.depth[link.to] != kNone) return;
        forest.depth[link.to] = forest.depth[queue[i]] + 1;
        forest.parent[link.to] = queue[i];
        forest.parent_edge[link.to] = link.edge;
        queue.push_back(link.to);
      });
  }
  return forest;
}

Forest vertex_forest(const TriangleTopology& topology) {
  domain::Star star;
  return grow_forest(topology.face_of_vertex.size(), [&](std::uint32_t v, const auto& visit) {
    domain::gather_star(topology, v, star);
    for (const auto& [face, corner] : star.corners) {
      const Triangle& t = topology.faces[face];
      visit({t[kNext[corner]], edge_number(topology, face, corner)});
      const int before = domain::kPrev[corner];
      visit({t[before], edge_number(topology, face, before)});
    }
  });
}

// Each boundary loop as a face of its own: its number for each boundary edge, from the number of
// faces on; kNone elsewhere.
std::vector<std::uint32_t> number_holes(const TriangleTopology& topology, std::uint32_t& count) {
  std::vector<std::uint32_t> edge_after(topology.face_of_vertex.size(), kNone);
  std::vector<std::uint32_t> hole(3 * topology.faces.size(), kNone);
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      if (topology.adjacent[f][k] == kNone)
        edge_after[topology.faces[f][k]] = 3 * f + static_cast<std::uint32_t>(k);
  count = static_cast<std::uint32_t>(topology.faces.size());
  for (std::uint32_t first : edge_after) {
    if (first == kNone || hole[first] != kNone) continue;
    for (std::uint32_t e = first; hole[e] == kNone;
         e = edge_after[topology.faces[e / 3][kNext[e % 3]]])
      hole[e] = count;
    ++count;
  }
  return hole;
}

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  bool unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<std::uint32_t> parent_;
};

struct LeftEdge {
  std::uint32_t edge, face, beyond;  // faces or holes on both sides
};

}  // namespace

HomologyLabels label_edges(const TriangleTopology& topology) {
  const Forest vertices = vertex_forest(topology);
  std::vector<std::uint8_t> in_tree(3 * topology.faces.size(), 0);
  for (std::uint32_t edge : vertices.parent_edge)
    if (edge != kNone) in_tree[edge] = 1;

  // Faces and holes joined across edges that are not in the tree; what closes a ring is left.
  std::uint32_t face_count = 0;
  const std::vector<std::uint32_t> hole = number_holes(topology, face_count);
  UnionFind joined(face_count);
  std::vector<std::vector<Link>> links(face_count);
  std::vector<LeftEdge> left;
  for (std::uint32_t e = 0; e < hole.size(); ++e) {
    const std::uint32_t f = e / 3, across = topology.adjacent[f][e % 3];
    const std::uint32_t beyond = across == kNone ? hole[e] : across;
    if (in_tree[e] != 0 || edge_number(topology, f, static_cast<int>(e % 3)) != e) continue;
    if (!joined.unite(f, beyond)) {
      left.push_back({e, f, beyond});
      continue;
    }
    links[f].push_back({beyond, e});
    links[beyond].push_back({f, e});
  }
  const Forest faces = grow_forest(face_count, [&](std::uint32_t f, const auto& visit) {
    for (const Link& link : links[f]) visit(link);
  });

  HomologyLabels labels;
  labels.words = (left.size() + 63) / 64;
  labels.row_of.assign(hole.size(), kNone);
  std::vector<std::uint32_t> edges, nodes;
  for (std::size_t i = 0; i < left.size(); ++i) {
    // The dual loop through the edge crosses these edges.
    faces.path_between(left[i].face, left[i].beyond, edges, nodes);
    edges.push_back(left[i].edge);
    for (std::uint32_t e : edges) {
      if (labels.row_of[e] == kNone) {
        labels.row_of[e] = static_cast<std::uint32_t>(labels.rows.size() / labels.words);
        labels.rows.resize(labels.rows.size() + labels.words, 0);
      }
      labels.rows[labels.row_of[e] * labels.words + i / 64] ^= std::uint64_t{1} << (i % 64);
    }
    const Triangle& t = topology.faces[left[i].edge / 3];
    vertices.path_between(t[left[i].edge % 3], t[kNext[left[i].edge % 3]], edges, nodes);
    labels.loop_vertices.insert(labels.loop_vertices.end(), nodes.begin(), nodes.end());
  }
  std::ranges::sort(labels.loop_vertices);
  const auto doubles = std::ranges::unique(labels.loop_vertices);
  labels.loop_vertices.erase(doubles.begin(), doubles.end());
  return labels;
}

}  // namespace zerotree::repair
