#include "picture/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <string>

#include "mesh/error.h"

namespace zerotree::picture {
namespace {

void check(const TriangleMesh& mesh) {
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t v : t)
      if (v >= mesh.positions.size() || !mesh.positions[v].allFinite())
        throw Error(ExitCode::refused_topology,
                    "cannot draw a mesh whose vertex " + std::to_string(v) +
                        " is missing or not finite: convert or repair it first");
}

RTCRay ray_of(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float reach) {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = reach;
  ray.mask = ~0U;
  return ray;
}

}  // namespace

struct RayScene::Scene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Scene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

RayScene::RayScene(const TriangleMesh& mesh, const UnitFrame& frame)
    : scene_(std::make_unique<Scene>()) {
  check(mesh);
  scene_->device = rtcNewDevice(nullptr);
  if (!scene_->device) throw Error(ExitCode::internal, "cannot draw: Embree offers no device");
  const RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.positions.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  if (!vertices || !indices) {
    rtcReleaseGeometry(geometry);
    throw Error(ExitCode::memory_limit, "cannot draw: not enough memory for the search tree");
  }
  for (const Eigen::Vector3d& p : mesh.positions) {
    const Eigen::Vector3f q = frame(p);
    vertices = std::copy_n(q.data(), 3, vertices);
  }
  for (const Triangle& t : mesh.triangles) indices = std::copy_n(t.data(), 3, indices);

  rtcCommitGeometry(geometry);
  scene_->scene = rtcNewScene(scene_->device);
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips through an edge
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcJoinCommitScene(scene_->scene);  // uses the caller's threads
  if (rtcGetDeviceError(scene_->device) != RTC_ERROR_NONE)
    throw Error(ExitCode::memory_limit, "cannot draw: Embree could not build the search tree");
}

RayScene::~RayScene() = default;

std::optional<RayHit> RayScene::first_hit(const Eigen::Vector3f& origin,
                                          const Eigen::Vector3f& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = ray_of(origin, direction, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Eigen::Vector3f normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  return RayHit{query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v, normal.normalized()};
}

bool RayScene::blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                       float reach) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = ray_of(origin, direction, reach);
  rtcOccluded1(scene_->scene, &context, &ray);
  return ray.tfar < 0.0F;
}

}  // namespace zerotree::picture
