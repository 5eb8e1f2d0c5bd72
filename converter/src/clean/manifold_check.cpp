#include "clean/manifold_check.h"

#include "clean/half_edges.h"

namespace zerotree::clean {
namespace {

std::string check_faces(const TriangleMesh& mesh) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (std::uint32_t v : t)
      if (v >= mesh.positions.size())
        return "face " + std::to_string(f) + " names vertex " + std::to_string(v) +
               ", which does not exist";
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      return "face " + std::to_string(f) + " names a vertex twice";
  }
  return {};
}

std::string check_edges(const TriangleMesh& mesh, const EdgeTable& edges) {
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const std::uint32_t* h = edges.half_edges.data() + edges.first[e];
    const std::uint32_t count = edges.first[e + 1] - edges.first[e];
    const auto place = [&] {  // made only for a message: there are millions of edges
      return "edge " + std::to_string(tail_of(mesh.triangles, h[0])) + "-" +
             std::to_string(head_of(mesh.triangles, h[0]));
    };
    if (count > 2) return place() + " has " + std::to_string(count) + " faces";
    if (count < 2) continue;
    if (tail_of(mesh.triangles, h[0]) == tail_of(mesh.triangles, h[1]))
      return place() + " has two faces of opposite orientation";
    if (tail_of(mesh.triangles, previous_half_edge(h[0])) ==
        tail_of(mesh.triangles, previous_half_edge(h[1])))
      return place() + " has two faces of the same vertices";
  }
  return {};
}

// Every vertex has as many half-edges leaving it as its one fan has.
std::string check_fans(const TriangleMesh& mesh, const std::vector<std::uint32_t>& mates) {
  std::vector<std::uint32_t> leaving(mesh.positions.size(), 0);
  std::vector<std::uint32_t> first(mesh.positions.size(), no_half_edge);
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    const std::uint32_t v = tail_of(mesh.triangles, h);
    ++leaving[v];
    // A fan with a boundary is counted from the half-edge that has nothing clockwise of it.
    if (first[v] == no_half_edge || mates[h] == no_half_edge) first[v] = h;
  }
  for (std::uint32_t v = 0; v < leaving.size(); ++v) {
    if (leaving[v] == 0) return "vertex " + std::to_string(v) + " has no face";
    std::uint32_t counted = 1;
    for (std::uint32_t h = mates[previous_half_edge(first[v])];
         h != no_half_edge && h != first[v] && counted <= leaving[v];
         h = mates[previous_half_edge(h)])
      ++counted;
    if (counted != leaving[v]) return "vertex " + std::to_string(v) + " has several fans of faces";
  }
  return {};
}

std::uint32_t label_components(const std::vector<std::uint32_t>& mates,
                               std::vector<std::uint32_t>& component) {
  constexpr std::uint32_t unknown = 0xffffffffu;
  component.assign(mates.size() / 3, unknown);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> open;
  for (std::uint32_t f = 0; f < component.size(); ++f) {
    if (component[f] != unknown) continue;
    component[f] = count;
    open.assign(1, f);
    while (!open.empty()) {
      const std::uint32_t face = open.back();
      open.pop_back();
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t mate = mates[3 * face + k];
        if (mate == no_half_edge || component[mate / 3] != unknown) continue;
        component[mate / 3] = count;
        open.push_back(mate / 3);
      }
    }
    ++count;
  }
  return count;
}

// The boundary half-edge that begins where h, another one, ends.
std::uint32_t next_on_boundary(const std::vector<std::uint32_t>& mates, std::uint32_t h) {
  h = next_half_edge(h);
  while (mates[h] != no_half_edge) h = next_half_edge(mates[h]);
  return h;
}

// Finds the mates only where faces and edges are as they should be.
std::string check(const TriangleMesh& mesh, std::vector<std::uint32_t>& mates) {
  std::string problem = check_faces(mesh);
  if (!problem.empty()) return problem;
  const EdgeTable edges = make_edge_table(mesh.triangles, mesh.positions.size());
  problem = check_edges(mesh, edges);
  if (!problem.empty()) return problem;
  mates = find_mates(edges);
  return check_fans(mesh, mates);
}

SurfaceTopology measure(const TriangleMesh& mesh, const std::vector<std::uint32_t>& mates) {
  SurfaceTopology result;
  result.component_count = label_components(mates, result.face_component);
  std::vector<std::uint8_t> seen(mates.size(), 0);
  for (std::uint32_t start = 0; start < mates.size(); ++start) {
    if (mates[start] != no_half_edge || seen[start] != 0) continue;
    ++result.boundary_loops;
    for (std::uint32_t h = start; seen[h] == 0; h = next_on_boundary(mates, h)) {
      seen[h] = 1;
      ++result.boundary_edges;
    }
  }
  const auto faces = static_cast<std::int64_t>(mesh.triangles.size());
  const auto edges = (3 * faces + static_cast<std::int64_t>(result.boundary_edges)) / 2;
  result.euler_characteristic = static_cast<std::int64_t>(mesh.positions.size()) - edges + faces;
  result.genus = (2 * static_cast<std::int64_t>(result.component_count) -
                  static_cast<std::int64_t>(result.boundary_loops) - result.euler_characteristic) /
                 2;
  return result;
}

}  // namespace

std::string check_manifold(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> mates;
  return check(mesh, mates);
}

SurfaceTopology measure_topology(const TriangleMesh& mesh) {
  return measure(mesh, find_mates(mesh.triangles, mesh.positions.size()));
}

SurfaceInspection inspect_surface(const TriangleMesh& mesh) {
  SurfaceInspection inspection;
  std::vector<std::uint32_t> mates;
  inspection.problem = check(mesh, mates);
  if (inspection.problem.empty()) inspection.topology = measure(mesh, mates);
  return inspection;
}

}  // namespace zerotree::clean
