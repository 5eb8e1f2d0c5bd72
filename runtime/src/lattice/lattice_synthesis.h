// From base control points and details to the surface, level by level, on lattices (paper, equation
// 1 and section 3.3): the fast way of what surface_synthesis.h does with mesh-wide stencils.
//
// A level is made in passes, each of which is a number of independent units: those of a pass may
// run at the same time, the passes run one after the other. First everything is subdivided: along
// base edges (strips), at base vertices (corners), inside triangles (groups). If the level has
// details, they then move their odd vertices; what they move lifts even vertices, summed inside
// triangles, then along strips, then at corners; and P of the lifts is taken off everything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "lattice/lattice_mesh.h"
#include "lattice/lattice_points.h"
#include "lattice/level_details.h"
#include "surface/limit_output.h"

namespace zerotree::surface {

enum class SynthesisPass : std::uint8_t {
  subdivide_strips,
  subdivide_corners,
  subdivide_groups,
  // only where the level has details:
  move_strips,
  move_groups,
  lift_strips,
  lift_corners,
  finish_strips,
  finish_corners,
  finish_groups,
  // limit positions and normals of the level itself:
  limit_strips,
  limit_corners,
  limit_groups,
};

/// Control points of levels 0 .. `levels()`, kept. Not thread safe but for units of one pass.
class LatticeSynthesis {
 public:
  /// The mesh outlives this.
  LatticeSynthesis(const LatticeMesh& mesh, std::pmr::memory_resource* memory);

  /// Takes memory for levels up to `level`, which the mesh knows, and for `workers` units at the
  /// same time: nothing is allocated while passes run. Unless it throws, what a level that is being
  /// made had in memory beside the points is lost.
  void reserve(int level, std::size_t workers);
  int levels() const { return static_cast<int>(points_.size()) - 1; }

  /// Puts the base vertices' x, y, z into level 0.
  void set_base(std::span<const float> positions);
  /// The details of the passes that follow, from `level` to the next.
  void set_details(const LevelDetails& details, double mean_area);

  /// Units of a pass: from `level` to the next, or of `level` for the limit passes.
  std::size_t unit_count(SynthesisPass pass) const;
  void run(SynthesisPass pass, int level, std::size_t unit, std::size_t worker,
           const LimitOutput& output);

  const LatticePoints& points(int level) const { return points_[static_cast<std::size_t>(level)]; }

 private:
  struct Scratch {
    explicit Scratch(std::pmr::memory_resource* memory) : moves(memory), rows(memory) {}
    std::pmr::vector<LanePoint> moves;
    std::pmr::vector<float> rows;
  };

  LatticePoints& points_at(int level) { return points_[static_cast<std::size_t>(level)]; }
  std::span<PointF> strip_moves(int level, std::size_t strip);
  LanePoint strip_detail(int level, std::size_t strip, std::size_t i, std::size_t lanes) const;
  PointF child_at_corner(const BaseFans::View& fan, const LatticeLevel& level,
                         const LatticePoints& points) const;
  PointF spoke_point(const BaseSpoke& spoke, const LatticeLevel& level,
                     const LatticePoints& points) const;
  void set_corner(const BaseFans::View& fan, const PointF& value, LatticePoints& points) const;

  void subdivide_strip(int level, std::size_t strip, Scratch& scratch);
  void subdivide_corner(int level, std::size_t vertex);
  void move_strip(int level, std::size_t strip, Scratch& scratch);
  void move_group(int level, std::size_t group, Scratch& scratch);
  void lift_strip(int level, std::size_t strip);
  void lift_corner(int level, std::size_t vertex);
  void finish_strip(int level, std::size_t strip, Scratch& scratch);
  void finish_corner(int level, std::size_t vertex);
  void limit_strip(int level, std::size_t strip, Scratch& scratch, const LimitOutput& output);
  void limit_corner(int level, std::size_t vertex, const LimitOutput& output);

  const LatticeMesh& mesh_;
  std::pmr::memory_resource* memory_;
  std::vector<LatticePoints> points_;
  LatticePoints lifts_;
  std::pmr::vector<PointF> strip_moves_;
  std::vector<Scratch> scratch_;
  LevelDetails details_;
  double mean_area_ = 0.0;
};

}  // namespace zerotree::surface
