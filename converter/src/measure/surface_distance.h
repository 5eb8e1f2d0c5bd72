// How far two surfaces lie apart: the error every table and report of this project means.
#pragma once

#include <cstddef>

#include "measure/surface_index.h"
#include "mesh/triangle_mesh.h"

namespace zerotree::measure {

struct DistanceOptions {
  /// Area-uniform samples of each surface. One million keeps the error of the RMS below 0.1 %;
  /// 100,000 are good for tables that are made while a file is written.
  std::size_t samples = 1'000'000;
  /// Threads to use; 0 means all of the machine's. The result does not depend on it by one bit.
  int threads = 0;
};

/// Distances from the points of one surface to the nearest points of the other, in the meshes' own
/// unit. A mean or RMS is over the area, a maximum over samples and vertices.
struct DirectedDistance {
  double rms = 0.0;
  double mean = 0.0;
  double maximum = 0.0;
  /// Angles between the triangle normals at a sample and at its nearest point, in degrees 0..180.
  double normal_mean_degrees = 0.0;
  double normal_max_degrees = 0.0;
};

/// Both directions; symmetric figures are the larger of the two.
struct SurfaceDistance {
  DirectedDistance from_reference, from_test;
  /// The larger of both directions, in the meshes' own unit.
  DirectedDistance symmetric;
  /// Diagonal of the reference's bounding box: divide by it to get relative distances.
  double diagonal = 0.0;

  double relative_rms() const { return symmetric.rms / diagonal; }
  double relative_mean() const { return symmetric.mean / diagonal; }
  /// Hausdorff distance over the diagonal.
  double relative_hausdorff() const { return symmetric.maximum / diagonal; }
};

/// Symmetric distance of two surfaces by area-uniform sampling of both (as METRO does; Cignoni,
/// Rocchini, Scopigno 1998). Triangles of no area and vertices that no other triangle uses do not
/// count. Throws what SurfaceIndex throws, and Error(usage) for zero samples or a negative number
/// of threads. Cost: about 2 microseconds per sample and direction on one thread.
SurfaceDistance compare_surfaces(const TriangleMesh& reference, const TriangleMesh& test,
                                 const DistanceOptions& options = {});

/// The same with the reference's search tree at hand, for many comparisons with one reference.
SurfaceDistance compare_surfaces(const SurfaceIndex& reference, const TriangleMesh& test,
                                 const DistanceOptions& options = {});

}  // namespace zerotree::measure
