// Errors of prefixes of one stream, measured by decoding them and remembered.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "decode/prefix_surface.h"
#include "decode/stream_file.h"
#include "measure/surface_distance.h"
#include "report/convert_report.h"
#include "surface/subdivision_hierarchy.h"

namespace zerotree::convert {

/// What prefixes are measured against, and how.
struct PrefixMeasurement {
  /// The original input, whose diagonal errors are relative to.
  const measure::SurfaceIndex& original;
  /// Of a quick measurement.
  measure::DistanceOptions distance;
  /// Vertices of the original input: rates are bits per vertex of it.
  std::uint64_t original_vertices;
  /// Bounding box diagonal of the original.
  double diagonal;
  /// Topology of the base and its levels.
  std::shared_ptr<const surface::SubdivisionHierarchy> hierarchy;
  /// Of an exact measurement: as many as `zerotree compare` takes unless told otherwise.
  std::size_t exact_samples = measure::DistanceOptions{}.samples;
};

/// How far a measured error can be trusted. Deviations are rare and large where a remesh cannot
/// follow (inner walls, slits): there a quick measurement may be 10 % off, an exact one 1 %.
enum class Precision {
  quick,  ///< as PrefixMeasurement says
  exact,  ///< with `exact_samples`
};

/// A prefix that has a surface.
struct MeasuredSurface {
  report::PrefixError error;
  /// Of the surface's vertices.
  Eigen::AlignedBox3f box;
};

/// Measures prefixes in any order; those asked for again are not measured again.
class PrefixErrors {
 public:
  /// Refers to both, which must outlive it; `stream` must not change.
  PrefixErrors(const decode::StreamFile& stream, const PrefixMeasurement& how);

  std::uint64_t stream_bytes() const { return stream_.bytes.size(); }
  const PrefixMeasurement& how() const { return how_; }
  /// Empty if the prefix ends before the base is known.
  const std::optional<MeasuredSurface>& at(std::uint64_t bytes, Precision precision);
  /// Its error alone, relative; infinite without a surface.
  double error(std::uint64_t bytes, Precision precision);
  /// Box of what prefixes shorter than `bytes` show: those of no byte and of each power of two. Empty
  /// if none has a surface.
  Eigen::AlignedBox3f box_before(std::uint64_t bytes);
  /// Length of the shortest prefix that has a surface.
  std::uint64_t shortest_with_surface();

 private:
  decode::PrefixSurface& decoded(std::uint64_t bytes);

  const decode::StreamFile& stream_;
  const PrefixMeasurement& how_;
  std::unique_ptr<decode::PrefixSurface> prefix_;
  std::uint64_t decoded_bytes_ = 0;
  std::map<std::pair<std::uint64_t, Precision>, std::optional<MeasuredSurface>> known_;
};

}  // namespace zerotree::convert
