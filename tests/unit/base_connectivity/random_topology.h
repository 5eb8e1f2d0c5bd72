// Random base meshes: connectivity only, from fixed seeds.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/base_topology.h"

namespace zerotree::test {

/// A torus of columns x rows squares, two triangles each: all valences 6, genus 1.
bitstream::BaseTopology torus(std::uint32_t columns, std::uint32_t rows);

/// `a` and `b` as one topology of separate components; tags are dropped.
bitstream::BaseTopology join(const bitstream::BaseTopology& a, const bitstream::BaseTopology& b);

/// Turns `count` random edges inside the quadrilateral of their two triangles, where the result
/// stays a manifold and every valence stays within [lowest, highest]; tags are dropped.
bitstream::BaseTopology flip_edges(const bitstream::BaseTopology& topology, std::uint32_t count,
                                   std::uint32_t lowest, std::uint32_t highest, std::uint32_t seed);

/// Takes away up to `count` random triangles, each only if what remains is a manifold without
/// unused vertices; tags are dropped.
bitstream::BaseTopology punch_holes(bitstream::BaseTopology topology, std::uint32_t count,
                                    std::uint32_t seed);

/// Random numbering of vertices, triangles and first corners.
bitstream::BaseTopology shuffle(const bitstream::BaseTopology& topology, std::uint32_t seed);

/// Tags about `share` of the interior edges as creases and of the vertices as corners.
bitstream::BaseTopology tag_randomly(bitstream::BaseTopology topology, double share,
                                     std::uint32_t seed);

}  // namespace zerotree::test
