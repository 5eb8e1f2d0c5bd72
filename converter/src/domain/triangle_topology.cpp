#include "domain/triangle_topology.h"

#include <algorithm>
#include <numeric>

#include "mesh/error.h"

namespace zerotree::domain {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ExitCode::refused_topology,
              what + "; the mesh must be a clean oriented manifold before it gets a base mesh");
}

// The corners of each vertex, one list after the other.
struct CornerLists {
  std::vector<std::uint32_t> begin;    // per vertex, and the end of the last
  std::vector<std::uint32_t> corners;  // 3 * face + corner
};

CornerLists list_corners(std::uint32_t vertex_count, const std::vector<Triangle>& faces) {
  CornerLists lists;
  lists.begin.assign(vertex_count + 1, 0);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::uint32_t v : faces[f]) {
      if (v >= vertex_count) refuse("face " + std::to_string(f) + " names a missing vertex");
      ++lists.begin[v + 1];
    }
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  lists.corners.resize(3 * faces.size());
  std::vector<std::uint32_t> end(lists.begin.begin(), lists.begin.end() - 1);
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (std::uint32_t k = 0; k < 3; ++k) lists.corners[end[faces[f][k]]++] = 3 * f + k;
  return lists;
}

}  // namespace

TriangleTopology build_topology(std::uint32_t vertex_count, const std::vector<Triangle>& faces) {
  const CornerLists lists = list_corners(vertex_count, faces);
  TriangleTopology topology;
  topology.faces = faces;
  topology.adjacent.assign(faces.size(), {kNone, kNone, kNone});
  topology.creases.assign(faces.size(), 0);
  topology.face_of_vertex.resize(vertex_count);
  // An edge a -> b of one face is b -> a in its neighbour: look among the edges that leave b.
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = faces[f][k], b = faces[f][kNext[k]];
      for (std::uint32_t i = lists.begin[b]; i < lists.begin[b + 1]; ++i) {
        const std::uint32_t g = lists.corners[i] / 3, corner = lists.corners[i] % 3;
        if (faces[g][(corner + 1) % 3] != a) continue;
        if (topology.adjacent[f][k] != kNone)
          refuse("edge " + std::to_string(a) + "-" + std::to_string(b) +
                 " has more than two faces or two of unlike orientation");
        topology.adjacent[f][k] = g;
      }
    }
  Star star;
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    const std::uint32_t count = lists.begin[v + 1] - lists.begin[v];
    if (count == 0) refuse("vertex " + std::to_string(v) + " has no face");
    topology.face_of_vertex[v] = lists.corners[lists.begin[v]] / 3;
    gather_star(topology, v, star);
    if (star.corners.size() != count)
      refuse("the faces of vertex " + std::to_string(v) + " form more than one fan");
  }
  return topology;
}

void gather_star(const TriangleTopology& topology, std::uint32_t vertex, Star& star) {
  star.corners.clear();
  const std::uint32_t first = topology.face_of_vertex[vertex];
  std::uint32_t face = first;
  do {
    const int corner = corner_of(topology.faces[face], vertex);
    star.corners.push_back({face, corner});
    // All three are read, so that this does not wait for the corner.
    const auto [over_0, over_1, over_2] = topology.adjacent[face];
    face = corner == 0 ? over_2 : corner == 1 ? over_0 : over_1;
  } while (face != kNone && face != first);
  star.closed = face == first;
  if (star.closed) return;
  // An open star begins at the boundary: the faces clockwise of the first come before it.
  const std::size_t from_first = star.corners.size();
  for (face = topology.adjacent[first][star.corners.front().corner]; face != kNone;) {
    const int corner = corner_of(topology.faces[face], vertex);
    star.corners.push_back({face, corner});
    face = topology.adjacent[face][corner];
  }
  const auto middle = star.corners.begin() + static_cast<std::ptrdiff_t>(from_first);
  std::reverse(middle, star.corners.end());
  std::rotate(star.corners.begin(), middle, star.corners.end());
}

}  // namespace zerotree::domain
