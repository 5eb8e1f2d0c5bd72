// A model that any error can be reached with: the original is its own limit surface.
#pragma once

#include "convert/model_encoding.h"
#include "convert/prefix_errors.h"
#include "measure/surface_index.h"

namespace zerotree::test {

/// A bumpy icosahedral surface of three levels.
convert::SurfaceModel bumpy_model();

/// A model, its surface as the original, and how prefixes are measured against that.
struct BumpyModel {
  BumpyModel();
  BumpyModel(const BumpyModel&) = delete;
  BumpyModel& operator=(const BumpyModel&) = delete;

  /// The payload for a base outside of it.
  decode::StreamFile encode(double step) const;

  convert::AnalysedModel analysed;
  TriangleMesh surface;
  measure::SurfaceIndex original;
  convert::PrefixMeasurement how;
};

}  // namespace zerotree::test
