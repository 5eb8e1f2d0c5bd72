#include "bitstream/cut_border.h"

#include <algorithm>

namespace zerotree::bitstream {

std::size_t CutBorder::bucket(std::uint32_t node) const {
  return std::min<std::size_t>(degree_[nodes_[node].vertex], kBuckets - 1);
}

std::uint32_t CutBorder::add_node(std::uint32_t vertex) {
  nodes_.push_back({vertex, kNone, kNone, true, true});
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

std::uint32_t CutBorder::add_vertex() {
  degree_.push_back(0);
  return static_cast<std::uint32_t>(degree_.size() - 1);
}

void CutBorder::link(std::uint32_t from, std::uint32_t to) {
  nodes_[from].next = to;
  nodes_[to].previous = from;
}

void CutBorder::enqueue(std::uint32_t node) {
  queue_[bucket(node)].push_back(node);
}

std::array<std::uint32_t, 3> CutBorder::seed() {
  std::array<std::uint32_t, 3> corner;
  for (std::uint32_t& c : corner) c = add_node(add_vertex());
  const auto [a, b, c] = corner;
  // Seen from outside the triangle its edges run backwards: a -> c -> b -> a.
  link(a, c);
  link(c, b);
  link(b, a);
  for (const std::uint32_t node : corner) degree_[nodes_[node].vertex] = 2;
  for (const std::uint32_t node : corner) enqueue(node);
  focus_ = a;
  return {b, c, a};
}

std::uint32_t CutBorder::next_gate() {
  if (focus_ != kNone && is_open(focus_)) return focus_;
  for (std::size_t k = kBuckets; k-- > 0;) {
    while (!queue_[k].empty()) {
      const std::uint32_t node = queue_[k].back();
      queue_[k].pop_back();
      if (!is_open(node)) continue;
      if (bucket(node) == k) return focus_ = node;
      enqueue(node);  // degrees only grow: it moves to a bucket above and is met there
      k = bucket(node) + 1;
      break;
    }
  }
  return focus_ = kNone;
}

bool CutBorder::allows(std::uint32_t a, GateAction action) const {
  const std::uint32_t b = nodes_[a].next;
  const std::uint32_t p = nodes_[a].previous;
  const std::uint32_t n = nodes_[b].next;
  switch (action.kind) {
    case GateActionKind::kBoundary:
    case GateActionKind::kNew:
      return true;
    case GateActionKind::kLeft:
      // In a loop of three the new edge p -> v meets the gate v -> p.
      return nodes_[p].open && (n != p || nodes_[b].open);
    case GateActionKind::kRight:
      return n != p && nodes_[b].open;
    case GateActionKind::kJoin: {
      const std::uint32_t c = action.node;
      if (c >= nodes_.size() || !nodes_[c].alive || c == a || c == b || c == p || c == n)
        return false;
      const std::uint32_t w = nodes_[c].vertex;
      return w != nodes_[a].vertex && w != nodes_[b].vertex;
    }
  }
  return false;
}

std::uint32_t CutBorder::apex(std::uint32_t a, GateAction action) const {
  switch (action.kind) {
    case GateActionKind::kBoundary:
      return kNone;
    case GateActionKind::kLeft:
      return nodes_[nodes_[a].previous].vertex;
    case GateActionKind::kRight:
      return nodes_[nodes_[nodes_[a].next].next].vertex;
    case GateActionKind::kNew:
      return vertex_count();
    case GateActionKind::kJoin:
      return nodes_[action.node].vertex;
  }
  return kNone;
}

void CutBorder::close_if_pair(std::uint32_t node, NewGates& gates) {
  const std::uint32_t other = nodes_[node].next;
  if (nodes_[other].next != node) return;
  nodes_[node].alive = nodes_[other].alive = false;
  --degree_[nodes_[node].vertex];  // the two gates are one edge, counted twice
  --degree_[nodes_[other].vertex];
  gates = {kNone, kNone};
}

CutBorder::NewGates CutBorder::close_fan(std::uint32_t removed, std::uint32_t from,
                                         std::uint32_t to) {
  nodes_[removed].alive = false;
  link(from, to);
  ++degree_[nodes_[from].vertex];
  ++degree_[nodes_[to].vertex];
  NewGates gates{from, from};
  close_if_pair(from, gates);
  if (nodes_[from].alive) enqueue(from);
  if (nodes_[to].alive) enqueue(to);
  return gates;
}

CutBorder::NewGates CutBorder::insert(std::uint32_t a, GateAction action) {
  const std::uint32_t b = nodes_[a].next;
  const bool join = action.kind == GateActionKind::kJoin;
  const std::uint32_t w = join ? nodes_[action.node].vertex : add_vertex();
  // The node before v; at a join the old node of w keeps its gate and follows u.
  const std::uint32_t before_v = add_node(w);
  if (join) {
    link(nodes_[action.node].previous, before_v);
    link(a, action.node);
  } else {
    link(a, before_v);
  }
  link(before_v, b);
  degree_[w] += 2;
  ++degree_[nodes_[a].vertex];
  ++degree_[nodes_[b].vertex];
  enqueue(b);
  if (join) enqueue(action.node);
  enqueue(before_v);
  enqueue(a);
  return {a, before_v};
}

CutBorder::NewGates CutBorder::apply(std::uint32_t a, GateAction action) {
  const std::uint32_t b = nodes_[a].next;
  switch (action.kind) {
    case GateActionKind::kBoundary:
      nodes_[a].open = false;
      return {kNone, kNone};
    case GateActionKind::kLeft: {
      NewGates gates = close_fan(a, nodes_[a].previous, b);
      gates.from_u = kNone;
      // `from` keeps its gate slot: it was p -> u, closed now, and becomes p -> v.
      return gates;
    }
    case GateActionKind::kRight: {
      NewGates gates = close_fan(b, a, nodes_[b].next);
      gates.to_v = kNone;
      return gates;
    }
    case GateActionKind::kNew:
    case GateActionKind::kJoin:
      return insert(a, action);
  }
  return {kNone, kNone};
}

}  // namespace zerotree::bitstream
