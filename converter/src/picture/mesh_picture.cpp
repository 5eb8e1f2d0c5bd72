#include "picture/mesh_picture.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/error.h"
#include "picture/automatic_view.h"
#include "picture/ray_scene.h"
#include "picture/studio_light.h"

namespace zerotree::picture {
namespace {

const Eigen::Vector3f clay(0.72F, 0.66F, 0.58F);
constexpr float darkest_ground = 0.55F;
constexpr float shadow_border = 0.12F;
// What the border of a silhouette gets of even light: enough to keep its hue.
constexpr float least_even_light = 0.3F;
// Shadow on the bare ground shows noise more than shade on relief does.
constexpr int ground_ray_factor = 3;

// What one sample sees: premultiplied linear colour and coverage.
using Sample = Eigen::Vector4f;

void check(const Model& model, const RenderOptions& options) {
  const std::size_t vertices = model.mesh->positions.size();
  if ((!model.normals.empty() && model.normals.size() != vertices) ||
      (!model.colours.empty() && model.colours.size() != vertices))
    throw Error(ExitCode::usage, "cannot draw: normals and colours must be one per vertex");
  if (options.width < 1 || options.height < 1 || options.width > 32768 || options.height > 32768)
    throw Error(ExitCode::usage, "a picture is 1 to 32768 pixels wide and high");
  if (options.supersampling < 1 || options.supersampling > 16 || options.sky_rays < 1 ||
      options.threads < 0 || options.margin < 0.0 || options.margin > 0.45)
    throw Error(ExitCode::usage, "cannot draw: a rendering option is out of its range");
}

class Renderer {
 public:
  Renderer(const Model& model, const Camera& camera, const RenderOptions& options)
      : model_(model),
        camera_(camera),
        options_(options),
        normals_(model.normals.empty() ? vertex_normals(*model.mesh) : model.normals),
        scene_(*model.mesh, camera.frame),
        light_(scene_, camera) {}

  Pixel pixel(int x, int y) const {
    PixelSequence sequence(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    const int n = options_.supersampling;
    Sample sum = Sample::Zero();
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Eigen::Vector2f jitter = sequence.next();
        const float sx =
            static_cast<float>(x) + (static_cast<float>(i) + jitter.x()) / static_cast<float>(n);
        const float sy =
            static_cast<float>(y) + (static_cast<float>(j) + jitter.y()) / static_cast<float>(n);
        const Eigen::Vector3f direction = camera_.ray(sx / static_cast<float>(options_.width),
                                                      sy / static_cast<float>(options_.height));
        sum += sample(direction.normalized(), sequence);
      }
    sum /= static_cast<float>(n * n);
    const bool only_shadow = sum.head<3>().isZero();
    return to_pixel(only_shadow ? Sample(sum * border_fade(x, y)) : sum);
  }

 private:
  Sample sample(const Eigen::Vector3f& direction, PixelSequence& sequence) const {
    const std::optional<RayHit> hit = scene_.first_hit(camera_.eye, direction);
    if (!hit) return options_.ground_shadow ? ground(direction, sequence) : Sample::Zero();
    // Bright spots are cut before averaging, or they would stay jagged.
    const Eigen::Vector3f colour = light(lit_point(*hit, direction), sequence).cwiseMin(1.0F);
    return {colour.x(), colour.y(), colour.z(), 1.0F};
  }

  Eigen::Vector3f light(const LitPoint& point, PixelSequence& sequence) const {
    if (!options_.even_light) return light_.shade(point, options_.sky_rays, sequence);
    const float facing = std::max(0.0F, point.normal.dot(point.to_viewer));
    return (least_even_light + (1.0F - least_even_light) * facing) * point.albedo;
  }

  // The shadow fades towards the image's border, so that no edge shows where it is cut off.
  float border_fade(int x, int y) const {
    const float across = static_cast<float>(std::min(x, options_.width - 1 - x)) /
                         static_cast<float>(options_.width);
    const float upwards = static_cast<float>(std::min(y, options_.height - 1 - y)) /
                          static_cast<float>(options_.height);
    const float share = std::clamp(std::min(across, upwards) / shadow_border, 0.0F, 1.0F);
    return share * share * (3.0F - 2.0F * share);
  }

  // The ground itself is not seen, only the shadow on it.
  Sample ground(const Eigen::Vector3f& direction, PixelSequence& sequence) const {
    const float fall = -direction.dot(camera_.world_up);
    const float height = camera_.eye.dot(camera_.world_up) - camera_.ground;
    if (fall <= 1e-3F || height <= 0.0F) return Sample::Zero();
    const Eigen::Vector3f position = camera_.eye + height / fall * direction;
    if (position.norm() > 2.5F) return Sample::Zero();
    const float hidden =
        light_.ground_shadow(position, ground_ray_factor * options_.sky_rays, sequence);
    return {0.0F, 0.0F, 0.0F, darkest_ground * hidden * hidden};
  }

  LitPoint lit_point(const RayHit& hit, const Eigen::Vector3f& direction) const {
    const Triangle& t = model_.mesh->triangles[hit.triangle];
    const float w = 1.0F - hit.u - hit.v;
    LitPoint point;
    point.position = camera_.eye + hit.distance * direction;
    point.to_viewer = -direction;
    const float side = hit.plane_normal.dot(direction) > 0.0F ? -1.0F : 1.0F;
    point.plane_normal = side * hit.plane_normal;
    point.normal = point.plane_normal;
    if (!options_.flat) {
      const Eigen::Vector3f smooth =
          side * (w * normals_[t[0]] + hit.u * normals_[t[1]] + hit.v * normals_[t[2]]);
      if (smooth.squaredNorm() > 1e-12F) point.normal = smooth.normalized();
      point.position += bulge(t, hit, point, w);
    }
    point.albedo = clay;
    if (!model_.colours.empty())
      point.albedo =
          w * model_.colours[t[0]] + hit.u * model_.colours[t[1]] + hit.v * model_.colours[t[2]];
    return point;
  }

  // Moves the origin of shadow rays out to the smooth surface that the normals mean (Hanika 2021),
  // so that facets cast no shadow on their neighbours where light grazes.
  Eigen::Vector3f bulge(const Triangle& t, const RayHit& hit, const LitPoint& point,
                        float w) const {
    const std::array<float, 3> weights{w, hit.u, hit.v};
    Eigen::Vector3f outwards = Eigen::Vector3f::Zero();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f& n = normals_[t[k]];
      const Eigen::Vector3f from_corner =
          point.position - camera_.frame(model_.mesh->positions[t[k]]);
      outwards -= weights[k] * std::min(0.0F, from_corner.dot(n)) * n;
      // On the back side the same surface bulges the other way: stay on the facet.
    }
    return outwards.dot(point.plane_normal) > 0.0F ? outwards : Eigen::Vector3f::Zero();
  }

  static Pixel to_pixel(const Sample& mean) {
    if (mean.w() <= 0.0F) return {0, 0, 0, 0};
    const auto byte = [](float share) {
      return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(share, 0.0F, 1.0F)));
    };
    const auto encoded = [&](float linear) {  // sRGB's transfer function
      const float v = std::clamp(linear / mean.w(), 0.0F, 1.0F);
      return byte(v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1.0F / 2.4F) - 0.055F);
    };
    return {encoded(mean.x()), encoded(mean.y()), encoded(mean.z()), byte(mean.w())};
  }

  const Model& model_;
  const Camera& camera_;
  const RenderOptions& options_;
  std::vector<Eigen::Vector3f> normals_;
  RayScene scene_;
  StudioLight light_;
};

}  // namespace

std::vector<Eigen::Vector3f> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> sums(mesh.positions.size(), Eigen::Vector3d::Zero());
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = mesh.positions[t[k]];
      const Eigen::Vector3d a = mesh.positions[t[(k + 1) % 3]] - p;
      const Eigen::Vector3d b = mesh.positions[t[(k + 2) % 3]] - p;
      const Eigen::Vector3d n = a.cross(b);
      const double length = n.norm();
      if (length > 0.0) sums[t[k]] += std::atan2(length, a.dot(b)) / length * n;
    }
  }
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(sums.size());
  for (const Eigen::Vector3d& n : sums) normals.push_back(n.normalized().cast<float>());
  return normals;
}

Camera choose_camera(const TriangleMesh& mesh, const RenderOptions& options) {
  const Eigen::Vector3d up = options.up.isZero() ? automatic_up(mesh) : options.up;
  const Eigen::Vector3d back =
      options.view_direction.isZero() ? automatic_view(mesh, up) : options.view_direction;
  const double aspect = static_cast<double>(options.width) / options.height;
  return fit_camera(mesh, back, up, aspect, options.margin);
}

Image render(const Model& model, const Camera& camera, const RenderOptions& options) {
  check(model, options);
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  return arena.execute([&] {
    const Renderer renderer(model, camera, options);
    Image image(options.width, options.height);
    tbb::parallel_for(0, options.height, [&](int y) {
      for (int x = 0; x < options.width; ++x) image.at(x, y) = renderer.pixel(x, y);
    });
    return image;
  });
}

Image render(const TriangleMesh& mesh, const RenderOptions& options) {
  const Model model{&mesh};
  check(model, options);
  Image picture =
      gradient(options.width, options.height, {250, 250, 251, 255}, {222, 225, 230, 255});
  lay_over(picture, render(model, choose_camera(mesh, options), options), 0, 0);
  return picture;
}

}  // namespace zerotree::picture
