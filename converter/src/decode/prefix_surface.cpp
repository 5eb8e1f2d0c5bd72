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

bool PrefixSurface::has_surface() const {
  return decoder_.base_ready() || file_.external_base;
}

void PrefixSurface::require_surface() const {
  if (!has_surface())
    throw Error(ExitCode::unreadable_input,
                "more bytes wanted: the first " + std::to_string(fed_) +
                    " bytes end before the connectivity of the base mesh does; take a longer "
                    "prefix");
}

int PrefixSurface::levels() const {
  return decoder_.base_ready() ? decoder_.header().levels : file_.levels;
}

const bitstream::BaseTopology& PrefixSurface::base() const {
  return decoder_.base_ready() ? decoder_.base() : file_.base;
}

int PrefixSurface::automatic_level() {
  require_surface();
  int smooth = 0;
  for (std::uint64_t faces = base().triangles.size(); faces < kSmoothFaces; faces *= 4) ++smooth;
  return std::min(levels(), std::max(smooth, decoder_.detailed_levels()));
}

const surface::SubdivisionHierarchy& PrefixSurface::hierarchy_to(int level) {
  const auto fits = [&](const surface::SubdivisionHierarchy& hierarchy) {
    return hierarchy.levels() >= level && hierarchy.base().crease_edges == base().crease_edges &&
           hierarchy.base().corner_vertices == base().corner_vertices;
  };
  if (hierarchy_ == nullptr || !fits(*hierarchy_))
    hierarchy_ = std::make_shared<const surface::SubdivisionHierarchy>(
        base(), level, static_cast<surface::WaveletTransform>(decoder_.header().transform));
  return *hierarchy_;
}

surface::Positions PrefixSurface::control_points(int level) {
  const surface::SubdivisionHierarchy& hierarchy = hierarchy_to(level);
  if (!decoder_.base_ready()) {
    surface::Positions positions = file_.base_positions;
    for (int l = 0; l < level; ++l) positions = surface::subdivide(hierarchy.level(l), positions);
    return positions;
  }
  const bitstream::StreamHeader& header = decoder_.header();
  const surface::Dequantisation dequantisation{
      static_cast<surface::WaveletTransform>(header.transform), header.finest_step,
      std::ldexp(1.0f, header.tangent_ratio_log2)};
  return surface::reconstruct(hierarchy, decoder_.base_positions(), decoder_.coefficients(),
                              dequantisation, level);
}

exporter::Surface PrefixSurface::surface(std::optional<int> asked) {
  require_surface();
  const int level = asked.value_or(automatic_level());
  if (level < 0 || level > levels())
    throw Error(ExitCode::usage, "level " + std::to_string(level) +
                                     " does not exist: this stream has levels 0 to " +
                                     std::to_string(levels()));
  const surface::Positions control = control_points(level);
  const surface::SubdivisionLevel& finest = hierarchy_to(level).level(level);
  exporter::Surface result;
  result.positions.resize(finest.vertex_count);
  result.normals.resize(finest.vertex_count);
  result.triangles = finest.triangles;
  surface::limit_surface(finest, control, {result.positions.data(), sizeof(Eigen::Vector3f)},
                         {result.normals.data(), sizeof(Eigen::Vector3f)});
  return result;
}

Eigen::AlignedBox3f PrefixSurface::bounds() {
  require_surface();
  // No detail lies below the automatic level, so its control points are those of the surface.
  const surface::Positions control = control_points(automatic_level());
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < control.size(); i += 3)
    box.extend(Eigen::Vector3f(control[i], control[i + 1], control[i + 2]));
  return box;
}

TriangleMesh to_triangle_mesh(const exporter::Surface& surface) {
  TriangleMesh mesh;
  mesh.positions.reserve(surface.positions.size());
  for (const Eigen::Vector3f& p : surface.positions) mesh.positions.push_back(p.cast<double>());
  mesh.triangles = surface.triangles;
  return mesh;
}

}  // namespace zerotree::decode
