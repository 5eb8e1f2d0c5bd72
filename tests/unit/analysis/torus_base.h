// A closed mesh of valence 6 everywhere: where the filters have no irregular case.
#pragma once

#include "bitstream/base_topology.h"
#include "shapes.h"
#include "transforms.h"

namespace zerotree::test {

/// `n` x `n` squares of a torus, two triangles each; n >= 3.
inline bitstream::BaseTopology regular_torus(std::uint32_t n) {
  bitstream::BaseTopology torus;
  torus.vertex_count = n * n;
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t right = (x + 1) % n, up = (y + 1) % n;
      const std::uint32_t a = y * n + x, b = y * n + right, c = up * n + right, d = up * n + x;
      torus.triangles.push_back({a, b, c});
      torus.triangles.push_back({a, c, d});
    }
  return torus;
}

inline bitstream::BaseTopology topology_of(const Shape& shape) {
  return {static_cast<std::uint32_t>(shape.mesh.positions.size()), shape.mesh.triangles,
          shape.crease_edges, shape.corner_vertices};
}

}  // namespace zerotree::test
