#include "convert/model_encoding.h"

#include <algorithm>
#include <utility>

#include "encode/encode.h"

namespace zerotree::convert {
namespace {

constexpr double kStepPerRemeshingError = 1.0;

}  // namespace

double default_step(double remeshing_error) {
  return std::max(kStepPerRemeshingError * remeshing_error, kFinestRelativeStep);
}

decode::StreamFile encode_model(const SurfaceModel& model,
                                const analysis::WaveletDecomposition& wavelets, double finest_step,
                                bool embed_base) {
  encode::EncodeOptions options;
  options.finest_step = finest_step;
  options.embed_base = embed_base;
  encode::EncodedStream encoded = encode::encode(*model.hierarchy, wavelets, options);
  decode::StreamFile file;
  file.bytes = std::move(encoded.bytes);
  file.external_base = !embed_base;
  file.base = model.base;
  file.levels = model.hierarchy->levels();
  file.base_positions = std::move(encoded.base_positions);
  return file;
}

}  // namespace zerotree::convert
