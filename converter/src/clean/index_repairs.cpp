#include "clean/index_repairs.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "mesh/error.h"

namespace zerotree::clean {
namespace {

// Keeps the faces for which `keep` is not zero, in order; returns how many went.
std::uint64_t keep_faces(WorkingMesh& mesh, const std::vector<std::uint8_t>& keep) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (keep[f] == 0) continue;
    mesh.triangles[kept] = mesh.triangles[f];
    mesh.source_face[kept++] = mesh.source_face[f];
  }
  const std::uint64_t dropped = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  mesh.source_face.resize(kept);
  return dropped;
}

}  // namespace

void check_input(const TriangleMesh& input) {
  for (std::size_t v = 0; v < input.positions.size(); ++v)
    if (!input.positions[v].allFinite())
      throw Error(ExitCode::unreadable_input,
                  "vertex " + std::to_string(v) +
                      " has a coordinate that is not a finite number; repair the mesh");
  for (std::size_t f = 0; f < input.triangles.size(); ++f)
    for (std::uint32_t v : input.triangles[f])
      if (v >= input.positions.size())
        throw Error(ExitCode::unreadable_input, "face " + std::to_string(f) + " names vertex " +
                                                    std::to_string(v) + ", but there are " +
                                                    std::to_string(input.positions.size()) +
                                                    "; repair the mesh");
}

std::uint64_t weld_equal_positions(WorkingMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Eigen::Vector3d &p = mesh.positions[a], &q = mesh.positions[b];
    for (int i = 0; i < 3; ++i)
      if (p[i] != q[i]) return p[i] < q[i];
    return a < b;
  });
  std::vector<std::uint32_t> representative(mesh.positions.size());
  std::uint64_t welded = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool equal = i > 0 && mesh.positions[order[i]] == mesh.positions[order[i - 1]];
    representative[order[i]] = equal ? representative[order[i - 1]] : order[i];
    welded += equal;
  }
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = representative[v];
  return welded;
}

std::uint64_t drop_degenerate_faces(WorkingMesh& mesh) {
  std::vector<std::uint8_t> keep(mesh.triangles.size(), 1);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    keep[f] = t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
  }
  return keep_faces(mesh, keep);
}

std::uint64_t drop_duplicate_faces(WorkingMesh& mesh) {
  // Only faces of the same lowest vertex can be equal: sorted within buckets, as edges are.
  std::vector<Triangle> sorted(mesh.triangles);
  for (Triangle& t : sorted) std::sort(t.begin(), t.end());
  std::vector<std::uint32_t> bucket(mesh.positions.size() + 1, 0);
  for (const Triangle& t : sorted) ++bucket[t[0] + 1];
  std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
  std::vector<std::uint32_t> order(sorted.size());
  std::vector<std::uint32_t> fill(bucket.begin(), bucket.end() - 1);
  for (std::uint32_t f = 0; f < sorted.size(); ++f) order[fill[sorted[f][0]]++] = f;

  std::vector<std::uint8_t> keep(sorted.size(), 1);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto begin = order.begin() + bucket[v], end = order.begin() + bucket[v + 1];
    std::sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
      return sorted[a] != sorted[b] ? sorted[a] < sorted[b] : a < b;
    });
    for (auto f = begin; f != end; ++f)
      if (f != begin && sorted[*f] == sorted[*(f - 1)]) keep[*f] = 0;
  }
  return keep_faces(mesh, keep);
}

std::uint64_t drop_unreferenced_vertices(WorkingMesh& mesh) {
  constexpr std::uint32_t unused = 0xffffffffu;
  std::vector<std::uint32_t> renamed(mesh.positions.size(), unused);
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t v : t) renamed[v] = 0;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < renamed.size(); ++v) {
    if (renamed[v] == unused) continue;
    mesh.positions[kept] = mesh.positions[v];
    mesh.source_vertex[kept] = mesh.source_vertex[v];
    renamed[v] = kept++;
  }
  const std::uint64_t dropped = mesh.positions.size() - kept;
  mesh.positions.resize(kept);
  mesh.source_vertex.resize(kept);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = renamed[v];
  return dropped;
}

}  // namespace zerotree::clean
