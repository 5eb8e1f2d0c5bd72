#include "progressive/progressive_surface.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "bitstream/base_edges.h"
#include "bitstream/base_traversal.h"
#include "lattice/surface_measures.h"
#include "surface/surface_synthesis.h"

namespace zerotree::surface {

using bitstream::DecodeStatus;

ProgressiveSurface::ProgressiveSurface(const bitstream::Limits& limits,
                                       const SurfaceResources& resources)
    : resources_(resources), decoder_(limits, resources.memory) {}

ProgressiveSurface::ProgressiveSurface(ExternalBase base, const bitstream::Limits& limits,
                                       const SurfaceResources& resources)
    : resources_(resources),
      external_levels_(base.levels),
      decoder_(std::move(base.topology), std::move(base.positions), limits, resources.memory) {
  check_external_base(base.levels, limits);
}

void ProgressiveSurface::check_external_base(int levels, const bitstream::Limits& limits) {
  if (decoder_.status() == DecodeStatus::broken) return;  // its edges cannot be numbered
  const bitstream::BaseTopology& topology = decoder_.base();
  const std::size_t edges = decoder_.base_edges().size();
  if (edges == 0) return fail("the base mesh given has no triangle");
  const auto fans = bitstream::check_base_fans(topology, decoder_.base_edges());
  if (!fans.ok()) return fail(std::string("the base mesh given: ") + fans.problem);
  if (decoder_.external_positions().size() != 3 * std::size_t{topology.vertex_count})
    return fail("the base mesh given has not three coordinates per vertex");
  if (levels < 0 || levels > limits.max_levels)
    return fail("the number of levels is beyond the limit");
  if (topology.vertex_count + std::uint64_t{edges} * bitstream::cells_below(levels) >
      limits.max_vertices)
    return fail("the finest level has more vertices than the limit");
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
  else if (external_levels_ && decoder_.status() != DecodeStatus::broken &&
           header.levels != *external_levels_)
    fail("the stream has " + std::to_string(header.levels) + " levels where " +
         std::to_string(*external_levels_) + " were announced");
}

DecodeStatus ProgressiveSurface::status() const {
  return own_reason_.empty() ? decoder_.status() : DecodeStatus::broken;
}

const std::string& ProgressiveSurface::reason() const {
  return own_reason_.empty() ? decoder_.reason() : own_reason_;
}

bool ProgressiveSurface::is_ready() const {
  return status() != DecodeStatus::broken && (external_levels_ || decoder_.base_ready());
}

int ProgressiveSurface::levels() const {
  return external_levels_ ? *external_levels_ : decoder_.header().levels;
}

const bitstream::BaseTopology& ProgressiveSurface::base() const {
  return decoder_.base();
}

LevelCounts ProgressiveSurface::counts(int level) const {
  return refined_counts(
      {base().vertex_count, decoder_.base_edges().size(), base().triangles.size()}, level);
}

WaveletTransform ProgressiveSurface::transform() const {
  // Without a header there are no details, so any transform will do.
  return decoder_.header_ready() ? static_cast<WaveletTransform>(decoder_.header().transform)
                                 : WaveletTransform::loop_local;
}

Dequantisation ProgressiveSurface::dequantisation() const {
  const bitstream::StreamHeader& header = decoder_.header();
  return {header.finest_step, std::ldexp(1.0f, header.tangent_ratio_log2)};
}

LatticeMesh* ProgressiveSurface::mesh() {
  if (mesh_ && decoder_.base_ready() && base().crease_edges.empty() &&
      base().corner_vertices.empty())
    mesh_has_tags_ = true;  // there are none: it is the same mesh
  if (mesh_ && mesh_has_tags_ == decoder_.base_ready()) return mesh_.get();
  schedule_.reset();
  mesh_.reset();
  const bool has_tags = decoder_.base_ready();
  std::unique_ptr<LatticeMesh> made;
  try {
    made = std::make_unique<LatticeMesh>(base(), decoder_.base_edges(), resources_.memory);
  } catch (const std::invalid_argument& error) {
    fail(error.what());
    return nullptr;
  }
  if (!external_levels_) positions_.resize(3 * std::size_t{base().vertex_count});
  source_ = {};
  schedule_ = std::make_unique<LevelSchedule>(*made, resources_.jobs, resources_.memory);
  // Last: whatever runs out of memory, there is a mesh with its schedule or neither.
  mesh_ = std::move(made);
  mesh_has_tags_ = has_tags;
  return mesh_.get();
}

void ProgressiveSurface::note_changes() {
  if (!decoder_.base_ready()) return;
  const int changed = decoder_.changed_from();
  if (changed == INT_MAX) return;
  decoder_.forget_changes();
  schedule_->invalidate(changed);
  level_errors_.clear();
  if (changed < 0) source_ = {};
}

const SurfaceSource& ProgressiveSurface::source() {
  note_changes();
  if (source_.base_positions.empty()) {
    if (!external_levels_) decoder_.get_base_positions(positions_);
    const std::span<const float> positions =
        external_levels_ ? decoder_.external_positions() : positions_;
    source_ = {positions, {}, mean_face_area(base(), positions)};
  }
  if (!decoder_.base_ready()) return source_;
  const bitstream::DetailState& state = decoder_.details();
  for (int level = 0; level < state.levels(); ++level) {
    LevelDetails& details = details_[static_cast<std::size_t>(level)];
    details = {};
    for (int c = 0; c < bitstream::kChannelCount; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      details.units[channel] =
          detail_unit(dequantisation(), state.levels(), level, static_cast<bitstream::Channel>(c));
      if (!state.has_details(c, level)) continue;
      const bitstream::LevelValues& values = state.values(c, level);
      if (values.is_wide())
        details.channels[channel].wide = values.wide();
      else
        details.channels[channel].narrow = values.narrow();
    }
  }
  source_.details = std::span(details_).first(static_cast<std::size_t>(state.levels()));
  return source_;
}

bool ProgressiveSurface::mesh_wide_points(int level, Positions& points) {
  try {
    const SubdivisionHierarchy& hierarchy = mesh_wide_.hierarchy(base(), transform(), level);
    const SurfaceSource& from = source();
    points =
        reconstruct(hierarchy, Positions(from.base_positions.begin(), from.base_positions.end()),
                    decoder_.coefficients(), dequantisation(), level);
  } catch (const std::invalid_argument& error) {
    fail(error.what());
    return false;
  }
  return true;
}

namespace {

/// Moves limit positions towards their control points.
void move_outward(const Positions& control_points, const LimitOutput& output) {
  for (std::size_t vertex = 0; output.positions.data && 3 * vertex < control_points.size();
       ++vertex) {
    std::array<float, 3> position;
    std::memcpy(position.data(),
                static_cast<const char*>(output.positions.data) + vertex * output.positions.stride,
                sizeof position);
    for (std::size_t axis = 0; axis < 3; ++axis)
      position[axis] += output.outward * (control_points[3 * vertex + axis] - position[axis]);
    output.positions.write(vertex, position.data());
  }
}

}  // namespace

SurfaceOutcome ProgressiveSurface::write_limits(int level, const LimitOutput& output,
                                                const Deadline& deadline) {
  if (!mesh()) return SurfaceOutcome::broken;
  if (transform() == WaveletTransform::loop_quadrature_mirror) {
    Positions points;
    if (!mesh_wide_points(level, points)) return SurfaceOutcome::broken;
    const SubdivisionLevel& topology =
        mesh_wide_.hierarchy(base(), transform(), level).level(level);
    limit_surface(topology, points, output.positions, output.normals);
    if (output.outward != 0.0f) move_outward(points, output);
    return SurfaceOutcome::done;
  }
  return schedule_->write_limits(level, source(), output, deadline) ? SurfaceOutcome::done
                                                                    : SurfaceOutcome::unfinished;
}

template <class Index>
bool ProgressiveSurface::write_triangles(int level, Index* indices) {
  if (!mesh()) return false;
  mesh_->deepen(level);
  for (std::size_t triangle = 0; triangle < mesh_->triangle_count(); ++triangle) {
    mesh_->write_triangles(level, triangle, indices);
    indices += std::size_t{3} << (2 * level);
  }
  return true;
}

template bool ProgressiveSurface::write_triangles(int, std::uint16_t*);
template bool ProgressiveSurface::write_triangles(int, std::uint32_t*);

bool ProgressiveSurface::find_bounds(Box& box, float outward) {
  if (!mesh()) return false;
  box.low.fill(std::numeric_limits<float>::max());
  box.high.fill(std::numeric_limits<float>::lowest());
  const auto include = [&](const float* point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], point[axis]);
      box.high[axis] = std::max(box.high[axis], point[axis]);
    }
  };
  constexpr int kDeepest = 4;
  const bool is_mesh_wide = transform() == WaveletTransform::loop_quadrature_mirror;
  const int level =
      is_mesh_wide ? levels() : std::min({levels(), decoder_.detailed_levels(), kDeepest});
  // What coarser levels show, which lack details of this one.
  std::vector<float> shown;
  for (int coarser = 0; coarser < level; ++coarser) {
    shown.resize(3 * counts(coarser).vertices);
    if (write_limits(coarser, {{shown.data()}, {}, outward}) == SurfaceOutcome::broken)
      return false;
    for (std::size_t i = 0; i < shown.size(); i += 3) include(&shown[i]);
  }
  if (is_mesh_wide) {
    Positions points;
    if (!mesh_wide_points(level, points)) return false;
    for (std::size_t i = 0; i < points.size(); i += 3) include(&points[i]);
    return true;
  }
  // Finer ones are in the hull of this one's control points but for what finer details add.
  schedule_->make_level(level, source(), {});
  for (std::size_t triangle = 0; triangle < mesh_->triangle_count(); ++triangle)
    for (std::uint32_t point = 0; point < mesh_->lattice(level).point_count; ++point) {
      const PointF p = schedule_->points(level).get(triangle, point);
      include(&p.x);
    }
  float reach = 0.0f;
  for (std::size_t finer = static_cast<std::size_t>(level); finer < source_.details.size(); ++finer)
    reach += kReachOfMoves * longest_move(source_.details[finer],
                                          decoder_.details().level_size(static_cast<int>(finer)));
  for (float& low : box.low) low -= reach;
  for (float& high : box.high) high += reach;
  return true;
}

const std::vector<float>* ProgressiveSurface::level_errors(float outward) {
  if (!mesh()) return nullptr;
  note_changes();
  if (!level_errors_.empty() && level_errors_outward_ == outward) return &level_errors_;
  const int measured = std::min(levels(), kMeasuredLevel);
  mesh_->deepen(measured);  // mesh-wide points need no lattice
  std::vector<float> heights(static_cast<std::size_t>(levels()) + 1, 0.0f);
  std::vector<float> coarse, fine;
  for (int level = 0; level <= measured; ++level) {
    std::swap(coarse, fine);
    fine.resize(3 * counts(level).vertices);
    if (write_limits(level, {{fine.data()}, {}, outward}) == SurfaceOutcome::broken) return nullptr;
    if (level > 0)
      heights[static_cast<std::size_t>(level) - 1] = longest_step(*mesh_, level - 1, coarse, fine);
  }
  for (std::size_t level = static_cast<std::size_t>(measured); level + 1 < heights.size(); ++level)
    heights[level] = level == 0 ? 0.0f : 0.25f * heights[level - 1];
  // A point of a level's triangle moves by no more than the next one's vertices, level after level.
  for (std::size_t level = heights.size() - 1; level-- > 0;) heights[level] += heights[level + 1];
  level_errors_ = std::move(heights);
  level_errors_outward_ = outward;
  return &level_errors_;
}

}  // namespace zerotree::surface
