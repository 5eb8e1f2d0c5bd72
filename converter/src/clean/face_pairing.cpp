#include "clean/face_pairing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <tuple>

#include "clean/half_edges.h"
#include "mesh/error.h"

namespace zerotree::clean {
namespace {

using Eigen::Vector3d;

// More faces at one edge than this are no surface; they are cut apart without looking for pairs,
// whose number grows with the square.
constexpr std::size_t most_faces_paired = 64;

// Two faces that run along their common edge in the same direction are turned against each other.
bool same_direction(const WorkingMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return tail_of(mesh.triangles, a) == tail_of(mesh.triangles, b);
}

void join(FacePairing& pairing, std::uint32_t a, std::uint32_t b) {
  pairing.mates[a] = b;
  pairing.mates[b] = a;
}

[[noreturn]] void refuse_one_sided(const WorkingMesh& mesh, std::uint32_t h) {
  const std::uint32_t vertex = tail_of(mesh.triangles, h);
  const Vector3d p = mesh.positions[vertex] + Vector3d::Zero();  // no "-0"
  std::ostringstream message;
  message << "the surface is one-sided (like a Moebius strip): it cannot be oriented at face "
          << mesh.source_face[h / 3] << ", vertex " << mesh.source_vertex[vertex]
          << " (both counted from 0) at (" << p.x() << ", " << p.y() << ", " << p.z()
          << "); cut the surface open there or remove the face";
  throw Error(ExitCode::refused_topology, message.str());
}

// Direction from the edge of half-edge h into its face, perpendicular to the edge.
Vector3d inward(const WorkingMesh& mesh, std::uint32_t h) {
  const Vector3d& a = mesh.positions[tail_of(mesh.triangles, h)];
  const Vector3d edge = (mesh.positions[head_of(mesh.triangles, h)] - a).normalized();
  const Vector3d side = mesh.positions[tail_of(mesh.triangles, previous_half_edge(h))] - a;
  return (side - edge * edge.dot(side)).normalized();
}

struct Candidate {
  bool disagrees = false;
  // Cosine of the angle between the faces in millionths: -1000000 is flat. Rounded, so that equal
  // angles tie and the faces' own connection decides.
  long bend = 0;
  bool other_patch = false;
  std::uint32_t a = 0, b = 0;
  auto key() const { return std::tuple(disagrees, bend, other_patch, a, b); }
};

void pair_many(const WorkingMesh& mesh, std::span<const std::uint32_t> half_edges,
               const std::vector<std::uint8_t>& turned, FacePairing& pairing) {
  std::vector<Vector3d> directions;
  for (std::uint32_t h : half_edges) directions.push_back(inward(mesh, h));
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < half_edges.size(); ++i) {
    for (std::size_t j = i + 1; j < half_edges.size(); ++j) {
      const std::uint32_t a = half_edges[i], b = half_edges[j];
      Candidate c{false, 0, false, a, b};
      c.disagrees = same_direction(mesh, a, b) == (turned[a / 3] == turned[b / 3]);
      c.bend = std::lround(directions[i].dot(directions[j]) * 1e6);
      c.other_patch = pairing.forest.find(a / 3).first != pairing.forest.find(b / 3).first;
      candidates.push_back(c);
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& x, const Candidate& y) { return x.key() < y.key(); });
  for (const Candidate& c : candidates) {
    if (pairing.mates[c.a] != no_half_edge || pairing.mates[c.b] != no_half_edge) continue;
    if (pairing.forest.unite(c.a / 3, c.b / 3, same_direction(mesh, c.a, c.b)))
      join(pairing, c.a, c.b);
  }
}

}  // namespace

FacePairing pair_faces(const WorkingMesh& mesh) {
  FacePairing pairing{std::vector<std::uint32_t>(mesh.triangles.size() * 3, no_half_edge),
                      OrientationForest(mesh.triangles.size()), 0};
  const EdgeTable edges = make_edge_table(mesh.triangles, mesh.positions.size());
  const auto at_edge = [&](std::size_t e) {
    return std::span(edges.half_edges).subspan(edges.first[e], edges.first[e + 1] - edges.first[e]);
  };
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto half_edges = at_edge(e);
    if (half_edges.size() != 2) continue;
    const std::uint32_t a = half_edges[0], b = half_edges[1];
    if (!pairing.forest.unite(a / 3, b / 3, same_direction(mesh, a, b))) refuse_one_sided(mesh, a);
    join(pairing, a, b);
  }
  const std::vector<std::uint8_t> turned = turn_to_majority(pairing.forest, mesh.triangles.size());
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto half_edges = at_edge(e);
    if (half_edges.size() <= 2) continue;
    ++pairing.non_manifold_edges;
    if (half_edges.size() <= most_faces_paired) pair_many(mesh, half_edges, turned, pairing);
  }
  return pairing;
}

}  // namespace zerotree::clean
