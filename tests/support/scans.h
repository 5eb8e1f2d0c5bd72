// Rough meshes of every class, fine enough to be remeshed. For tests that link zerotree_domain.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "domain/domain.h"
#include "shapes.h"

namespace zerotree::test {

/// A clean mesh and how to build its domain.
struct Scan {
  std::string name;
  TriangleMesh mesh;
  domain::DomainOptions options;
};

/// How a test's report names a scan.
inline void PrintTo(const Scan& scan, std::ostream* out) {
  *out << scan.name;
}

/// A scan of each base shape: its faces quadrisected three times, with bumps and noise but for the
/// creased ones, which stay flat and sharp.
inline std::vector<Scan> scans() {
  std::vector<Scan> scans;
  for (const Shape& shape : base_shapes()) {
    Scan& scan = scans.emplace_back(Scan{shape.name, midpoint_subdivide(shape.mesh, 3), {}});
    scan.options.base_vertices = 20;
    if (!shape.crease_edges.empty()) continue;
    scan.mesh = add_noise(add_bumps(scan.mesh, 0.01, 2.0), 0.05, 11);
    scan.options.crease_angle_degrees = 180;
  }
  return scans;
}

}  // namespace zerotree::test
