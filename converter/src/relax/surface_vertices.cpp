#include "relax/surface_vertices.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/error.h"
#include "relax/parallel_loop.h"
#include "relax/surface_roughness.h"
#include "remesh/lattice_numbering.h"
#include "remesh/lattice_sampling.h"

namespace zerotree::relax {
namespace {

// Roughness beyond these makes no more difference, so that no region starves.
constexpr float kLeastRoughness = 0.4f;
constexpr float kMostRoughness = 4.0f;

// Flat triangles follow a surface of curvature k best with a density of k^(2/3); the square root
// leaves the parameterisation smoother.
std::vector<float> wanted_densities(const InputSurface& input) {
  std::vector<float> densities = relative_roughness(input);
  for (float& density : densities)
    density = std::sqrt(std::clamp(density, kLeastRoughness, kMostRoughness));
  return densities;
}

}  // namespace

Eigen::Vector3d transported(const Eigen::Vector3d& v, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to) {
  const double cosine = from.dot(to);
  if (cosine < -0.9) return Eigen::Vector3d::Zero();  // the rotation is not defined
  const Eigen::Vector3d axis = from.cross(to);
  return cosine * v + axis.cross(v) + axis * (axis.dot(v) / (1 + cosine));
}

SurfaceVertices::SurfaceVertices(const domain::Domain& domain,
                                 const remesh::Parameterisation& laid_out,
                                 const std::vector<SubdividedLevel>& levels, int level)
    : surface_{domain.mesh, laid_out.charts.topology},
      domain_(domain),
      laid_out_(laid_out),
      levels_(levels),
      chart_(laid_out.base, laid_out.charts),
      level_(level),
      input_density_(wanted_densities(surface_)) {
  const remesh::LatticeNumbering numbering = remesh::number_lattices(laid_out.base.topology, level);
  const remesh::LatticeSamples samples =
      remesh::sample_lattice(laid_out.charts, laid_out.base, numbering);
  if (samples.missing > 0)
    throw Error(ExitCode::internal, std::to_string(samples.missing) +
                                        " vertices of the new mesh have no place on the input");
  points_.resize(numbering.vertex_count);
  for (std::size_t v = 0; v < points_.size(); ++v)
    points_[v] = {samples.faces[v], -1, samples.weights[v]};
  classify(0);
  for_each_index(points_.size(), [&](std::size_t v) { settle(v); });
  find_densities();
}

void SurfaceVertices::refine() {
  const SubdividedLevel& coarse = connectivity();
  const std::size_t first = points_.size();
  points_.resize(first + coarse.edges.size());
  ++level_;
  classify(first);
  for_each_index(coarse.edges.size(), [&](std::size_t e) {
    const auto [a, b] = coarse.edges[e];
    const std::size_t v = first + e;
    if (const auto middle = chart_.midpoint(points_[a], points_[b]))
      points_[v] = *middle;
    else
      points_[v] = walk_on_surface(surface_, points_[a], (positions_[b] - positions_[a]) / 2);
    settle(v);
  });
  find_densities();
}

void SurfaceVertices::find_densities() {
  density_.resize(points_.size());
  for_each_index(points_.size(), [&](std::size_t v) {
    const Triangle& t = surface_.topology.faces[points_[v].face];
    const Eigen::Vector3f weights = points_[v].weights.cast<float>();
    density_[v] = weights[0] * input_density_[t[0]] + weights[1] * input_density_[t[1]] +
                  weights[2] * input_density_[t[2]];
  });
}

// What the vertices from `first` on may do.
void SurfaceVertices::classify(std::size_t first) {
  freedom_.resize(points_.size(), Freedom::surface);
  positions_.resize(points_.size());
  charts_.resize(points_.size());
  if (first == 0) {
    const std::vector<std::uint32_t>& mesh_vertex = laid_out_.base.mesh_vertex;
    for (std::size_t v = 0; v < mesh_vertex.size(); ++v) {
      const domain::VertexKind kind = domain_.kinds[mesh_vertex[v]];
      freedom_[v] = kind == domain::VertexKind::smooth  ? Freedom::surface
                    : kind == domain::VertexKind::chain ? Freedom::curve
                                                        : Freedom::none;
    }
    for (std::uint32_t v : laid_out_.base.topology.corner_vertices) freedom_[v] = Freedom::none;
  }
  for (int l = 0; l < level_; ++l) {
    const SubdividedLevel& level = connectivity(l);
    if (level.vertex_count + level.edges.size() <= first) continue;
    for (std::size_t e = 0; e < level.edges.size(); ++e)
      if (level.is_feature[e]) freedom_[level.vertex_count + e] = Freedom::curve;
  }
}

// Binds a new vertex, to its curve if it has one.
void SurfaceVertices::settle(std::size_t v) {
  points_[v].edge = -1;
  if (freedom_[v] == Freedom::curve && !snap_to_feature(surface_, points_[v]))
    freedom_[v] = Freedom::none;
  bind(v);
}

void SurfaceVertices::bind(std::size_t v) {
  positions_[v] = surface_.position(points_[v]);
  charts_[v] = chart_.place_of(points_[v]);
}

void SurfaceVertices::put(std::size_t v, const SurfacePoint& point) {
  points_[v] = point;
  bind(v);
}

void SurfaceVertices::walk(std::size_t v, const Eigen::Vector3d& step,
                           const Eigen::Vector3d& normal) {
  if (freedom_[v] == Freedom::none || step.isZero(0)) return;
  if (freedom_[v] == Freedom::curve) {
    points_[v] = walk_along_feature(surface_, domain_.kinds, points_[v], step);
  } else {
    const Eigen::Vector3d plane = unit(surface_.face_normal(points_[v].face));
    points_[v] = walk_on_surface(surface_, points_[v], transported(step, normal, plane));
  }
  bind(v);
}

std::vector<std::uint32_t> SurfaceVertices::find_negative() const {
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : connectivity().triangles)
    if (!is_positive(t)) corners.insert(corners.end(), t.begin(), t.end());
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::uint32_t SurfaceVertices::count_negative() const {
  std::uint32_t count = 0;
  for (const Triangle& t : connectivity().triangles) count += is_positive(t) ? 0u : 1u;
  return count;
}

}  // namespace zerotree::relax
