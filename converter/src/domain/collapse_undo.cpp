#include "domain/domain.h"

namespace zerotree::domain {
namespace {

// The face of the fan beside the gap that `gone` left.
std::uint32_t inner_face(const TriangleTopology& topology, const CollapseRecord& collapse,
                         bool is_left) {
  const std::uint32_t gone = is_left ? collapse.left : collapse.right;
  const int k = corner_of(topology.faces[gone], collapse.removed);
  return topology.adjacent[gone][is_left ? kPrev[k] : k];
}

// Puts the face of a gap back between the fan and the face beyond.
void open_gap(TriangleTopology& topology, const CollapseRecord& collapse, bool is_left) {
  const std::uint32_t gone = is_left ? collapse.left : collapse.right;
  if (gone == kNone) return;
  const std::uint32_t inner = inner_face(topology, collapse, is_left);
  const int k = corner_of(topology.faces[inner], collapse.kept);
  const int edge = is_left ? k : kPrev[k];
  const std::uint32_t outer = topology.adjacent[inner][edge];
  if (outer != kNone) topology.adjacent[outer][edge_towards(topology, outer, inner)] = gone;
  topology.adjacent[inner][edge] = gone;
  // The edge between the faces of the gap and the fan is never a feature (is_chain_step).
  topology.creases[inner] = static_cast<std::uint8_t>(topology.creases[inner] & ~(1 << edge));
  topology.face_of_vertex[collapse.kept] = gone;
}

}  // namespace

void find_collapsed_fan(const TriangleTopology& topology, const CollapseRecord& collapse,
                        std::vector<std::uint32_t>& fan) {
  fan.clear();
  const bool from_left = collapse.left != kNone;
  const std::uint32_t last =
      collapse.right != kNone ? inner_face(topology, collapse, false) : kNone;
  std::uint32_t face = from_left ? inner_face(topology, collapse, true) : last;
  // Without a left face the fan begins at the boundary: go there clockwise.
  while (!from_left) {
    const int k = corner_of(topology.faces[face], collapse.kept);
    if (topology.adjacent[face][k] == kNone) break;
    face = topology.adjacent[face][k];
  }
  while (true) {
    fan.push_back(face);
    if (face == last) break;
    face = topology.adjacent[face][kPrev[corner_of(topology.faces[face], collapse.kept)]];
    if (face == kNone) break;
  }
}

void undo_collapse(TriangleTopology& topology, const CollapseRecord& collapse,
                   std::vector<std::uint32_t>& fan) {
  find_collapsed_fan(topology, collapse, fan);
  open_gap(topology, collapse, true);
  open_gap(topology, collapse, false);
  for (std::uint32_t f : fan) {
    Triangle& corners = topology.faces[f];
    corners[corner_of(corners, collapse.kept)] = collapse.removed;
  }
  topology.face_of_vertex[collapse.removed] = fan.front();
}

}  // namespace zerotree::domain
