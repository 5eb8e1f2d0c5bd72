// A model with its wavelets, and its streams.
#pragma once

#include "analysis/wavelet_decomposition.h"
#include "convert/surface_model.h"
#include "decode/stream_file.h"

namespace zerotree::convert {

/// What streams are made of.
struct AnalysedModel {
  SurfaceModel model;
  /// By the transform of the model's hierarchy.
  analysis::WaveletDecomposition wavelets;
};

/// Shortest step that makes sense, relative to the diagonal: about what float positions resolve.
constexpr double kFinestRelativeStep = 1e-7;

/// The finest step, relative to the diagonal, of a stream that is asked for nothing: rounding then
/// adds less to the error than the remesh does.
double default_step(double remeshing_error);

/// The whole stream of `model`, elementary with `embed_base`, otherwise bound to the base mesh as
/// glTF accessors hold it. `finest_step` is in the unit of `wavelets`. Throws as encode::encode.
decode::StreamFile encode_model(const SurfaceModel& model,
                                const analysis::WaveletDecomposition& wavelets, double finest_step,
                                bool embed_base);

}  // namespace zerotree::convert
