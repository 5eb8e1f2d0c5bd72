#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "mesh/error.h"
#include "picture/automatic_view.h"
#include "picture/mesh_picture.h"
#include "shapes.h"

namespace zerotree::picture {
namespace {

RenderOptions small_picture() {
  RenderOptions options;
  options.width = options.height = 64;
  options.view_direction = {0, 0, 1};
  options.up = {0, 1, 0};
  options.margin = 0.1;
  options.ground_shadow = false;
  options.supersampling = 2;
  options.threads = 1;
  return options;
}

Image draw(const TriangleMesh& mesh, const RenderOptions& options) {
  return render(Model{&mesh}, choose_camera(mesh, options), options);
}

TEST(MeshPicture, ASphereFillsItsCircleUpToTheMargin) {
  const Image image = draw(test::sphere(4), small_picture());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double radius = std::hypot(x + 0.5 - 32.0, y + 0.5 - 32.0);
      if (radius < 24.0) {
        EXPECT_EQ(image.at(x, y)[3], 255) << x << " " << y;
      } else if (radius > 27.0) {
        EXPECT_EQ(image.at(x, y)[3], 0) << x << " " << y;
      }
    }
}

TEST(MeshPicture, IsLitFromAboveOnTheLeftAndSmooth) {
  RenderOptions options = small_picture();
  options.supersampling = 4;
  const Image image = draw(test::sphere(5), options);
  EXPECT_GT(image.at(22, 22)[0], image.at(42, 44)[0] + 40);
  // No acne: neighbours on the lit side differ little.
  for (int x = 20; x < 32; ++x)
    EXPECT_LT(std::abs(image.at(x, 24)[0] - image.at(x + 1, 24)[0]), 14) << x;
}

TEST(MeshPicture, DrawsTheColoursItIsGiven) {
  const TriangleMesh mesh = test::sphere(2);
  Model model{&mesh};
  model.colours.assign(mesh.positions.size(), {0.8F, 0.1F, 0.1F});
  const RenderOptions options = small_picture();
  const Pixel centre = render(model, choose_camera(mesh, options), options).at(28, 28);
  EXPECT_GT(centre[0], centre[1] + 60);
  model.colours.pop_back();
  EXPECT_THROW(render(model, choose_camera(mesh, options), options), Error);
}

TEST(MeshPicture, DoesNotDependOnThreads) {
  const TriangleMesh mesh = test::add_bumps(test::sphere(3), 0.05, 3.0);
  RenderOptions options = small_picture();
  options.ground_shadow = true;
  const Image once = draw(mesh, options);
  options.threads = 2;
  EXPECT_EQ(once.pixels, draw(mesh, options).pixels);
}

TEST(MeshPicture, RefusesWhatCannotBeDrawn) {
  const RenderOptions options = small_picture();
  EXPECT_THROW(draw(TriangleMesh{}, options), Error);
  TriangleMesh broken = test::tetrahedron();
  broken.triangles[0][0] = 9;
  EXPECT_THROW(draw(broken, options), Error);
  RenderOptions empty = options;
  empty.width = 0;
  EXPECT_THROW(render(test::tetrahedron(), empty), Error);
}

TEST(MeshPicture, FindsTheFootAModelStandsOn) {
  TriangleMesh cone{{{0, 0, 5}}, {}};  // tip up along z, open below
  for (int i = 0; i < 16; ++i)
    cone.positions.push_back({std::cos(i * 0.3927), std::sin(i * 0.3927), 0});
  for (std::uint32_t i = 0; i < 16; ++i) cone.triangles.push_back({0, 1 + i, 1 + (i + 1) % 16});
  EXPECT_EQ(automatic_up(cone), Eigen::Vector3d::UnitZ());
  for (Eigen::Vector3d& p : cone.positions) p.z() = -p.z();
  EXPECT_EQ(automatic_up(cone), -Eigen::Vector3d::UnitZ());
  EXPECT_EQ(automatic_up(test::sphere(2)), Eigen::Vector3d::UnitY());
}

}  // namespace
}  // namespace zerotree::picture
