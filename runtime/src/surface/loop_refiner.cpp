#include "surface/loop_refiner.h"

#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace zerotree::surface {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

constexpr int kMostLevels = 14;

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument(why);
}

void check_tags(const bitstream::BaseTopology& topology,
                const std::vector<bitstream::BaseEdge>& base_edges) {
  std::vector<std::array<std::uint32_t, 2>> interior;
  for (const bitstream::BaseEdge& edge : base_edges)
    if (edge.faces[1] != bitstream::kNone)
      interior.push_back({std::min(edge.vertices[0], edge.vertices[1]),
                          std::max(edge.vertices[0], edge.vertices[1])});
  std::sort(interior.begin(), interior.end());
  for (const auto& edge : topology.crease_edges)
    if (!std::binary_search(interior.begin(), interior.end(), edge))
      refuse("crease " + std::to_string(edge[0]) + "-" + std::to_string(edge[1]) +
             " is no interior edge of the base mesh");
  for (const std::uint32_t vertex : topology.corner_vertices)
    if (vertex >= topology.vertex_count)
      refuse("corner " + std::to_string(vertex) + " is no base vertex");
}

void check_manifold(const RefinerLevel& base) {
  for (int vertex = 0; vertex < base.GetNumVertices(); ++vertex)
    if (base.GetVertexFaces(vertex).size() == 0 || base.IsVertexNonManifold(vertex))
      refuse("base vertex " + std::to_string(vertex) + " has no face or more than one fan");
  for (int edge = 0; edge < base.GetNumEdges(); ++edge)
    if (base.IsEdgeNonManifold(edge)) refuse("a base edge is not manifold");
}

/// Before anything is allocated.
void check_size(const bitstream::BaseTopology& topology, int levels) {
  if (levels < 0 || levels > kMostLevels) refuse("the number of levels is out of 0 .. 14");
  if (topology.triangles.empty()) refuse("the base mesh has no triangle");
  // No level has more edges than three per face, and each is at most one new vertex.
  const std::uint64_t faces = std::uint64_t{topology.triangles.size()} << (2 * levels);
  if (topology.vertex_count + 3 * faces >= (std::uint64_t{1} << 31))
    refuse("the finest level has too many vertices");
}

}  // namespace

std::unique_ptr<Refiner> make_loop_refiner(const bitstream::BaseTopology& topology,
                                           const std::vector<bitstream::BaseEdge>& base_edges,
                                           int levels) {
  check_size(topology, levels);
  check_tags(topology, base_edges);

  const std::vector<int> corners_per_face(topology.triangles.size(), 3);
  std::vector<int> corners, creases;
  for (const auto& triangle : topology.triangles)
    for (const std::uint32_t vertex : triangle) corners.push_back(static_cast<int>(vertex));
  for (const auto& edge : topology.crease_edges)
    for (const std::uint32_t vertex : edge) creases.push_back(static_cast<int>(vertex));
  const std::vector<int> tagged(topology.corner_vertices.begin(), topology.corner_vertices.end());
  const std::vector<float> sharp(std::max(topology.crease_edges.size(), tagged.size()),
                                 Sdc::Crease::SHARPNESS_INFINITE);

  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(topology.vertex_count);
  descriptor.numFaces = static_cast<int>(corners_per_face.size());
  descriptor.numVertsPerFace = corners_per_face.data();
  descriptor.vertIndicesPerFace = corners.data();
  descriptor.numCreases = static_cast<int>(topology.crease_edges.size());
  descriptor.creaseVertexIndexPairs = creases.data();
  descriptor.creaseWeights = sharp.data();
  descriptor.numCorners = static_cast<int>(tagged.size());
  descriptor.cornerVertexIndices = tagged.data();
  descriptor.cornerWeights = sharp.data();

  Sdc::Options rules;
  rules.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Refiner> refiner(
      Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_LOOP, rules)));
  if (!refiner) refuse("OpenSubdiv does not accept the base mesh");
  check_manifold(refiner->GetLevel(0));

  Refiner::UniformOptions uniform(static_cast<unsigned>(levels));
  uniform.fullTopologyInLastLevel = true;
  if (levels > 0) refiner->RefineUniform(uniform);
  return refiner;
}

}  // namespace zerotree::surface
