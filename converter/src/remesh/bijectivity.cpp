#include "remesh/bijectivity.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace zerotree::remesh {
namespace {

// Of the faces, added up each for itself: the sum is then the same for any number of threads.
constexpr std::size_t kParts = 16;

using Polygon = std::vector<LatticePoint>;

// The heights over the three edges of the unit base triangle.
double height_over(int edge, const LatticePoint& p) {
  return edge == 0 ? p.y() : edge == 1 ? 1 - p.x() - p.y() : p.x();
}

void clip(const Polygon& polygon, int edge, Polygon& inside) {
  inside.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const LatticePoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = height_over(edge, p), at_q = height_over(edge, q);
    if (at_p >= 0) inside.push_back(p);
    if ((at_p < 0) != (at_q < 0)) inside.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
}

double area_of(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += lattice_area(polygon[0], polygon[i], polygon[i + 1]);
  return sum;
}

// A base triangle that a face touches, seen in the face's unfolded plane.
struct Cell {
  std::uint32_t triangle;
  LatticeIsometry map;  // from the face's chart
};

// Adds the face's area in each base triangle to `covered`, spreading over base edges it crosses.
class Coverage {
 public:
  Coverage(const BaseDomain& base) : base_(base), covered(base.topology.triangles.size(), 0.0) {}

  void add(const FaceAnchor& anchor, const std::array<LatticePoint, 3>& face) {
    // The anchor may be a corner that touches its base triangle only: begin inside the face.
    const LatticePoint centroid = apply(anchor.map, (face[0] + face[1] + face[2]) / 3);
    const BasePlace place = walk(base_, anchor.triangle, anchor.point, centroid);
    cells_.assign(1, {place.triangle, compose(place.map, anchor.map)});
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Cell cell = cells_[i];
      polygon_.clear();
      for (const LatticePoint& p : face) polygon_.push_back(apply(cell.map, p));
      for (int edge = 0; edge < 3; ++edge) spread(cell, edge);
      for (int edge = 0; edge < 3 && !polygon_.empty(); ++edge) {
        clip(polygon_, edge, clipped_);
        polygon_.swap(clipped_);
      }
      covered[cell.triangle] += area_of(polygon_);
    }
  }

 private:
  // Goes on to the neighbour if part of the face lies beyond the edge itself, between its ends.
  void spread(const Cell& cell, int edge) {
    const std::uint32_t next = base_.adjacent[cell.triangle][edge];
    if (next == kNone) return;
    double low = 2, high = -1;  // the part of the edge that the face covers
    const LatticeIsometry along = inverse(corner_chart(edge));
    bool beyond = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const LatticePoint p = apply(along, polygon_[i]), q = apply(along, polygon_[(i + 1) % 3]);
      beyond = beyond || p.y() < 0;
      if ((p.y() < 0) == (q.y() < 0)) continue;
      const double x = p.x() + (q.x() - p.x()) * (p.y() / (p.y() - q.y()));
      low = std::min(low, x);
      high = std::max(high, x);
    }
    if (!beyond || std::min(high, 1.0) <= std::max(low, 0.0)) return;
    const LatticeIsometry map = compose(base_.transitions[cell.triangle][edge], cell.map);
    const bool seen = std::ranges::any_of(
        cells_, [&](const Cell& c) { return c.triangle == next && c.map == map; });
    if (!seen) cells_.push_back({next, map});
  }

  const BaseDomain& base_;
  std::vector<Cell> cells_;
  Polygon polygon_, clipped_;

 public:
  std::vector<double> covered;
};

}  // namespace

BijectivityReport check_bijectivity(const ConeCharts& charts, const BaseDomain& base) {
  const std::size_t faces = charts.topology.faces.size();
  std::vector<Coverage> parts(kParts, Coverage(base));
  std::array<std::uint32_t, kParts> flipped{};
  tbb::parallel_for(std::size_t{0}, kParts, [&](std::size_t part) {
    for (std::size_t i = part * faces / kParts; i < (part + 1) * faces / kParts; ++i) {
      const auto f = static_cast<std::uint32_t>(i);
      const std::array<LatticePoint, 3> face{charts.corner_point(f, 0), charts.corner_point(f, 1),
                                             charts.corner_point(f, 2)};
      if (lattice_area(face[0], face[1], face[2]) > 0)
        parts[part].add(anchor_of(charts, base, f), face);
      else
        ++flipped[part];
    }
  });
  BijectivityReport report;
  report.flipped_faces = std::accumulate(flipped.begin(), flipped.end(), 0u);
  for (std::size_t t = 0; t < base.topology.triangles.size(); ++t) {
    double covered = 0;
    for (const Coverage& part : parts) covered += part.covered[t];
    report.worst_coverage = std::max(report.worst_coverage, std::abs(covered - 1));
  }
  return report;
}

}  // namespace zerotree::remesh
