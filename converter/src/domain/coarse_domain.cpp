#include "domain/coarse_domain.h"

#include <algorithm>

namespace zerotree::domain {
namespace {

// The faces that were there after the first `keep` collapses, ascending.
std::vector<std::uint32_t> faces_after(const Domain& fine, std::size_t keep) {
  std::vector<std::uint32_t> faces = fine.base_faces;
  for (std::size_t i = keep; i < fine.collapses.size(); ++i)
    for (std::uint32_t face : {fine.collapses[i].left, fine.collapses[i].right})
      if (face != kNone) faces.push_back(face);
  std::ranges::sort(faces);
  return faces;
}

// A removed vertex is still named by the faces that went with it.
std::vector<std::uint32_t> vertices_of(const Domain& fine,
                                       const std::vector<std::uint32_t>& faces) {
  std::vector<std::uint8_t> is_named(fine.kinds.size(), 0);
  for (std::uint32_t f : faces)
    for (std::uint32_t v : fine.topology.faces[f]) is_named[v] = 1;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < is_named.size(); ++v)
    if (is_named[v] != 0) vertices.push_back(v);
  return vertices;
}

// Of each of the `count` fine numbers the coarse one, kNone if it has none.
std::vector<std::uint32_t> invert(const std::vector<std::uint32_t>& fine_numbers,
                                  std::size_t count) {
  std::vector<std::uint32_t> coarse(count, kNone);
  for (std::uint32_t i = 0; i < fine_numbers.size(); ++i) coarse[fine_numbers[i]] = i;
  return coarse;
}

}  // namespace

CoarseDomain extract_coarse(const Domain& fine, std::size_t keep) {
  CoarseDomain result;
  result.faces = faces_after(fine, keep);
  result.vertices = vertices_of(fine, result.faces);
  const std::vector<std::uint32_t> faces = invert(result.faces, fine.topology.faces.size());
  const std::vector<std::uint32_t> vertices = invert(result.vertices, fine.kinds.size());
  const auto face = [&](std::uint32_t f) { return f == kNone ? kNone : faces[f]; };

  Domain& coarse = result.domain;
  for (std::uint32_t v : result.vertices) {
    coarse.mesh.positions.push_back(fine.mesh.positions[v]);
    coarse.kinds.push_back(fine.kinds[v]);
    coarse.topology.face_of_vertex.push_back(face(fine.topology.face_of_vertex[v]));
  }
  for (std::uint32_t f : result.faces) {
    const auto& [a, b, c] = fine.topology.faces[f];
    const auto& [p, q, r] = fine.topology.adjacent[f];
    coarse.topology.faces.push_back({vertices[a], vertices[b], vertices[c]});
    coarse.topology.adjacent.push_back({face(p), face(q), face(r)});
    coarse.topology.creases.push_back(fine.topology.creases[f]);
  }
  for (std::size_t i = keep; i < fine.collapses.size(); ++i) {
    const auto [removed, kept, left, right] = fine.collapses[i];
    coarse.collapses.push_back({vertices[removed], vertices[kept], face(left), face(right)});
  }
  for (std::uint32_t f : fine.base_faces) coarse.base_faces.push_back(faces[f]);
  coarse.report = fine.report;
  TriangleTopology whole = coarse.topology;
  std::vector<std::uint32_t> fan;
  for (std::size_t i = coarse.collapses.size(); i-- > 0;)
    undo_collapse(whole, coarse.collapses[i], fan);
  coarse.mesh.triangles = std::move(whole.faces);
  return result;
}

std::vector<std::uint32_t> to_coarse(const CoarseDomain& coarse,
                                     const std::vector<std::uint32_t>& vertices) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t v : vertices) {
    const auto at = std::ranges::lower_bound(coarse.vertices, v);
    if (at != coarse.vertices.end() && *at == v)
      found.push_back(static_cast<std::uint32_t>(at - coarse.vertices.begin()));
  }
  return found;
}

}  // namespace zerotree::domain
