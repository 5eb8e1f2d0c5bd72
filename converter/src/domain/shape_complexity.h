// How many base vertices a shape asks for.
#pragma once

#include "domain/triangle_topology.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::domain {

/// Squared principal curvatures integrated over the surface, apart from its creases: the same for a
/// shape of any size. A sphere has 8 pi, about 30 as it is measured here; a base mesh needs
/// vertices in proportion to it. Normals are averaged over patches of about 2 % of the diagonal, so
/// noise and the density of the mesh hardly count; thin limbs do. Linear, 0.1 microseconds a face.
double shape_complexity(const TriangleMesh& mesh, const TriangleTopology& topology);

}  // namespace zerotree::domain
