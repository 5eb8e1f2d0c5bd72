// Control points whose Loop limit surface is as close to the input as a smooth one can be.
#pragma once

#include "fit/limit_operator.h"
#include "fit/smoothness_penalty.h"
#include "mesh/progress.h"
#include "relax/surface_relaxation.h"

namespace zerotree::fit {

struct FitOptions {
  /// Weights of the finest details against distances, all squared. The larger the normal one, the
  /// smoother and the cheaper to code, the smaller, the closer: 0.01 .. 1 are useful.
  SmoothnessWeights smoothness{0.02, 0.3};
  /// The details of so many levels, but none of level 2 or 1 below a finer one, are pulled off the
  /// surface: those below the finest one by their tangential weight only, times their area.
  int smooth_levels = 3;
  /// What a tangential distance counts as a share of a normal one.
  double tangential_share = 0.05;
  /// How often distances are measured anew, and iterations of the solve in between.
  int rounds = 2;
  int iterations = 6;
};

struct FittedSurface {
  /// Control points of the finest level.
  Points points;
  /// Faces whose normal opposes the input's at their point; 0 wherever that could be reached.
  std::uint32_t turned_faces = 0;
};

/// Least squares over the control points of the finest level: distances from the limit surface's
/// vertices to the input and from the input's vertices to the limit surface, plus a penalty on the
/// finest details. Where a limit point lies on the input is known from the parameterisation and
/// followed by short walks, where an input vertex lies on the limit surface by going downhill from
/// triangle to triangle. The result does not depend on the number of threads. Cost: about 5
/// microseconds and 400 bytes per finest vertex, if `relaxed` is given away.
FittedSurface fit_control_points(const domain::Domain& domain,
                                 const remesh::Parameterisation& laid_out,
                                 relax::RelaxedMesh relaxed, const FitOptions& options,
                                 const Progress& progress);

}  // namespace zerotree::fit
