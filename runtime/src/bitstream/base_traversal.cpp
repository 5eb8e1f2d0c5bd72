#include "bitstream/base_traversal.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace zerotree::bitstream {
namespace {

std::uint32_t next_in_triangle(std::uint32_t h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
std::uint32_t previous_in_triangle(std::uint32_t h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}

std::uint32_t corner(const BaseTopology& t, std::uint32_t h) {
  return t.triangles[h / 3][h % 3];
}

/// Grows the region and writes down what it meets.
class Traverser {
 public:
  Traverser(const BaseTopology& topology, const std::vector<std::uint32_t>& opposites)
      : topology_(topology),
        opposites_(opposites),
        new_vertex_(topology.vertex_count, kNone),
        seen_(topology.triangles.size(), false),
        gate_of_(topology.triangles.size() * 3, kNone) {}

  BaseTraversal run() {
    for (std::uint32_t f = 0; f < topology_.triangles.size(); ++f) {
      if (seen_[f]) continue;
      start_component(f);
      // Gates left open after the last triangle are boundary edges: nothing need be said.
      for (std::uint32_t a; !complete() && (a = border_.next_gate()) != kNone;) step(a);
    }
    result_.has_boundary =
        std::find(opposites_.begin(), opposites_.end(), kNone) != opposites_.end();
    return std::move(result_);
  }

 private:
  bool complete() const { return result_.order.triangles.size() == topology_.triangles.size(); }

  void start_component(std::uint32_t f) {
    const std::array<std::uint32_t, 3> gates = border_.seed();
    emit_triangle(3 * f);
    for (std::uint32_t k = 0; k < 3; ++k) {
      emit_vertex(corner(topology_, 3 * f + k));
      set_gate(gates[k], 3 * f + k);
    }
  }

  void step(std::uint32_t a) {
    const std::uint32_t g = opposites_[inner_[a]];
    const GateAction action = action_at(g);
    result_.actions.push_back(action);
    const CutBorder::NewGates gates = border_.apply(a, action);
    if (action.kind == GateActionKind::kBoundary) return;
    emit_triangle(g);
    if (action.kind == GateActionKind::kNew) {
      emit_vertex(corner(topology_, previous_in_triangle(g)));
    }
    if (gates.from_u != kNone) set_gate(gates.from_u, previous_in_triangle(g));
    if (gates.to_v != kNone) set_gate(gates.to_v, next_in_triangle(g));
  }

  GateAction action_at(std::uint32_t g) const {
    if (g == kNone) return {GateActionKind::kBoundary, kNone};
    if (is_seen(opposites_[previous_in_triangle(g)])) return {GateActionKind::kLeft, kNone};
    if (is_seen(opposites_[next_in_triangle(g)])) return {GateActionKind::kRight, kNone};
    const std::uint32_t w = corner(topology_, previous_in_triangle(g));
    if (new_vertex_[w] == kNone) return {GateActionKind::kNew, kNone};
    return {GateActionKind::kJoin, node_of_sector(g)};
  }

  /// The node of w whose unseen sector holds the triangle of g = (u -> v): turns around w until a
  /// triangle of the region is met. w has one fan, so one of the two ways leads there.
  std::uint32_t node_of_sector(std::uint32_t g) const {
    for (std::uint32_t h = previous_in_triangle(g);;) {
      const std::uint32_t o = opposites_[h];
      if (o == kNone) break;
      if (is_seen(o)) return gate_of_[o];
      h = next_in_triangle(o);
    }
    for (std::uint32_t h = next_in_triangle(g);;) {
      const std::uint32_t o = opposites_[h];
      if (is_seen(o)) return border_.nodes()[gate_of_[o]].next;
      h = previous_in_triangle(o);
    }
  }

  bool is_seen(std::uint32_t h) const { return h != kNone && seen_[h / 3]; }

  void emit_triangle(std::uint32_t h) {
    seen_[h / 3] = true;
    result_.order.triangles.push_back(h / 3);
    result_.order.first_corners.push_back(static_cast<std::uint8_t>(h % 3));
  }

  void emit_vertex(std::uint32_t v) {
    new_vertex_[v] = static_cast<std::uint32_t>(result_.order.vertices.size());
    result_.order.vertices.push_back(v);
  }

  void set_gate(std::uint32_t node, std::uint32_t h) {
    if (node >= inner_.size()) inner_.resize(node + 1, kNone);
    inner_[node] = h;
    gate_of_[h] = node;
  }

  const BaseTopology& topology_;
  const std::vector<std::uint32_t>& opposites_;
  std::vector<std::uint32_t> new_vertex_;
  std::vector<bool> seen_;
  std::vector<std::uint32_t> gate_of_;  // node of the gate across a half-edge of the region
  std::vector<std::uint32_t> inner_;    // the reverse: half-edge inside the region at a node's gate
  CutBorder border_;
  BaseTraversal result_;
};

ConnectivityStatus check_corners(const BaseTopology& topology) {
  for (const auto& [a, b, c] : topology.triangles) {
    if (std::max({a, b, c}) >= topology.vertex_count) return {"a triangle names no vertex"};
    if (a == b || b == c || c == a) return {"a triangle has a vertex twice"};
  }
  return {};
}

/// Every vertex has exactly one fan: following edges around it from any corner meets all corners.
ConnectivityStatus check_fans(const BaseTopology& topology,
                              const std::vector<std::uint32_t>& opposites) {
  std::vector<std::uint32_t> corners(topology.vertex_count, 0);
  std::vector<std::uint32_t> start(topology.vertex_count, kNone);
  for (std::uint32_t h = 0; h < opposites.size(); ++h) {
    const std::uint32_t v = corner(topology, h);
    ++corners[v];
    // Begin at the boundary where there is one, so that one turn is enough.
    if (start[v] == kNone || opposites[h] == kNone) start[v] = h;
  }
  for (std::uint32_t v = 0; v < topology.vertex_count; ++v) {
    if (corners[v] == 0) return {"a vertex is in no triangle"};
    std::uint32_t met = 0;
    for (std::uint32_t h = start[v]; h != kNone;) {
      ++met;
      h = opposites[previous_in_triangle(h)];
      if (h == start[v]) break;
    }
    if (met != corners[v]) return {"a vertex has more than one fan of triangles"};
  }
  return {};
}

ConnectivityStatus check_tags(const BaseTopology& topology,
                              const std::vector<std::uint32_t>& opposites) {
  std::size_t found = 0;
  for (std::size_t i = 1; i < topology.crease_edges.size(); ++i) {
    if (!(topology.crease_edges[i - 1] < topology.crease_edges[i]))
      return {"crease edges are not ascending"};
  }
  for (std::uint32_t h = 0; h < opposites.size(); ++h) {
    if (opposites[h] == kNone || opposites[h] < h) continue;
    const auto [low, high] =
        std::minmax({corner(topology, h), corner(topology, next_in_triangle(h))});
    found += std::binary_search(topology.crease_edges.begin(), topology.crease_edges.end(),
                                std::array<std::uint32_t, 2>{low, high});
  }
  if (found != topology.crease_edges.size()) return {"a crease edge is no interior edge"};
  for (std::size_t i = 0; i < topology.corner_vertices.size(); ++i) {
    if (topology.corner_vertices[i] >= topology.vertex_count)
      return {"a corner tag names no vertex"};
    if (i > 0 && topology.corner_vertices[i - 1] >= topology.corner_vertices[i])
      return {"corner vertices are not ascending"};
  }
  return {};
}

}  // namespace

ConnectivityStatus find_opposites(const BaseTopology& topology,
                                  std::vector<std::uint32_t>& opposites) {
  struct Side {
    std::uint32_t low, high, half_edge;
  };
  const std::size_t count = topology.triangles.size() * 3;
  std::vector<Side> sides(count);
  for (std::uint32_t h = 0; h < count; ++h) {
    const auto [low, high] =
        std::minmax({corner(topology, h), corner(topology, next_in_triangle(h))});
    sides[h] = {low, high, h};
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
  });
  const auto same_edge = [&](std::size_t i, std::size_t j) {
    return j < count && sides[i].low == sides[j].low && sides[i].high == sides[j].high;
  };
  opposites.assign(count, kNone);
  for (std::size_t i = 0; i < count;) {
    if (!same_edge(i, i + 1)) {
      ++i;
      continue;
    }
    const std::uint32_t h = sides[i].half_edge, o = sides[i + 1].half_edge;
    if (same_edge(i, i + 2) || corner(topology, h) == corner(topology, o))
      return {"an edge has more than one triangle on a side"};
    opposites[h] = o;
    opposites[o] = h;
    i += 2;
  }
  return {};
}

ConnectivityStatus check_base_topology(const BaseTopology& topology) {
  if (topology.triangles.size() >= kNone / 3) return {"there are too many triangles"};
  ConnectivityStatus status = check_corners(topology);
  std::vector<std::uint32_t> opposites;
  if (status.ok()) status = find_opposites(topology, opposites);
  if (status.ok()) status = check_fans(topology, opposites);
  if (status.ok()) status = check_tags(topology, opposites);
  return status;
}

ConnectivityStatus check_base_fans(const BaseTopology& topology,
                                   const std::vector<BaseEdge>& edges) {
  std::vector<std::uint32_t> opposites(3 * topology.triangles.size(), kNone);
  for (const BaseEdge& edge : edges) {
    if (edge.faces[1] == kNone) continue;
    const std::uint32_t h = 3 * edge.faces[0] + edge.local[0];
    const std::uint32_t o = 3 * edge.faces[1] + edge.local[1];
    opposites[h] = o;
    opposites[o] = h;
  }
  return check_fans(topology, opposites);
}

BaseTraversal traverse_base(const BaseTopology& topology) {
  std::vector<std::uint32_t> opposites;
  find_opposites(topology, opposites);
  return Traverser(topology, opposites).run();
}

BaseOrder canonical_base_order(const BaseTopology& topology) {
  return traverse_base(topology).order;
}

BaseTopology reorder(const BaseTopology& topology, const BaseOrder& order) {
  std::vector<std::uint32_t> renumbered(topology.vertex_count);
  for (std::uint32_t v = 0; v < order.vertices.size(); ++v) renumbered[order.vertices[v]] = v;
  BaseTopology result;
  result.vertex_count = topology.vertex_count;
  for (std::size_t f = 0; f < order.triangles.size(); ++f) {
    std::array<std::uint32_t, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] =
          renumbered[topology.triangles[order.triangles[f]][(order.first_corners[f] + k) % 3]];
    }
    result.triangles.push_back(triangle);
  }
  for (const auto& [a, b] : topology.crease_edges) {
    const auto [low, high] = std::minmax({renumbered[a], renumbered[b]});
    result.crease_edges.push_back({low, high});
  }
  for (const std::uint32_t v : topology.corner_vertices) {
    result.corner_vertices.push_back(renumbered[v]);
  }
  std::sort(result.crease_edges.begin(), result.crease_edges.end());
  std::sort(result.corner_vertices.begin(), result.corner_vertices.end());
  return result;
}

}  // namespace zerotree::bitstream
