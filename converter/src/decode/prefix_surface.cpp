#include "decode/prefix_surface.h"

#include <algorithm>
#include <string>
#include <utility>

#include "mesh/error.h"
#include "surface/surface_synthesis.h"

namespace zerotree::decode {
namespace {

// Faces from which a sampled limit surface looks smooth, and its chords matter less than what a
// prefix that short leaves out.
constexpr std::uint64_t kSmoothFaces = 20000;

surface::ProgressiveSurface make_surface(const StreamFile& file) {
  if (!file.external_base) return surface::ProgressiveSurface();
  return surface::ProgressiveSurface({file.base, file.base_positions, file.levels});
}

void put_in_place(const gltf::Placement& placement, std::vector<Eigen::Vector3f>& positions) {
  if (placement.scale == 1 && placement.translation.isZero(0)) return;
  for (Eigen::Vector3f& p : positions)
    p = (placement.scale * p.cast<double>() + placement.translation).cast<float>();
}

}  // namespace

PrefixSurface::PrefixSurface(const StreamFile& file,
                             std::shared_ptr<const surface::SubdivisionHierarchy> hierarchy)
    : file_(file), surface_(make_surface(file)) {
  surface_.share(std::move(hierarchy));
}

void PrefixSurface::refuse_broken() const {
  throw Error(ExitCode::unreadable_input,
              "the stream is broken: " + surface_.reason() + "; get a fresh copy of the file");
}

void PrefixSurface::advance_to(std::uint64_t bytes) {
  const std::uint64_t end = std::min<std::uint64_t>(bytes, file_.bytes.size());
  if (end > fed_) {
    surface_.feed({file_.bytes.data() + fed_, static_cast<std::size_t>(end - fed_)});
    fed_ = end;
  }
  if (surface_.status() == bitstream::DecodeStatus::broken) refuse_broken();
}

bool PrefixSurface::has_surface() const {
  return surface_.is_ready();
}

void PrefixSurface::require_surface() const {
  if (surface_.status() == bitstream::DecodeStatus::broken) refuse_broken();
  if (!has_surface())
    throw Error(ExitCode::unreadable_input,
                "more bytes wanted: the first " + std::to_string(fed_) +
                    " bytes end before the connectivity and creases of the base mesh do; take a "
                    "longer prefix");
}

int PrefixSurface::automatic_level() {
  require_surface();
  int smooth = 0;
  for (std::uint64_t faces = surface_.base().triangles.size(); faces < kSmoothFaces; faces *= 4)
    ++smooth;
  return std::min(surface_.levels(), std::max(smooth, decoder().detailed_levels()));
}

exporter::Surface PrefixSurface::surface(std::optional<int> asked, float outward) {
  require_surface();
  const int level = asked.value_or(automatic_level());
  if (level < 0 || level > surface_.levels())
    throw Error(ExitCode::usage, "level " + std::to_string(level) +
                                     " does not exist: this stream has levels 0 to " +
                                     std::to_string(surface_.levels()));
  exporter::Surface result;
  result.positions.resize(surface_.counts(level).vertices);
  result.normals.resize(result.positions.size());
  result.triangles.resize(surface_.counts(level).triangles);
  const surface::LimitOutput output{{result.positions.data(), sizeof(Eigen::Vector3f)},
                                    {result.normals.data(), sizeof(Eigen::Vector3f)},
                                    outward};
  if (surface_.write_limits(level, output) == surface::SurfaceOutcome::broken ||
      !surface_.write_triangles(level, result.triangles.data()->data()))
    refuse_broken();
  put_in_place(file_.placement, result.positions);
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
