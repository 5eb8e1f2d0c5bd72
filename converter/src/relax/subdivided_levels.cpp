#include "relax/subdivided_levels.h"

#include <algorithm>
#include <map>

namespace zerotree::relax {
namespace {

// Edges are numbered as they first occur in the faces, as OpenSubdiv numbers them.
SubdividedLevel base_level(const bitstream::BaseTopology& base) {
  SubdividedLevel level;
  level.vertex_count = base.vertex_count;
  level.triangles = base.triangles;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> numbers;
  std::vector<std::uint8_t> faces_of_edge;
  for (const Triangle& t : base.triangles) {
    Triangle& face_edges = level.face_edges.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const auto [it, is_new] = numbers.try_emplace({std::min(a, b), std::max(a, b)},
                                                    static_cast<std::uint32_t>(numbers.size()));
      if (is_new) {
        level.edges.push_back({a, b});
        faces_of_edge.push_back(0);
      }
      ++faces_of_edge[it->second];
      face_edges[k] = it->second;
    }
  }
  for (std::uint8_t faces : faces_of_edge) level.is_feature.push_back(faces == 1);
  for (const auto& crease : base.crease_edges) level.is_feature[numbers.at(crease)] = 1;
  return level;
}

// Children as in SemiRegularMesh; edge 3f + k lies opposite corner k of face f, in child k.
SubdividedLevel quadrisect(const SubdividedLevel& coarse) {
  const auto faces = static_cast<std::uint32_t>(coarse.triangles.size());
  const auto edges = static_cast<std::uint32_t>(coarse.edges.size());
  SubdividedLevel fine;
  fine.vertex_count = coarse.vertex_count + edges;
  fine.edges.resize(3 * std::size_t{faces} + 2 * std::size_t{edges});
  fine.is_feature.resize(fine.edges.size(), 0);
  for (std::uint32_t e = 0; e < edges; ++e)
    for (std::uint32_t k = 0; k < 2; ++k) {
      // OpenSubdiv lets both halves start at the midpoint.
      fine.edges[3 * faces + 2 * e + k] = {coarse.vertex_count + e, coarse.edges[e][k]};
      fine.is_feature[3 * faces + 2 * e + k] = coarse.is_feature[e];
    }
  fine.triangles.reserve(4 * std::size_t{faces});
  fine.face_edges.reserve(4 * std::size_t{faces});
  for (std::uint32_t f = 0; f < faces; ++f) {
    const Triangle& v = coarse.triangles[f];
    const Triangle& e = coarse.face_edges[f];
    const Triangle m{coarse.vertex_count + e[0], coarse.vertex_count + e[1],
                     coarse.vertex_count + e[2]};
    const auto half = [&](std::size_t k, std::uint32_t end) {
      return 3 * faces + 2 * e[k] + (coarse.edges[e[k]][0] == end ? 0 : 1);
    };
    fine.triangles.insert(
        fine.triangles.end(),
        {{v[0], m[0], m[2]}, {m[0], v[1], m[1]}, {m[2], m[1], v[2]}, {m[1], m[2], m[0]}});
    fine.face_edges.insert(fine.face_edges.end(), {{half(0, v[0]), 3 * f, half(2, v[0])},
                                                   {half(0, v[1]), half(1, v[1]), 3 * f + 1},
                                                   {3 * f + 2, half(1, v[2]), half(2, v[2])},
                                                   {3 * f + 2, 3 * f, 3 * f + 1}});
    for (std::uint32_t k = 0; k < 3; ++k) fine.edges[3 * f + k] = {m[k], m[(k + 2) % 3]};
  }
  return fine;
}

}  // namespace

std::vector<SubdividedLevel> subdivide_base(const bitstream::BaseTopology& base, int levels) {
  std::vector<SubdividedLevel> all{base_level(base)};
  for (int j = 0; j < levels; ++j) all.push_back(quadrisect(all.back()));
  return all;
}

}  // namespace zerotree::relax
