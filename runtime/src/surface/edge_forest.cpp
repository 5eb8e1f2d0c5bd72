#include "surface/edge_forest.h"

namespace zerotree::surface {

namespace {

using bitstream::kNone;

/// An edge of a face: which one, and whether the face lies to the left of the directed edge.
struct FaceSide {
  int face;
  int local;
  bool is_left;
};

template <class Visit>
void for_each_side(const RefinerLevel& level, const EdgeLevel& edges, int edge,
                   const Visit& visit) {
  const auto faces = level.GetEdgeFaces(edge);
  const auto locals = level.GetEdgeFaceLocalIndices(edge);
  const auto tail = static_cast<int>(edges.vertices[static_cast<std::size_t>(edge)][0]);
  for (int side = 0; side < faces.size(); ++side) {
    const int from = level.GetFaceVertices(faces[side])[locals[side]];
    visit(FaceSide{faces[side], locals[side], from == tail});
  }
}

void fill_wings(const RefinerLevel& level, EdgeLevel& edges) {
  edges.wings.assign(edges.vertices.size(), {kNone, kNone, kNone, kNone});
  for (int edge = 0; edge < level.GetNumEdges(); ++edge) {
    auto& wings = edges.wings[static_cast<std::size_t>(edge)];
    for_each_side(level, edges, edge, [&](const FaceSide& side) {
      const auto around = level.GetFaceEdges(side.face);
      const auto next = static_cast<std::uint32_t>(around[(side.local + 1) % 3]);
      const auto last = static_cast<std::uint32_t>(around[(side.local + 2) % 3]);
      // In the left face the edge runs with the face, so the last edge ends at its tail.
      wings[side.is_left ? 0 : 2] = side.is_left ? last : next;
      wings[side.is_left ? 1 : 3] = side.is_left ? next : last;
    });
  }
}

/// The four children of each parent edge by digit.
using Children = std::vector<std::array<std::uint32_t, 4>>;

Children children_of(const RefinerLevel& parent, const EdgeLevel& parent_edges,
                     const RefinerLevel& child) {
  Children children(parent_edges.vertices.size(), {kNone, kNone, kNone, kNone});
  const int first_half = 3 * parent.GetNumFaces();
  for (int edge = 0; edge < parent.GetNumEdges(); ++edge) {
    auto& digits = children[static_cast<std::size_t>(edge)];
    const auto tail = static_cast<int>(parent_edges.vertices[static_cast<std::size_t>(edge)][0]);
    for (const int half : {first_half + 2 * edge, first_half + 2 * edge + 1}) {
      const auto ends = child.GetEdgeVertices(half);
      const bool at_tail = ends[0] == tail || ends[1] == tail;
      digits[at_tail ? 0 : 3] = static_cast<std::uint32_t>(half);
    }
    for_each_side(parent, parent_edges, edge, [&](const FaceSide& side) {
      digits[side.is_left ? 2 : 1] =
          static_cast<std::uint32_t>(3 * side.face + (side.local + 2) % 3);
    });
  }
  return children;
}

}  // namespace

EdgeLevel base_edge_level(const RefinerLevel& base,
                          const std::vector<bitstream::BaseEdge>& base_edges) {
  EdgeLevel edges;
  edges.vertices.resize(base_edges.size());
  for (const bitstream::BaseEdge& edge : base_edges) {
    const auto number = static_cast<std::uint32_t>(
        base.FindEdge(static_cast<int>(edge.vertices[0]), static_cast<int>(edge.vertices[1])));
    edges.cell_to_edge.push_back(number);
    edges.vertices[number] = edge.vertices;
  }
  fill_wings(base, edges);
  return edges;
}

EdgeLevel child_edge_level(const RefinerLevel& parent, const EdgeLevel& parent_edges,
                           const RefinerLevel& child) {
  const Children children = children_of(parent, parent_edges, child);
  const auto first_odd = static_cast<std::uint32_t>(parent.GetNumVertices());
  EdgeLevel edges;
  edges.vertices.resize(static_cast<std::size_t>(child.GetNumEdges()));
  for (std::size_t edge = 0; edge < children.size(); ++edge) {
    const auto [tail, head] = parent_edges.vertices[edge];
    const auto& wings = parent_edges.wings[edge];
    const auto& digits = children[edge];
    const std::uint32_t middle = first_odd + static_cast<std::uint32_t>(edge);
    edges.vertices[digits[0]] = {tail, middle};
    edges.vertices[digits[3]] = {middle, head};
    if (digits[2] != kNone)
      edges.vertices[digits[2]] = {first_odd + wings[0], first_odd + wings[1]};
    if (digits[1] != kNone)
      edges.vertices[digits[1]] = {first_odd + wings[2], first_odd + wings[3]};
  }
  edges.cell_to_edge.assign(4 * parent_edges.cell_to_edge.size(), kNone);
  for (std::size_t cell = 0; cell < parent_edges.cell_to_edge.size(); ++cell) {
    const std::uint32_t edge = parent_edges.cell_to_edge[cell];
    if (edge == kNone) continue;
    for (std::size_t digit = 0; digit < 4; ++digit)
      edges.cell_to_edge[4 * cell + digit] = children[edge][digit];
  }
  fill_wings(child, edges);
  return edges;
}

}  // namespace zerotree::surface
