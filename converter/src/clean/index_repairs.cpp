#include "clean/index_repairs.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>

#include "clean/half_edges.h"
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

// Whether the corners, turned so that the lowest is first, ascend.
bool is_even(const Triangle& t) {
  return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
}

// Equal for 0 and -0. Numbers of few bits, as grids have, differ in their upper ones: these are
// brought down.
std::size_t hash_of(const Eigen::Vector3d& p) {
  std::uint64_t hash = 0;
  for (int i = 0; i < 3; ++i) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(p[i] + 0.0)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace

void check_input(const TriangleMesh& input) {
  constexpr double largest_coordinate = 1e100;  // its third power is still a double
  for (std::size_t v = 0; v < input.positions.size(); ++v)
    if (!(input.positions[v].array().abs() <= largest_coordinate).all())
      throw Error(ExitCode::unreadable_input,
                  "vertex " + std::to_string(v) +
                      " has a coordinate that is not finite or beyond 1e100; repair the mesh");
  for (std::size_t f = 0; f < input.triangles.size(); ++f)
    for (std::uint32_t v : input.triangles[f])
      if (v >= input.positions.size())
        throw Error(ExitCode::unreadable_input, "face " + std::to_string(f) + " names vertex " +
                                                    std::to_string(v) + ", but there are " +
                                                    std::to_string(input.positions.size()) +
                                                    "; repair the mesh");
}

std::uint64_t weld_equal_positions(WorkingMesh& mesh) {
  // A hash table of vertices with open addressing, at most half full.
  constexpr std::uint32_t empty = 0xffffffffu;
  std::vector<std::uint32_t> table(std::bit_ceil(2 * mesh.positions.size() + 1), empty);
  std::vector<std::uint32_t> representative(mesh.positions.size());
  std::uint64_t welded = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    std::size_t slot = hash_of(mesh.positions[v]) & (table.size() - 1);
    while (table[slot] != empty && mesh.positions[table[slot]] != mesh.positions[v])
      slot = (slot + 1) & (table.size() - 1);
    if (table[slot] == empty)
      table[slot] = v;
    else
      ++welded;
    representative[v] = table[slot];
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

std::uint64_t drop_duplicate_faces(WorkingMesh& mesh, std::vector<std::uint8_t>& folded) {
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
  std::vector<std::int32_t> balance(sorted.size(), 0);  // copies like the kept face less others
  std::vector<std::uint8_t> has_copies(sorted.size(), 0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto begin = order.begin() + bucket[v], end = order.begin() + bucket[v + 1];
    std::sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
      return sorted[a] != sorted[b] ? sorted[a] < sorted[b] : a < b;
    });
    std::uint32_t kept = 0;
    for (auto f = begin; f != end; ++f) {
      if (f == begin || sorted[*f] != sorted[kept]) kept = *f;
      balance[kept] += is_even(mesh.triangles[*f]) == is_even(mesh.triangles[kept]) ? 1 : -1;
      if (*f == kept) continue;
      keep[*f] = 0;
      has_copies[kept] = 1;
    }
  }
  folded.clear();
  for (std::size_t f = 0; f < keep.size(); ++f)
    if (keep[f] != 0) folded.push_back(has_copies[f] != 0 && balance[f] == 0 ? 1 : 0);
  return keep_faces(mesh, keep);
}

std::uint64_t drop_folded_faces(WorkingMesh& mesh, const std::vector<std::uint8_t>& folded) {
  if (std::find(folded.begin(), folded.end(), 1) == folded.end()) return 0;
  const EdgeTable edges = make_edge_table(mesh.triangles, mesh.positions.size());
  std::vector<std::uint32_t> edge_of(mesh.triangles.size() * 3);
  std::vector<std::uint32_t> faces_at(edges.edge_count());
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e) {
    faces_at[e] = edges.first[e + 1] - edges.first[e];
    for (std::uint32_t i = edges.first[e]; i < edges.first[e + 1]; ++i)
      edge_of[edges.half_edges[i]] = e;
  }
  std::vector<std::uint8_t> keep(mesh.triangles.size(), 1);
  for (std::size_t f = 0; f < folded.size(); ++f) {
    if (folded[f] == 0) continue;
    bool has_two = false, has_one = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t others = faces_at[edge_of[3 * f + k]] - 1;
      has_two |= others >= 2;
      has_one |= others == 1;
    }
    if (!has_two || has_one) continue;
    keep[f] = 0;
    for (std::size_t k = 0; k < 3; ++k) --faces_at[edge_of[3 * f + k]];
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
