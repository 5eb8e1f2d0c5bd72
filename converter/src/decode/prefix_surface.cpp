#include "decode/prefix_surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/error.h"
#include "surface/detail_weights.h"
#include "surface/surface_synthesis.h"

namespace zerotree::decode {
namespace {

// Faces from which a sampled limit surface looks smooth, and its chords matter less than what a
// prefix that short leaves out.
constexpr std::uint64_t kSmoothFaces = 20000;

bitstream::StreamDecoder make_decoder(const StreamFile& file) {
  return file.external_base ? bitstream::StreamDecoder(file.base, file.base_positions)
                            : bitstream::StreamDecoder();
}

}  // namespace

PrefixSurface::PrefixSurface(const StreamFile& file,
                             std::shared_ptr<const surface::SubdivisionHierarchy> hierarchy)
    : file_(file), decoder_(make_decoder(file)), hierarchy_(std::move(hierarchy)) {}

void PrefixSurface::advance_to(std::uint64_t bytes) {
  const std::uint64_t end = std::min<std::uint64_t>(bytes, file_.bytes.size());
  if (end > fed_) {
    decoder_.feed({file_.bytes.data() + fed_, static_cast<std::size_t>(end - fed_)});
    fed_ = end;
  }
  if (decoder_.status() == bitstream::DecodeStatus::broken)
    throw Error(ExitCode::unreadable_input,
                "the stream is broken: " + decoder_.reason() + "; get a fresh copy of the file");
}

void PrefixSurface::require_base() const {
  if (!decoder_.base_ready())
    throw Error(ExitCode::unreadable_input,
                "more bytes wanted: the first " + std::to_string(fed_) +
                    " bytes end before the connectivity of the base mesh does; take a longer "
                    "prefix");
}

int PrefixSurface::automatic_level() {
  require_base();
  int smooth = 0;
  for (std::uint64_t faces = decoder_.header().face_count; faces < kSmoothFaces; faces *= 4)
    ++smooth;
  return std::min(decoder_.header().levels, std::max(smooth, decoder_.detailed_levels()));
}

const surface::SubdivisionHierarchy& PrefixSurface::hierarchy_to(int level) {
  if (hierarchy_ == nullptr || hierarchy_->levels() < level)
    hierarchy_ = std::make_shared<const surface::SubdivisionHierarchy>(
        decoder_.base(), level,
        static_cast<surface::WaveletTransform>(decoder_.header().transform));
  return *hierarchy_;
}

exporter::Surface PrefixSurface::surface(std::optional<int> asked) {
  require_base();
  const bitstream::StreamHeader& header = decoder_.header();
  const int level = asked.value_or(automatic_level());
  if (level < 0 || level > header.levels)
    throw Error(ExitCode::usage, "level " + std::to_string(level) +
                                     " does not exist: this stream has levels 0 to " +
                                     std::to_string(header.levels));
  const surface::SubdivisionHierarchy& hierarchy = hierarchy_to(level);
  const surface::Positions base = decoder_.base_positions();
  const surface::Dequantisation dequantisation{
      static_cast<surface::WaveletTransform>(header.transform), header.finest_step,
      std::ldexp(1.0f, header.tangent_ratio_log2)};
  const surface::Positions control =
      surface::reconstruct(hierarchy, base, decoder_.coefficients(), dequantisation, level);
  const surface::SubdivisionLevel& finest = hierarchy.level(level);
  exporter::Surface result;
  result.positions.resize(finest.vertex_count);
  result.normals.resize(finest.vertex_count);
  result.triangles = finest.triangles;
  surface::limit_surface(finest, control, {result.positions.data(), sizeof(Eigen::Vector3f)},
                         {result.normals.data(), sizeof(Eigen::Vector3f)});
  return result;
}

TriangleMesh to_triangle_mesh(const exporter::Surface& surface) {
  TriangleMesh mesh;
  mesh.positions.reserve(surface.positions.size());
  for (const Eigen::Vector3f& p : surface.positions) mesh.positions.push_back(p.cast<double>());
  mesh.triangles = surface.triangles;
  return mesh;
}

}  // namespace zerotree::decode
