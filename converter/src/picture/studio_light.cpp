#include "picture/studio_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace zerotree::picture {
namespace {

// Rays start this far off the surface; the unit frame has a diagonal of 2.
constexpr float surface_offset = 1e-4F;
// Farther surfaces do not darken: keeps broad hollows from going black.
constexpr float occlusion_reach = 0.7F;
constexpr float ground_reach = 0.4F;
// Radius of the key lamp seen from the model: how soft its shadows are.
constexpr float key_radius = 0.22F;

const Eigen::Vector3f key_colour(2.05F, 1.96F, 1.82F);
const Eigen::Vector3f fill_colour(0.22F, 0.27F, 0.36F);
const Eigen::Vector3f rim_colour(0.60F, 0.66F, 0.75F);
const Eigen::Vector3f sky_colour(0.66F, 0.71F, 0.80F);
const Eigen::Vector3f floor_colour(0.36F, 0.33F, 0.30F);

std::uint32_t hash(std::uint32_t x) {  // Wellons' lowbias32
  x = (x ^ (x >> 16)) * 0x7feb352dU;
  x = (x ^ (x >> 15)) * 0x846ca68bU;
  return x ^ (x >> 16);
}

// A direction of the hemisphere about `normal`, more often where light falls in more steeply.
Eigen::Vector3f cosine_direction(const Eigen::Vector3f& normal, const Eigen::Vector2f& square) {
  const float radius = std::sqrt(square.x());
  const float angle = 2.0F * std::numbers::pi_v<float> * square.y();
  const Eigen::Vector3f tangent = normal.unitOrthogonal();
  return (radius * std::cos(angle) * tangent + radius * std::sin(angle) * normal.cross(tangent) +
          std::sqrt(std::max(0.0F, 1.0F - square.x())) * normal)
      .normalized();
}

}  // namespace

PixelSequence::PixelSequence(std::uint32_t x, std::uint32_t y)
    : u_(hash(x + 65536U * y)), v_(hash(u_ + 0x9e3779b9U)) {}

Eigen::Vector2f PixelSequence::next() {
  u_ += 0xC13FA9A9U;  // 2^32 times the steps of R2 (Roberts 2018)
  v_ += 0x91E10DA5U;
  return {static_cast<float>(u_ >> 8) * 0x1p-24F, static_cast<float>(v_ >> 8) * 0x1p-24F};
}

StudioLight::StudioLight(const RayScene& scene, const Camera& camera)
    : scene_(&scene), up_(camera.world_up) {
  const auto towards = [&](float right, float up, float back) {
    return (right * camera.axes.right + up * camera.axes.up + back * camera.axes.back)
        .normalized()
        .eval();
  };
  key_ = towards(-0.62F, 0.72F, 0.50F);
  fill_ = towards(0.85F, 0.10F, 0.55F);
  rim_ = towards(0.55F, 0.45F, -0.70F);
}

float StudioLight::open_sky(const Eigen::Vector3f& origin, const Eigen::Vector3f& normal,
                            float reach, int rays, PixelSequence& sequence) const {
  int open = 0;
  for (int i = 0; i < rays; ++i)
    if (!scene_->blocked(origin, cosine_direction(normal, sequence.next()), reach)) ++open;
  return static_cast<float>(open) / static_cast<float>(rays);
}

Eigen::Vector3f StudioLight::shade(const LitPoint& point, int sky_rays,
                                   PixelSequence& sequence) const {
  const Eigen::Vector3f& n = point.normal;
  const Eigen::Vector3f origin = point.position + surface_offset * point.plane_normal;
  const float open = open_sky(origin, n, occlusion_reach, sky_rays, sequence);

  const Eigen::Vector2f on_lamp = sequence.next();
  const Eigen::Vector3f side = key_.unitOrthogonal();
  const float radius = key_radius * std::sqrt(on_lamp.x());
  const float angle = 2.0F * std::numbers::pi_v<float> * on_lamp.y();
  const Eigen::Vector3f lamp =
      (key_ + radius * std::cos(angle) * side + radius * std::sin(angle) * key_.cross(side))
          .normalized();
  const float key_cosine = std::max(0.0F, n.dot(lamp));
  const bool lit = key_cosine > 0.0F && !scene_->blocked(origin, lamp);

  const float upward = 0.5F + 0.5F * n.dot(up_);
  Eigen::Vector3f light = open * (upward * sky_colour + (1.0F - upward) * floor_colour) +
                          open * std::max(0.0F, n.dot(fill_)) * fill_colour;
  if (lit) light += key_cosine * key_colour;
  Eigen::Vector3f seen = point.albedo.cwiseProduct(light) * std::numbers::inv_pi_v<float> * 1.7F;

  // A thin coat reflects the key lamp; the rim lamp only shows where the surface turns away.
  const float highlight = std::max(0.0F, n.dot((lamp + point.to_viewer).normalized()));
  if (lit) seen += 0.10F * std::pow(highlight, 38.0F) * key_colour;
  const float away = 1.0F - std::clamp(n.dot(point.to_viewer), 0.0F, 1.0F);
  seen += open * 0.5F * away * away * away * std::max(0.0F, n.dot(rim_)) * rim_colour;
  return seen;
}

float StudioLight::ground_shadow(const Eigen::Vector3f& position, int sky_rays,
                                 PixelSequence& sequence) const {
  const Eigen::Vector3f origin = position + surface_offset * up_;
  return 1.0F - open_sky(origin, up_, ground_reach, sky_rays, sequence);
}

}  // namespace zerotree::picture
