#include "validate/surface_findings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace zerotree::validate {
namespace {

using gltf::IssueCode;
using gltf::Issues;

// Rounding of two evaluations of the same surface differs by about 1e-7 of its size.
constexpr double kBoundsTolerance = 1e-5;
// Of sourceDiagonal: half a percent of margin is what the specification suggests.
constexpr double kLooseBounds = 0.1;
// Of the surface's diagonal: what decoders may differ by.
constexpr float kSeamTolerance = 1e-5f;

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// Empty if a position is not finite.
std::optional<Eigen::AlignedBox3f> finite_box(std::span<const float> limits) {
  Eigen::AlignedBox3f box;
  bool is_finite = true;
  for (std::size_t i = 0; i < limits.size(); i += 3) {
    const Eigen::Vector3f p(limits[i], limits[i + 1], limits[i + 2]);
    is_finite = is_finite && p.allFinite();
    box.extend(p);
  }
  if (!is_finite) return std::nullopt;
  return box;
}

std::string after_bytes(std::uint64_t bytes) {
  return "after " + std::to_string(bytes) + " bytes";
}

}  // namespace

std::string SurfaceFindings::pointer_to(const Checkpoint& checkpoint) const {
  if (stated_ == nullptr) return "";
  return checkpoint.entry ? stated_->extension + "/prefixes/" + std::to_string(*checkpoint.entry)
                          : stated_->extension;
}

void SurfaceFindings::look_at(const Checkpoint& checkpoint, std::span<const float> limits) {
  ++surfaces_;
  const std::optional<Eigen::AlignedBox3f> box = finite_box(limits);
  if (!box) {
    found_.push_back(
        {IssueCode::surface_not_finite, pointer_to(checkpoint), after_bytes(checkpoint.bytes)});
    return;
  }
  box_.extend(*box);
  if (stated_ != nullptr) check_bounds(checkpoint, *box);
  if (seams_ != nullptr) check_seams(checkpoint, box->diagonal().norm(), limits);
}

void SurfaceFindings::check_bounds(const Checkpoint& checkpoint, const Eigen::AlignedBox3f& box) {
  const Eigen::AlignedBox3f& bounds = stated_->bounds;
  const float outside =
      std::max((bounds.min() - box.min()).maxCoeff(), (box.max() - bounds.max()).maxCoeff());
  if (outside <= kBoundsTolerance * bounds.cast<double>().diagonal().norm()) return;
  const std::string detail = after_bytes(checkpoint.bytes) + ", by up to " + text_of(outside);
  if (checkpoint.entry) {
    found_.push_back({IssueCode::surface_out_of_bounds, pointer_to(checkpoint), detail});
  } else if (outside > farthest_between_entries_) {
    farthest_between_entries_ = outside;
    outside_between_entries_ = {IssueCode::prefix_out_of_bounds, stated_->extension + "/bounds",
                                detail};
  }
}

void SurfaceFindings::check_seams(const Checkpoint& checkpoint, float diagonal,
                                  std::span<const float> limits) {
  const SeamGaps gaps = seams_->measure(limits);
  const auto keep = [&](const SeamGap& gap, WidestGap& widest) {
    const float relative = gap.distance / diagonal;
    if (relative > widest.relative) widest = {relative, gap.seam, checkpoint.bytes};
  };
  keep(gaps.between_primitives, between_primitives_);
  keep(gaps.within_primitive, within_primitive_);
}

std::string SurfaceFindings::describe(const WidestGap& gap) const {
  const auto& [a, b] = seams_->seams()[gap.seam].vertices;
  const auto edge = [](const std::array<std::uint32_t, 2>& ends) {
    return std::to_string(ends[0]) + "-" + std::to_string(ends[1]);
  };
  return "base edges " + edge(a) + " and " + edge(b) + " are " + text_of(gap.relative) +
         " of the surface's diagonal apart " + after_bytes(gap.bytes);
}

void SurfaceFindings::add_seams(Issues& issues) const {
  if (seams_ == nullptr || seams_->seams().empty()) return;
  const std::string mesh = stated_ == nullptr ? "" : stated_->mesh;
  const auto& [a, b] = seams_->seams().front().vertices;
  issues.push_back({IssueCode::base_seam, mesh,
                    std::to_string(seams_->seams().size()) + " pairs of edges, the first at the " +
                        "vertices " + std::to_string(a[0]) + " and " + std::to_string(b[0])});
  if (within_primitive_.relative > kSeamTolerance)
    issues.push_back({IssueCode::surface_seam_open, mesh, describe(within_primitive_)});
  if (between_primitives_.relative > kSeamTolerance)
    issues.push_back({IssueCode::surface_cracked, mesh, describe(between_primitives_)});
}

void SurfaceFindings::add_loose_bounds(Issues& issues) const {
  if (stated_ == nullptr || box_.isEmpty()) return;
  const Eigen::AlignedBox3f& bounds = stated_->bounds;
  const double room =
      std::max((box_.min() - bounds.min()).maxCoeff(), (bounds.max() - box_.max()).maxCoeff());
  if (room <= kLooseBounds * stated_->source_diagonal) return;
  issues.push_back({IssueCode::bounds_loose, stated_->extension + "/bounds",
                    "by up to " + text_of(room) + " at one side, sourceDiagonal is " +
                        text_of(stated_->source_diagonal)});
}

void SurfaceFindings::add_issues(bool is_whole, Issues& issues) const {
  issues.insert(issues.end(), found_.begin(), found_.end());
  if (outside_between_entries_) issues.push_back(*outside_between_entries_);
  if (is_whole) add_loose_bounds(issues);
  add_seams(issues);
}

}  // namespace zerotree::validate
