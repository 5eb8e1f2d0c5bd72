// The vertices of one level of a semi-regular mesh, bound to the input surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "domain/domain.h"
#include "relax/chart_orientation.h"
#include "relax/subdivided_levels.h"
#include "relax/surface_walk.h"
#include "remesh/remesh.h"

namespace zerotree::relax {

/// Where a vertex may go.
enum class Freedom : std::uint8_t { surface, curve, none };

/// The vertices of a working level. They only move by walks on the input.
class SurfaceVertices {
 public:
  /// Samples the parameterisation at `level` of `levels`. All arguments must outlive this.
  SurfaceVertices(const domain::Domain& domain, const remesh::Parameterisation& laid_out,
                  const std::vector<SubdividedLevel>& levels, int level);

  /// Goes on to the next finer level: new vertices halfway in the parameter domain.
  void refine();

  std::size_t size() const { return points_.size(); }
  int level() const { return level_; }
  const SubdividedLevel& connectivity() const { return levels_[static_cast<std::size_t>(level_)]; }
  const SubdividedLevel& connectivity(int level) const {
    return levels_[static_cast<std::size_t>(level)];
  }
  Freedom freedom(std::size_t v) const { return freedom_[v]; }
  /// How densely vertices are wanted around where this one was when its level began, 1 on the mean.
  float density(std::size_t v) const { return density_[v]; }
  const std::vector<Eigen::Vector3d>& positions() const { return positions_; }
  const std::vector<SurfacePoint>& points() const { return points_; }

  /// Puts a vertex to another point of the surface.
  void put(std::size_t v, const SurfacePoint& point);
  /// Walks by `step`, a vector tangential at unit `normal` (of any direction on curves).
  void walk(std::size_t v, const Eigen::Vector3d& step, const Eigen::Vector3d& normal);
  /// Whether a triangle of vertices is positively oriented in the parameter domain.
  bool is_positive(const Triangle& t) const {
    return chart_.is_positive(charts_[t[0]], charts_[t[1]], charts_[t[2]]);
  }
  /// The same for points of the input, which need not be where vertices are.
  bool is_positive(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c) const {
    return chart_.is_positive(chart_.place_of(a), chart_.place_of(b), chart_.place_of(c));
  }
  std::uint32_t count_negative() const;
  /// The vertices of triangles that are not positive, ascending.
  std::vector<std::uint32_t> find_negative() const;

 private:
  void classify(std::size_t first);
  void find_densities();
  void settle(std::size_t v);
  void bind(std::size_t v);

  InputSurface surface_;
  const domain::Domain& domain_;
  const remesh::Parameterisation& laid_out_;
  const std::vector<SubdividedLevel>& levels_;
  ParameterChart chart_;
  int level_;
  std::vector<SurfacePoint> points_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<ChartPlace> charts_;
  std::vector<Freedom> freedom_;
  std::vector<float> input_density_, density_;
};

/// Turns a tangent vector of one plane into another by the smallest rotation between their unit
/// normals: it keeps its length round bends.
Eigen::Vector3d transported(const Eigen::Vector3d& v, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to);

}  // namespace zerotree::relax
