#include "surface/progressive_surface.h"

#include <cmath>
#include <stdexcept>

#include "bitstream/base_edges.h"

namespace zerotree::surface {

using bitstream::DecodeStatus;

ProgressiveSurface::ProgressiveSurface(const bitstream::Limits& limits) : decoder_(limits) {}

ProgressiveSurface::ProgressiveSurface(ExternalBase base, const bitstream::Limits& limits)
    : external_(std::move(base)), decoder_(external_->topology, external_->positions, limits) {
  external_->topology.crease_edges.clear();
  external_->topology.corner_vertices.clear();
  check_external_base(limits);
}

void ProgressiveSurface::check_external_base(const bitstream::Limits& limits) {
  const bitstream::BaseEdges numbered = bitstream::number_base_edges(external_->topology);
  external_edges_ = numbered.edges.size();
  if (!numbered.error.empty()) return fail(numbered.error);
  if (external_edges_ == 0) return fail("the base mesh given has no triangle");
  if (external_->positions.size() != 3 * std::size_t{external_->topology.vertex_count})
    return fail("the base mesh given has not three coordinates per vertex");
  if (external_->levels < 0 || external_->levels > limits.max_levels)
    return fail("the number of levels is beyond the limit");
  if (external_->topology.vertex_count +
          std::uint64_t{external_edges_} * bitstream::cells_below(external_->levels) >
      limits.max_vertices)
    return fail("the finest level has more vertices than the limit");
}

void ProgressiveSurface::share(std::shared_ptr<const SubdivisionHierarchy> hierarchy) {
  shared_ = std::move(hierarchy);
  hierarchy_ = nullptr;
}

DecodeStatus ProgressiveSurface::feed(std::span<const std::uint8_t> bytes) {
  if (own_reason_.empty()) {
    decoder_.feed(bytes);
    check_header();
  }
  return status();
}

void ProgressiveSurface::check_header() {
  if (!decoder_.header_ready()) return;
  const bitstream::StreamHeader& header = decoder_.header();
  if (!is_known_transform(header.transform))
    fail("the stream names wavelet transform " + std::to_string(header.transform) +
         ", which this version lacks");
  else if (external_ && decoder_.status() != DecodeStatus::broken &&
           header.levels != external_->levels)
    fail("the stream has " + std::to_string(header.levels) + " levels where " +
         std::to_string(external_->levels) + " were announced");
}

DecodeStatus ProgressiveSurface::status() const {
  return own_reason_.empty() ? decoder_.status() : DecodeStatus::broken;
}

const std::string& ProgressiveSurface::reason() const {
  return own_reason_.empty() ? decoder_.reason() : own_reason_;
}

bool ProgressiveSurface::is_ready() const {
  return status() != DecodeStatus::broken && (external_ || decoder_.base_ready());
}

int ProgressiveSurface::levels() const {
  return external_ ? external_->levels : decoder_.header().levels;
}

const bitstream::BaseTopology& ProgressiveSurface::base() const {
  return decoder_.base_ready() ? decoder_.base() : external_->topology;
}

ProgressiveSurface::Counts ProgressiveSurface::counts(int level) const {
  Counts counts{base().vertex_count, external_ ? external_edges_ : decoder_.base_edges().size(),
                base().triangles.size()};
  for (int number = 0; number < level; ++number)
    counts = {counts.vertices + counts.edges, 2 * counts.edges + 3 * counts.triangles,
              4 * counts.triangles};
  return counts;
}

WaveletTransform ProgressiveSurface::transform() const {
  // Without a header there are no details, so any transform will do.
  return decoder_.header_ready() ? static_cast<WaveletTransform>(decoder_.header().transform)
                                 : WaveletTransform::loop_local;
}

bool ProgressiveSurface::suits(const SubdivisionHierarchy* hierarchy, int level) const {
  return hierarchy && hierarchy->levels() >= level && hierarchy->transform() == transform() &&
         hierarchy->base().crease_edges == base().crease_edges &&
         hierarchy->base().corner_vertices == base().corner_vertices;
}

const SubdivisionLevel* ProgressiveSurface::topology(int level) {
  hierarchy_ = nullptr;
  if (suits(shared_.get(), level)) {
    hierarchy_ = shared_.get();
  } else {
    if (!suits(own_.get(), level)) {
      own_.reset();  // before the next one takes its memory
      try {
        own_ = std::make_shared<const SubdivisionHierarchy>(base(), level, transform());
      } catch (const std::invalid_argument& error) {
        fail(error.what());
        return nullptr;
      }
    }
    hierarchy_ = own_.get();
  }
  return &hierarchy_->level(level);
}

Positions ProgressiveSurface::control_points(int level) const {
  if (!decoder_.base_ready()) return reconstruct(*hierarchy_, external_->positions, {}, {}, level);
  const bitstream::StreamHeader& header = decoder_.header();
  const Dequantisation dequantisation{header.finest_step,
                                      std::ldexp(1.0f, header.tangent_ratio_log2)};
  return reconstruct(*hierarchy_, decoder_.base_positions(), decoder_.coefficients(),
                     dequantisation, level);
}

}  // namespace zerotree::surface
