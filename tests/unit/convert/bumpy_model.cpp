#include "bumpy_model.h"

#include <cmath>

#include "convert/convert.h"
#include "convert/limit_mesh.h"
#include "report/stage_clock.h"
#include "shapes.h"
#include "surface/surface_synthesis.h"

namespace zerotree::test {
namespace {

constexpr int kLevels = 3;
constexpr std::size_t kQuickSamples = 20'000, kExactSamples = 100'000;

convert::AnalysedModel analysed_model() {
  convert::AnalysedModel result{bumpy_model(), {}};
  report::StageClock clock;
  result.wavelets = convert::analyse_model(result.model, {}, clock, {});
  return result;
}

}  // namespace

convert::SurfaceModel bumpy_model() {
  const TriangleMesh base = icosahedron();
  convert::SurfaceModel model;
  model.base.vertex_count = static_cast<std::uint32_t>(base.positions.size());
  model.base.triangles = base.triangles;
  model.hierarchy = std::make_shared<const surface::SubdivisionHierarchy>(
      model.base, kLevels, surface::WaveletTransform::loop_local);
  surface::Positions points;
  for (const Eigen::Vector3d& p : base.positions)
    for (int k = 0; k < 3; ++k) points.push_back(static_cast<float>(p[k]));
  for (int level = 0; level < kLevels; ++level)
    points = surface::subdivide(model.hierarchy->level(level), points);
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const Eigen::Vector3d p(double{points[i]}, double{points[i + 1]}, double{points[i + 2]});
    const double wave = std::sin(5 * p.x()) * std::cos(4 * p.y() + 1) + 0.3 * std::sin(17 * p.z());
    model.control_points.push_back(p * (1 + 0.05 * wave));
  }
  return model;
}

BumpyModel::BumpyModel()
    : analysed(analysed_model()),
      surface(convert::limit_mesh(analysed.model)),
      original(surface, 1),
      how{original,
          {kQuickSamples, 1},
          original.mesh().positions.size(),
          bounding_box_diagonal(original.mesh().positions),
          analysed.model.hierarchy,
          kExactSamples} {}

decode::StreamFile BumpyModel::encode(double step) const {
  return convert::encode_model(analysed.model, analysed.wavelets, step, false);
}

}  // namespace zerotree::test
