#include "remesh/relaxation_sweeps.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace zerotree::remesh {
namespace {

// Few enough that most vertices lie inside a part, enough for the cores of a workstation.
constexpr std::size_t kMostParts = 32;
constexpr std::size_t kLeastVerticesPerPart = 1024;
constexpr std::uint8_t kNoPart = 0xff;

}  // namespace

void RelaxationSweeps::run(ConeCharts& charts, int sweeps) {
  order_vertices(charts);
  find_inner_vertices(charts);
  const std::size_t parts = first_inner_.size() - 1;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
      VertexRelaxation relaxation(base_, positions_, kinds_);
      for (std::size_t i = first_inner_[part]; i < first_inner_[part + 1]; ++i)
        relaxation.relax(charts, inner_[i], 1);
    });
    VertexRelaxation relaxation(base_, positions_, kinds_);
    for (std::uint32_t v : border_) relaxation.relax(charts, v, 1);
  }
}

// Sorts the vertices that are not cones by base triangle and index.
void RelaxationSweeps::order_vertices(const ConeCharts& charts) {
  std::vector<std::size_t> end(base_.topology.triangles.size() + 1, 0);
  const auto is_movable = [](const VertexChart& chart) {
    return chart.triangle != kNone && chart.cone == kNone;
  };
  for (const VertexChart& chart : charts.vertices)
    if (is_movable(chart)) ++end[chart.triangle + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  order_.resize(end.back());
  for (std::uint32_t v = 0; v < charts.vertices.size(); ++v)
    if (is_movable(charts.vertices[v])) order_[end[charts.vertices[v].triangle]++] = v;
}

void RelaxationSweeps::find_inner_vertices(const ConeCharts& charts) {
  const std::size_t parts =
      std::clamp(order_.size() / kLeastVerticesPerPart, std::size_t{1}, kMostParts);
  part_.assign(charts.vertices.size(), kNoPart);
  for (std::size_t i = 0; i < order_.size(); ++i)
    part_[order_[i]] = static_cast<std::uint8_t>(i * parts / order_.size());
  inner_.clear();
  border_.clear();
  first_inner_.assign(parts + 1, 0);
  is_inner_.resize(order_.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, order_.size(), kLeastVerticesPerPart),
      [&](const tbb::blocked_range<std::size_t>& range) {
        domain::Star star;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          const std::uint8_t part = part_[order_[i]];
          domain::gather_star(charts.topology, order_[i], star);
          is_inner_[i] = std::ranges::all_of(star.corners, [&](const domain::Corner& at) {
            return std::ranges::all_of(charts.topology.faces[at.face], [&](std::uint32_t w) {
              return part_[w] == part || part_[w] == kNoPart;
            });
          });
        }
      });
  for (std::size_t i = 0; i < order_.size(); ++i) {
    (is_inner_[i] != 0 ? inner_ : border_).push_back(order_[i]);
    if (is_inner_[i] != 0) ++first_inner_[part_[order_[i]] + 1];
  }
  std::partial_sum(first_inner_.begin(), first_inner_.end(), first_inner_.begin());
}

}  // namespace zerotree::remesh
