#include "domain/ear_splits.h"

namespace zerotree::domain {
namespace {

class EarSplitter {
 public:
  EarSplitter(TriangleMesh& mesh, TriangleTopology& topology) : mesh_(mesh), topology_(topology) {}

  // Replaces faces (a, b, c) and (b, a, d) of the edge a-b = edge k of `face` by two each.
  void split_edge(std::uint32_t face, int k) {
    const std::uint32_t other = topology_.adjacent[face][k];
    const int back = edge_towards(topology_, other, face);
    const std::uint32_t a = topology_.faces[face][k], b = topology_.faces[face][kNext[k]];
    const std::uint32_t middle = add_vertex((mesh_.positions[a] + mesh_.positions[b]) / 2, face);
    const std::uint32_t half = cut_in_two(face, k, middle);            // (middle, b, c)
    const std::uint32_t other_half = cut_in_two(other, back, middle);  // (middle, a, d)
    topology_.adjacent[half][0] = other;
    topology_.adjacent[other][back] = half;
    topology_.adjacent[other_half][0] = face;
    topology_.adjacent[face][k] = other_half;
  }

  // Replaces `face` by three faces around its centroid.
  void split_face(std::uint32_t face) {
    const Triangle t = topology_.faces[face];
    const std::uint32_t centre = add_vertex(
        (mesh_.positions[t[0]] + mesh_.positions[t[1]] + mesh_.positions[t[2]]) / 3, face);
    const std::uint32_t first = add_face({centre, t[1], t[2]});
    const std::uint32_t second = add_face({centre, t[2], t[0]});
    move_edge(face, 1, first, 1);
    move_edge(face, 2, second, 1);
    topology_.faces[face][2] = centre;
    mesh_.triangles[face][2] = centre;
    join(face, 1, first, 0);
    join(first, 2, second, 0);
    join(second, 2, face, 2);
    topology_.face_of_vertex[t[2]] = second;
  }

 private:
  std::uint32_t add_vertex(const Eigen::Vector3d& position, std::uint32_t face) {
    mesh_.positions.push_back(position);
    topology_.face_of_vertex.push_back(face);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }

  std::uint32_t add_face(const Triangle& corners) {
    mesh_.triangles.push_back(corners);
    topology_.faces.push_back(corners);
    topology_.adjacent.push_back({kNone, kNone, kNone});
    topology_.creases.push_back(0);
    return static_cast<std::uint32_t>(topology_.faces.size() - 1);
  }

  void join(std::uint32_t f, int k, std::uint32_t g, int l) {
    topology_.adjacent[f][k] = g;
    topology_.adjacent[g][l] = f;
  }

  // Gives edge `k` of `from`, its neighbour and its tag to edge `l` of `to`.
  void move_edge(std::uint32_t from, int k, std::uint32_t to, int l) {
    const std::uint32_t neighbour = topology_.adjacent[from][k];
    if (neighbour != kNone)
      topology_.adjacent[neighbour][edge_towards(topology_, neighbour, from)] = to;
    topology_.adjacent[to][l] = neighbour;
    const int bit = (topology_.creases[from] >> k) & 1;
    topology_.creases[to] = static_cast<std::uint8_t>(topology_.creases[to] | (bit << l));
    topology_.creases[from] = static_cast<std::uint8_t>(topology_.creases[from] & ~(1 << k));
  }

  // `face` = (a, b, c) from corner k becomes (a, middle, c); returns the new (middle, b, c).
  std::uint32_t cut_in_two(std::uint32_t face, int k, std::uint32_t middle) {
    const std::uint32_t b = topology_.faces[face][kNext[k]], c = topology_.faces[face][kPrev[k]];
    const std::uint32_t half = add_face({middle, b, c});
    move_edge(face, kNext[k], half, 1);
    topology_.faces[face][kNext[k]] = middle;
    mesh_.triangles[face][kNext[k]] = middle;
    join(half, 2, face, kNext[k]);
    topology_.face_of_vertex[b] = half;
    return half;
  }

  TriangleMesh& mesh_;
  TriangleTopology& topology_;
};

}  // namespace

std::uint32_t split_ears(TriangleMesh& mesh, TriangleTopology& topology) {
  EarSplitter splitter(mesh, topology);
  std::uint32_t added = 0;
  const std::uint32_t count = static_cast<std::uint32_t>(topology.faces.size());
  for (std::uint32_t f = 0; f < count; ++f) {
    int features = 0, free_edge = -1, boundary = 0;
    for (int k = 0; k < 3; ++k) {
      boundary += topology.adjacent[f][k] == kNone ? 1 : 0;
      if (is_feature(topology, f, k))
        ++features;
      else
        free_edge = k;
    }
    if (features < 2 || boundary == 3) continue;
    if (features == 3)
      splitter.split_face(f);
    else
      splitter.split_edge(f, free_edge);
    ++added;
  }
  return added;
}

}  // namespace zerotree::domain
