// The light of a photographer's studio: key, fill and rim lamps, and soft light from the sky.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "picture/camera.h"
#include "picture/ray_scene.h"

namespace zerotree::picture {

/// A point of the surface as light sees it.
struct LitPoint {
  Eigen::Vector3f position;
  /// Of the triangle's plane and of the smooth surface; unit length, both towards the viewer.
  Eigen::Vector3f plane_normal, normal;
  Eigen::Vector3f to_viewer;
  /// Reflected share of red, green and blue, linear.
  Eigen::Vector3f albedo;
};

/// Evenly spread numbers for one pixel's rays: the R2 sequence, moved by a hash of the pixel so
/// that neighbouring pixels do not show the same pattern. The same on every run.
class PixelSequence {
 public:
  PixelSequence(std::uint32_t x, std::uint32_t y);
  /// The next point of the unit square.
  Eigen::Vector2f next();

 private:
  std::uint32_t u_, v_;
};

/// Light that comes from the lamps and the sky to a scene; it moves with the camera.
class StudioLight {
 public:
  StudioLight(const RayScene& scene, const Camera& camera);

  /// Linear red, green and blue that the viewer sees at `point`, with one shadow ray and
  /// `sky_rays` rays of ambient occlusion: the mean over a pixel's samples is what counts.
  Eigen::Vector3f shade(const LitPoint& point, int sky_rays, PixelSequence& sequence) const;

  /// Share of the sky, 0..1, that the model hides from a point of the ground.
  float ground_shadow(const Eigen::Vector3f& position, int sky_rays, PixelSequence& sequence) const;

 private:
  float open_sky(const Eigen::Vector3f& origin, const Eigen::Vector3f& normal, float reach,
                 int rays, PixelSequence& sequence) const;

  const RayScene* scene_;
  Eigen::Vector3f key_, fill_, rim_, up_;
};

}  // namespace zerotree::picture
