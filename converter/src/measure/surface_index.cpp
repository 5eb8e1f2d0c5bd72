#include "measure/surface_index.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "measure/closest_point_on_triangle.h"
#include "mesh/error.h"

namespace zerotree::measure {
namespace {

// The hierarchy's boxes and radii are floats in a frame where the mesh spans [-1, 1]. There, a
// rounded coordinate of the mesh is wrong by at most 2^-25, one of a query point p by 2^-25 of
// max(1, |p|), and the box distance by a few units in the last place. A search radius enlarged by
// this share of (radius + 1 + |p|) covers all of it ten times over, so no nearer point is missed.
constexpr double radius_padding = 2e-6;

void check(const TriangleMesh& mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (!mesh.positions[v].allFinite())
      throw Error(ExitCode::refused_topology, "cannot measure: vertex " + std::to_string(v) +
                                                  " has a coordinate that is not a finite number");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t v : mesh.triangles[t])
      if (v >= mesh.positions.size())
        throw Error(ExitCode::refused_topology, "cannot measure: triangle " + std::to_string(t) +
                                                    " names vertex " + std::to_string(v) +
                                                    " which does not exist");
}

// Triangles of no area are no part of the surface: they neither attract samples nor receive them.
std::vector<std::uint32_t> triangles_with_area(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> kept;
  kept.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d& p = mesh.positions[a];
    if ((mesh.positions[b] - p).cross(mesh.positions[c] - p).squaredNorm() > 0.0) kept.push_back(t);
  }
  if (kept.empty())
    throw Error(ExitCode::refused_topology,
                "cannot measure: the mesh has no triangle of positive area");
  return kept;
}

}  // namespace

struct SurfaceIndex::Bvh {
  const TriangleMesh* mesh = nullptr;
  std::vector<std::uint32_t> triangles;  // Embree's primitive -> the mesh's triangle
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double scale = 1.0;  // into the frame of the hierarchy
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Bvh(const TriangleMesh& surface, int threads);
  ~Bvh() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Bvh(const Bvh&) = delete;
  Bvh& operator=(const Bvh&) = delete;

  void set_frame();
  void build();
  float padded_radius(double distance_squared, double query_size) const {
    const double radius = std::sqrt(distance_squared) * scale;
    return static_cast<float>(radius + radius_padding * (radius + 1.0 + query_size));
  }
  void improve(const Eigen::Vector3d& p, std::uint32_t triangle, SurfacePoint& best) const;
};

SurfaceIndex::Bvh::Bvh(const TriangleMesh& surface, int threads) : mesh(&surface) {
  check(surface);
  triangles = triangles_with_area(surface);
  set_frame();
  device = rtcNewDevice(nullptr);
  if (!device) throw Error(ExitCode::internal, "cannot measure: Embree offers no device");
  // The build joins the arena it is called in. (Embree's own option for the number of threads would
  // limit the whole process.)
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([this] { build(); });
}

void SurfaceIndex::Bvh::set_frame() {
  Eigen::Vector3d low = mesh->positions[mesh->triangles[triangles[0]][0]], high = low;
  for (std::uint32_t t : triangles)
    for (std::uint32_t v : mesh->triangles[t]) {
      low = low.cwiseMin(mesh->positions[v]);
      high = high.cwiseMax(mesh->positions[v]);
    }
  centre = 0.5 * (low + high);
  scale = 2.0 / (high - low).maxCoeff();
}

void SurfaceIndex::Bvh::build() {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh->positions.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), triangles.size()));
  if (!vertices || !indices) {
    rtcReleaseGeometry(geometry);
    throw Error(ExitCode::memory_limit, "cannot measure: not enough memory for the search tree");
  }
  for (const Eigen::Vector3d& p : mesh->positions) {
    const Eigen::Vector3f q = ((p - centre) * scale).cast<float>();
    vertices = std::copy_n(q.data(), 3, vertices);
  }
  for (std::uint32_t t : triangles) indices = std::copy_n(mesh->triangles[t].data(), 3, indices);

  rtcCommitGeometry(geometry);
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT));
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcJoinCommitScene(scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    throw Error(ExitCode::memory_limit, "cannot measure: Embree could not build the search tree");
}

void SurfaceIndex::Bvh::improve(const Eigen::Vector3d& p, std::uint32_t triangle,
                                SurfacePoint& best) const {
  const auto& [a, b, c] = mesh->triangles[triangle];
  const Eigen::Vector3d nearest =
      closest_point_on_triangle(p, mesh->positions[a], mesh->positions[b], mesh->positions[c]);
  const double distance_squared = (nearest - p).squaredNorm();
  if (distance_squared > best.distance_squared) return;
  if (distance_squared == best.distance_squared && triangle >= best.triangle) return;
  best = {nearest, distance_squared, triangle};
}

SurfaceIndex::SurfaceIndex(const TriangleMesh& mesh, int threads)
    : bvh_(std::make_unique<Bvh>(mesh, threads)) {}
SurfaceIndex::~SurfaceIndex() = default;
SurfaceIndex::SurfaceIndex(SurfaceIndex&&) noexcept = default;
SurfaceIndex& SurfaceIndex::operator=(SurfaceIndex&&) noexcept = default;

const TriangleMesh& SurfaceIndex::mesh() const {
  return *bvh_->mesh;
}

SurfacePoint SurfaceIndex::closest(const Eigen::Vector3d& p, std::uint32_t hint) const {
  struct Search {
    const Bvh& bvh;
    const Eigen::Vector3d& point;
    double size;  // of the point in the frame of the hierarchy
    SurfacePoint best;
  };
  const Eigen::Vector3d q = (p - bvh_->centre) * bvh_->scale;
  Search search{*bvh_, p, q.cwiseAbs().maxCoeff(), {}};
  const bool hinted = hint < bvh_->mesh->triangles.size();
  bvh_->improve(p, hinted ? hint : bvh_->triangles.front(), search.best);

  RTCPointQuery query{};
  query.x = static_cast<float>(q.x());
  query.y = static_cast<float>(q.y());
  query.z = static_cast<float>(q.z());
  query.radius = bvh_->padded_radius(search.best.distance_squared, search.size);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto visit = [](RTCPointQueryFunctionArguments* arguments) {
    auto& state = *static_cast<Search*>(arguments->userPtr);
    const double before = state.best.distance_squared;
    state.bvh.improve(state.point, state.bvh.triangles[arguments->primID], state.best);
    if (state.best.distance_squared == before) return false;
    arguments->query->radius = state.bvh.padded_radius(state.best.distance_squared, state.size);
    return true;
  };
  rtcPointQuery(bvh_->scene, &query, &context, visit, &search);
  return search.best;
}

}  // namespace zerotree::measure
