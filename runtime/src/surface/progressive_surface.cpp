#include "surface/progressive_surface.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace zerotree::surface {

using bitstream::DecodeStatus;

ProgressiveSurface::ProgressiveSurface(const bitstream::Limits& limits) : decoder_(limits) {}

ProgressiveSurface::ProgressiveSurface(bitstream::BaseTopology base, std::vector<float> positions,
                                       const bitstream::Limits& limits)
    : decoder_(std::move(base), std::move(positions), limits) {}

DecodeStatus ProgressiveSurface::feed(std::span<const std::uint8_t> bytes) {
  if (own_reason_.empty()) {
    decoder_.feed(bytes);
    check_header();
  }
  return status();
}

void ProgressiveSurface::check_header() {
  if (decoder_.header_ready() &&
      decoder_.header().transform !=
          static_cast<std::uint32_t>(WaveletTransform::loop_quadrature_mirror))
    own_reason_ = "the stream names wavelet transform " +
                  std::to_string(decoder_.header().transform) + ", which this version lacks";
}

DecodeStatus ProgressiveSurface::status() const {
  return own_reason_.empty() ? decoder_.status() : DecodeStatus::broken;
}

const std::string& ProgressiveSurface::reason() const {
  return own_reason_.empty() ? decoder_.reason() : own_reason_;
}

bool ProgressiveSurface::is_ready() const {
  return status() != DecodeStatus::broken && decoder_.header_ready() && decoder_.base_ready();
}

ProgressiveSurface::Counts ProgressiveSurface::counts(int level) const {
  Counts counts{decoder_.base().vertex_count, decoder_.base_edges().size(),
                decoder_.base().triangles.size()};
  for (int number = 0; number < level; ++number)
    counts = {counts.vertices + counts.edges, 2 * counts.edges + 3 * counts.triangles,
              4 * counts.triangles};
  return counts;
}

const SubdivisionLevel* ProgressiveSurface::topology(int level) {
  if (!hierarchy_ || hierarchy_->levels() < level) {
    try {
      hierarchy_ = std::make_unique<const SubdivisionHierarchy>(
          decoder_.base(), level, static_cast<WaveletTransform>(decoder_.header().transform));
    } catch (const std::invalid_argument& error) {
      own_reason_ = error.what();
      return nullptr;
    }
  }
  return &hierarchy_->level(level);
}

Positions ProgressiveSurface::control_points(int level) const {
  const bitstream::StreamHeader& header = decoder_.header();
  const Dequantisation dequantisation{static_cast<WaveletTransform>(header.transform),
                                      header.finest_step,
                                      std::ldexp(1.0f, header.tangent_ratio_log2)};
  return reconstruct(*hierarchy_, decoder_.base_positions(), decoder_.coefficients(),
                     dequantisation, level);
}

}  // namespace zerotree::surface
