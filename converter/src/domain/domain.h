// The parameter domain of a mesh: its features, its base mesh and the way back to the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "domain/triangle_topology.h"
#include "mesh/progress.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::domain {

/// What the surface is wanted for. Errors are relative to the diagonal; 0: not known.
struct AccuracyGoal {
  double max_error = 0;
  double discretisation_error = 0;
};

struct DomainOptions {
  /// Wanted vertices of the base mesh; 0: from the input's density, shape, features and topology
  /// (base_size.h).
  std::uint32_t base_vertices = 0;
  /// Edges whose normals turn by more than this are creases, in degrees; 180 switches creases off.
  /// 0: the default rule, which follows edges of 15 degrees where the surface turns
  /// nowhere else, takes off the short branches that noise makes, and wants most edges above 40
  /// degrees, half a diagonal of them together and one 25th of it on average between their ends,
  /// junctions and sharp turns. A closed rim in a plane may be shorter.
  double crease_angle_degrees = 0;
  /// Vertices that must stay in the base mesh, ascending (the remesher's answer to a place where
  /// the undo of a collapse has no room).
  std::vector<std::uint32_t> pinned_vertices;
  /// What the surface is wanted for; matters where the size of the base is left open.
  AccuracyGoal goal = {};
};

/// What a vertex may do.
enum class VertexKind : std::uint8_t {
  smooth,  ///< no feature edge: free
  chain,   ///< on a crease or boundary that passes through: stays on it
  corner,  ///< end, junction or sharp turn of features: stays in the base
};

/// One half-edge collapse: `removed` was merged into `kept`. The two faces of their edge are
/// `left` = (removed, kept, a) and `right` = (kept, removed, b), kNone where there is none; they
/// stay in the topology's arrays as they were then, which is all that the undo needs.
struct CollapseRecord {
  std::uint32_t removed;
  std::uint32_t kept;
  std::uint32_t left;
  std::uint32_t right;
};

/// The collapses from `begin` to before `end`: they are independent, so that they may be undone in
/// any order among themselves.
struct CollapsePass {
  std::size_t begin;
  std::size_t end;
};

struct DomainReport {
  std::uint32_t target_base_vertices = 0;
  std::uint32_t base_vertices = 0;
  std::uint32_t base_faces = 0;
  std::uint32_t collapses = 0;
  std::uint32_t components = 0;
  std::uint32_t boundary_loops = 0;
  /// Sum over the components.
  std::uint32_t genus = 0;
  /// Of the input mesh.
  std::uint32_t crease_edges = 0;
  std::uint32_t corners = 0;
  /// Vertices added where a triangle had two feature edges.
  std::uint32_t ear_splits = 0;
  /// Of the base mesh; faces around a vertex.
  std::uint32_t min_valence = 0;
  std::uint32_t max_valence = 0;
  /// Smooth vertices of the base mesh of valence below 5 and above 7.
  std::uint32_t low_valences = 0;
  std::uint32_t high_valences = 0;
};

/// A mesh taken apart. `mesh` is the input, first as it was, then the vertices and faces of the
/// ear splits (which do not change the surface). `topology` is its topology after all `collapses`:
/// undone from the last to the first they give back the mesh's.
struct Domain {
  TriangleMesh mesh;
  std::vector<VertexKind> kinds;
  TriangleTopology topology;
  std::vector<CollapseRecord> collapses;
  /// Runs of independent collapses, ascending.
  std::vector<CollapsePass> passes;
  /// The faces that are left, ascending: indices into `topology.faces`.
  std::vector<std::uint32_t> base_faces;
  DomainReport report;
};

/// Finds the features of `mesh` (clean, oriented, manifold; any genus, boundaries, components)
/// and decimates it to a base mesh: a simplicial complex without duplicate edges, of the same
/// topology. Throws Error(refused_topology) if the mesh is no manifold.
/// Fast for meshes whose neighbours in space have neighbouring numbers (clean/spatial_order.h):
/// about 6 microseconds and 220 bytes per vertex then; two thirds of it on all threads of oneTBB.
Domain build_domain(const TriangleMesh& mesh, const DomainOptions& options,
                    const Progress& progress);

/// Takes back the collapses of `domain` but the first `keep`, and decimates again from there with
/// other `options`. The distance to the mesh is then measured from where it begins again.
void rebuild_base(Domain& domain, const DomainOptions& options, std::size_t keep,
                  const Progress& progress);

/// The faces that an undo of `collapse` would take from `kept`, counter-clockwise around it, into
/// `fan`. Looks at no face but those at `kept` and the two of the collapse.
void find_collapsed_fan(const TriangleTopology& topology, const CollapseRecord& collapse,
                        std::vector<std::uint32_t>& fan);

/// Takes back one collapse, the last one that is not yet taken back: connectivity only. The faces
/// that change from `kept` to `removed` are written to `fan`, counter-clockwise around both.
void undo_collapse(TriangleTopology& topology, const CollapseRecord& collapse,
                   std::vector<std::uint32_t>& fan);

}  // namespace zerotree::domain
