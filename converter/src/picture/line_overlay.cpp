#include "picture/line_overlay.h"

#include <algorithm>
#include <cmath>

#include "picture/ray_scene.h"

namespace zerotree::picture {
namespace {

// How far points are moved towards the viewer before they are tested; the unit frame has a diagonal
// of 2.
constexpr float kLift = 4e-4F;

/// How much of each pixel lines of one colour cover. The largest share counts, not the sum, so that
/// pieces of a line that overlap do not show.
class Coverage {
 public:
  explicit Coverage(const Image& image)
      : width_(image.width), height_(image.height), shares_(image.pixels.size(), 0.0F) {}

  void add(const Eigen::Vector2f& a, const Eigen::Vector2f& b, float line_width) {
    const float radius = 0.5F * line_width;
    const Eigen::Vector2f low = a.cwiseMin(b).array() - (radius + 1.0F);
    const Eigen::Vector2f high = a.cwiseMax(b).array() + (radius + 1.0F);
    const int first_x = first(low.x()), last_x = last(high.x(), width_);
    const int first_y = first(low.y()), last_y = last(high.y(), height_);
    const Eigen::Vector2f along = b - a;
    const float squared = std::max(along.squaredNorm(), 1e-12F);
    for (int y = first_y; y < last_y; ++y)
      for (int x = first_x; x < last_x; ++x) {
        const Eigen::Vector2f p =
            Eigen::Vector2f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) - a;
        const float share = std::clamp(p.dot(along) / squared, 0.0F, 1.0F);
        const float covered = std::clamp(radius + 0.5F - (p - share * along).norm(), 0.0F, 1.0F);
        float& most = shares_[index(x, y)];
        most = std::max(most, covered);
      }
  }

  void lay_over(Image& image, Pixel colour) const {
    for (std::size_t i = 0; i < shares_.size(); ++i)
      if (shares_[i] > 0.0F) image.pixels[i] = blend(image.pixels[i], colour, shares_[i]);
  }

 private:
  static int first(float place) { return std::max(0, static_cast<int>(std::floor(place))); }
  static int last(float place, int end) { return std::min(end, static_cast<int>(place) + 1); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  std::vector<float> shares_;
};

class LinePainter {
 public:
  LinePainter(const Image& image, const TriangleMesh& mesh, const Camera& camera)
      : camera_(camera),
        scene_(mesh, camera.frame),
        width_(static_cast<float>(image.width)),
        height_(static_cast<float>(image.height)) {}

  // The visible pieces of about a pixel each.
  void paint(const std::array<Eigen::Vector3d, 2>& segment, float width, Coverage& coverage) const {
    const Eigen::Vector3f a = camera_.frame(segment[0]), b = camera_.frame(segment[1]);
    const float length = (project(b) - project(a)).norm();
    const int pieces = std::clamp(static_cast<int>(std::ceil(length)), 1, 65536);
    const auto at = [&](float place) -> Eigen::Vector3f {
      return a + place / static_cast<float>(pieces) * (b - a);
    };
    for (int i = 0; i < pieces; ++i) {
      const float place = static_cast<float>(i);
      if (is_visible(at(place + 0.5F)))
        coverage.add(project(at(place)), project(at(place + 1.0F)), width);
    }
  }

 private:
  Eigen::Vector2f project(const Eigen::Vector3f& p) const {
    const Eigen::Vector3f q = p - camera_.eye;
    const float depth = -q.dot(camera_.axes.back);
    return {0.5F * width_ * (1.0F + q.dot(camera_.axes.right) / depth / camera_.tangent_x),
            0.5F * height_ * (1.0F - q.dot(camera_.axes.up) / depth / camera_.tangent_y)};
  }

  bool is_visible(const Eigen::Vector3f& p) const {
    const Eigen::Vector3f towards = (camera_.eye - p).normalized();
    return !scene_.blocked(p + kLift * towards, towards);
  }

  const Camera& camera_;
  RayScene scene_;
  float width_, height_;
};

}  // namespace

void draw_lines(Image& image, const std::vector<Lines>& layers, const TriangleMesh& mesh,
                const Camera& camera) {
  const LinePainter painter(image, mesh, camera);
  for (const Lines& lines : layers) {
    Coverage coverage(image);
    for (const auto& segment : lines.segments) painter.paint(segment, lines.width, coverage);
    coverage.lay_over(image, lines.colour);
  }
}

}  // namespace zerotree::picture
