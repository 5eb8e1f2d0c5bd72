// The clean stage: any triangle soup becomes an oriented 2-manifold with boundary, or is refused.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mesh/progress.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::clean {

struct CleanOptions {
  /// A triangle whose height is at most this part of its longest side counts as one of no area.
  double zero_area_height = 1e-12;
  /// How far a vertex is moved to give such a triangle an area, if nothing else helps: in parts of
  /// its longest side.
  double nudge = 1e-4;
};

/// What was repaired, and what the clean surface is like.
struct CleanReport {
  // Repairs, in the order they are done.
  std::uint64_t welded_vertices = 0;
  std::uint64_t degenerate_faces = 0;
  std::uint64_t duplicate_faces = 0;
  std::uint64_t folded_faces = 0;
  std::uint64_t non_manifold_edges = 0;
  std::uint64_t turned_faces = 0;
  std::uint64_t turned_components = 0;
  std::uint64_t split_vertices = 0;
  std::uint64_t divided_edges = 0;
  std::uint64_t flipped_edges = 0;
  std::uint64_t removed_zero_area_faces = 0;
  std::uint64_t nudged_vertices = 0;
  std::uint64_t unreferenced_vertices = 0;

  // The clean surface.
  std::uint64_t components = 0;
  std::uint64_t boundary_loops = 0;
  std::uint64_t boundary_edges = 0;
  /// V - E + F.
  std::int64_t euler_characteristic = 0;
  /// Sum over the components, as if each boundary loop were closed by a disc.
  std::int64_t genus = 0;
};

struct CleanMesh {
  TriangleMesh mesh;
  /// Component of each face; components are numbered by their first face.
  std::vector<std::uint32_t> face_component;
  std::uint32_t component_count = 0;
  /// Per vertex the vertex of the input it comes from. The midpoint of a divided edge has none of
  /// its own and names one end of the edge.
  std::vector<std::uint32_t> source_vertex;
  CleanReport report;
};

/// Repairs `input` and checks the result (`check_manifold`).
///
/// Exactly equal positions are welded; faces with a repeated vertex go, and of faces with the same
/// three vertices the first stays (none, if they are the two sides of a fold that welding pressed
/// flat and the surface goes on without them). Where more than two faces meet at an edge they are
/// paired, the flattest pairs of fitting orientation first, and what is left over gets a boundary
/// there. Orientation follows the majority of each connected patch, and a closed component that the
/// file orients inconsistently gets a positive volume; if the closed components enclose a negative
/// volume altogether, all of them are turned. Vertices where several fans meet are split. Faces
/// of no area are removed by flipping their longest edge, which changes no point of the surface.
///
/// Throws Error(unreadable_input) for a position that is not finite or an index out of range, and
/// Error(refused_topology), naming a face and a place, for a surface that cannot be oriented or of
/// which nothing is left. O(n log n); flat arrays of about 90 bytes per face. Deterministic.
CleanMesh clean_mesh(const TriangleMesh& input, const CleanOptions& options,
                     const Progress& progress);

/// The repairs whose count is not zero, as words for a person and count.
std::vector<std::pair<std::string, std::uint64_t>> list_repairs(const CleanReport& report);

}  // namespace zerotree::clean
