#include "clean/vertex_fans.h"

#include "clean/half_edges.h"

namespace zerotree::clean {
namespace {

std::uint32_t add_vertex(WorkingMesh& mesh, const Eigen::Vector3d& position, std::uint32_t source) {
  mesh.positions.push_back(position);
  mesh.source_vertex.push_back(source);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

// The half-edges that leave the same vertex in the fan of `start`.
void collect_fan(const std::vector<std::uint32_t>& mates, std::uint32_t start,
                 std::vector<std::uint32_t>& fan) {
  fan.assign(1, start);
  while (true) {  // counter-clockwise, up to a boundary or all the way round
    const std::uint32_t h = mates[previous_half_edge(fan.back())];
    if (h == start) return;
    if (h == no_half_edge) break;
    fan.push_back(h);
  }
  for (std::uint32_t h = mates[start]; h != no_half_edge;) {
    h = next_half_edge(h);
    fan.push_back(h);
    h = mates[h];
  }
}

// Cuts face h / 3 from the middle of half-edge h, at vertex `middle`, to the opposite corner. The
// new face is the last one: its half-edges are middle -> head, head -> opposite, opposite ->
// middle.
void cut_face(WorkingMesh& mesh, std::vector<std::uint32_t>& mates, std::uint32_t h,
              std::uint32_t middle) {
  const std::uint32_t head = head_of(mesh.triangles, h);
  const std::uint32_t opposite = tail_of(mesh.triangles, previous_half_edge(h));
  const std::uint32_t next = next_half_edge(h);
  const auto made = static_cast<std::uint32_t>(mesh.triangles.size() * 3);
  mesh.triangles.push_back({middle, head, opposite});
  mesh.source_face.push_back(mesh.source_face[h / 3]);
  mesh.triangles[h / 3][next % 3] = middle;
  mates.insert(mates.end(), {no_half_edge, mates[next], next});
  if (mates[next] != no_half_edge) mates[mates[next]] = made + 1;
  mates[next] = made + 2;
}

void divide_edge(WorkingMesh& mesh, std::vector<std::uint32_t>& mates, std::uint32_t h) {
  const std::uint32_t a = tail_of(mesh.triangles, h), b = head_of(mesh.triangles, h);
  const std::uint32_t middle =
      add_vertex(mesh, 0.5 * mesh.positions[a] + 0.5 * mesh.positions[b], mesh.source_vertex[a]);
  const std::uint32_t g = mates[h];
  const auto h_rest = static_cast<std::uint32_t>(mesh.triangles.size() * 3);
  cut_face(mesh, mates, h, middle);
  if (g == no_half_edge) return;
  const auto g_rest = static_cast<std::uint32_t>(mesh.triangles.size() * 3);
  cut_face(mesh, mates, g, middle);
  mates[h] = g_rest;
  mates[g_rest] = h;
  mates[g] = h_rest;
  mates[h_rest] = g;
}

}  // namespace

std::uint64_t split_vertex_fans(WorkingMesh& mesh, const std::vector<std::uint32_t>& mates) {
  std::vector<std::uint8_t> done(mates.size(), 0);
  std::vector<std::uint8_t> has_fan(mesh.positions.size(), 0);
  std::vector<std::uint32_t> fan;
  std::uint64_t added = 0;
  for (std::uint32_t start = 0; start < mates.size(); ++start) {
    if (done[start] != 0) continue;
    collect_fan(mates, start, fan);
    const std::uint32_t vertex = tail_of(mesh.triangles, start);
    std::uint32_t own = vertex;
    if (has_fan[vertex] != 0) {
      const Eigen::Vector3d position = mesh.positions[vertex];
      own = add_vertex(mesh, position, mesh.source_vertex[vertex]);
      ++added;
    }
    has_fan[vertex] = 1;
    for (std::uint32_t h : fan) {
      done[h] = 1;
      mesh.triangles[h / 3][h % 3] = own;
    }
  }
  return added;
}

std::uint64_t divide_shared_edges(WorkingMesh& mesh, std::vector<std::uint32_t>& mates) {
  std::uint64_t divided = 0;
  // Dividing renumbers half-edges of the faces that it cuts, so each round leaves those alone that
  // it has cut, or made, already; a round that skips some has cut others, so this ends.
  for (bool again = true; again;) {
    again = false;
    const EdgeTable edges = make_edge_table(mesh.triangles, mesh.positions.size());
    std::vector<std::uint8_t> cut(mesh.triangles.size(), 0);
    const auto is_cut = [&cut](std::uint32_t h) {
      return h != no_half_edge && (h / 3 >= cut.size() || cut[h / 3] != 0);
    };
    for (std::size_t e = 0; e < edges.edge_count(); ++e) {
      const std::uint32_t kept = edges.half_edges[edges.first[e]];
      for (std::uint32_t i = edges.first[e] + 1; i < edges.first[e + 1]; ++i) {
        const std::uint32_t h = edges.half_edges[i], g = mates[h];
        if (g == kept) continue;
        again = true;
        if (is_cut(h) || is_cut(g) || is_cut(kept)) continue;
        divide_edge(mesh, mates, h);
        cut[h / 3] = 1;
        if (g != no_half_edge) cut[g / 3] = 1;
        ++divided;
      }
    }
  }
  return divided;
}

}  // namespace zerotree::clean
