#include "remesh/collapse_undoing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace zerotree::remesh {
namespace {

// Few enough that most collapses lie inside a part, enough for the cores of a workstation.
constexpr std::size_t kParts = 32;
// Below so many collapses the parts are too small for that.
constexpr std::size_t kLeastInParallel = 4096;
// Newton steps for the neighbours of a vertex that has little room.
constexpr int kStepsOfSqueezed = 3;

// Whether all vertices that the undo reads or writes, those of the faces at `kept` that it changes,
// are `inside`. Looks at no face without a vertex inside.
template <typename Inside>
bool is_inner(const domain::TriangleTopology& topology, const domain::CollapseRecord& collapse,
              const Inside& inside, std::vector<std::uint32_t>& fan) {
  if (!inside(collapse.removed) || !inside(collapse.kept)) return false;
  const auto is_face_inside = [&](std::uint32_t face) {
    return std::ranges::all_of(topology.faces[face], inside);
  };
  domain::find_collapsed_fan(topology, collapse, fan);
  if (!std::ranges::all_of(fan, is_face_inside)) return false;
  // The faces beyond the gaps, whose neighbours change.
  const auto is_beyond_inside = [&](std::uint32_t inner, bool is_left) {
    const int k = domain::corner_of(topology.faces[inner], collapse.kept);
    const std::uint32_t beyond = topology.adjacent[inner][is_left ? k : kPrev[k]];
    return beyond == kNone || is_face_inside(beyond);
  };
  return is_beyond_inside(fan.front(), true) && is_beyond_inside(fan.back(), false);
}

}  // namespace

bool CollapseUndoing::undo(ConeCharts& charts, std::span<const domain::CollapseRecord> collapses) {
  for (std::size_t i = collapses.size(); i-- > 0;) {
    if (undo_one(charts, collapses[i])) continue;
    stuck_ = i;
    return false;
  }
  return true;
}

bool CollapseUndoing::undo_independent(ConeCharts& charts,
                                       std::span<const domain::CollapseRecord> collapses) {
  if (collapses.size() < kLeastInParallel) return undo(charts, collapses);
  std::array<Rest, kParts> rests;
  tbb::parallel_for(std::size_t{0}, kParts,
                    [&](std::size_t part) { undo_part(charts, collapses, part, rests[part]); });
  return finish(charts, collapses, rests);
}

void CollapseUndoing::undo_part(ConeCharts& charts,
                                std::span<const domain::CollapseRecord> collapses, std::size_t part,
                                Rest& rest) const {
  VertexInsertion insertion(base_, positions_, kinds_);
  std::vector<std::uint32_t> fan;
  const auto part_of_collapse = [&](const domain::CollapseRecord& collapse) {
    return part_of(collapse.removed);
  };
  const auto own = std::ranges::equal_range(collapses, part, {}, part_of_collapse);
  const auto first = static_cast<std::size_t>(own.begin() - collapses.begin());
  for (std::size_t i = first + own.size(); i-- > first;) {
    const bool is_own = is_inner(
        charts.topology, collapses[i], [&](std::uint32_t v) { return part_of(v) == part; }, fan);
    if (!is_own)
      rest.at_border.push_back(i);
    else if (!insertion.insert(charts, collapses[i]))
      rest.homeless.push_back(i);
    else if (insertion.is_squeezed())
      rest.squeezed.push_back(i);
  }
}

// All the homeless first: the faces of their gaps have no charts yet, so nothing around may move.
bool CollapseUndoing::finish(ConeCharts& charts, std::span<const domain::CollapseRecord> collapses,
                             std::span<Rest> rests) {
  for (Rest& rest : rests)
    for (std::size_t i : rest.homeless) {
      stuck_ = i;
      if (!insertion_.swap_in(charts, collapses[i])) return false;
      if (insertion_.is_squeezed()) rest.squeezed.push_back(i);
    }
  for (const Rest& rest : rests)
    for (std::size_t i : rest.squeezed) {
      domain::gather_star(charts.topology, collapses[i].removed, star_);
      relax_ring(charts, star_);
    }
  for (const Rest& rest : rests)
    for (std::size_t i : rest.at_border) {
      stuck_ = i;
      if (!undo_one(charts, collapses[i])) return false;
    }
  return true;
}

bool CollapseUndoing::undo_one(ConeCharts& charts, const domain::CollapseRecord& collapse) {
  if (!insertion_.insert(charts, collapse) && !insertion_.swap_in(charts, collapse)) return false;
  if (insertion_.is_squeezed()) {
    star_ = insertion_.star();
    relax_ring(charts, star_);
  }
  return true;
}

// Gives the vertices around a squeezed one more room.
void CollapseUndoing::relax_ring(ConeCharts& charts, const domain::Star& star) {
  for (const auto& [face, corner] : star.corners)
    relaxation_.relax(charts, charts.topology.faces[face][kNext[corner]], kStepsOfSqueezed);
  const auto& [face, corner] = star.corners.front();
  relaxation_.relax(charts, charts.topology.faces[face][corner], kStepsOfSqueezed);
}

std::size_t CollapseUndoing::part_of(std::uint32_t vertex) const {
  return vertex * kParts / kinds_.size();
}

}  // namespace zerotree::remesh
