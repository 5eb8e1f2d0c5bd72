#include "surface/subdivision_hierarchy.h"

#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <memory>
#include <stdexcept>
#include <utility>

#include "bitstream/base_edges.h"
#include "surface/limit_stencils.h"
#include "surface/loop_refiner.h"
#include "surface/quadrature_mirror_filter.h"

namespace zerotree::surface {

namespace Far = OpenSubdiv::Far;

namespace {

// The class templates themselves: the plain names' factory downcasts to a type that the object is
// not, which sanitizers refuse.
using StencilTable = Far::StencilTableReal<float>;
using StencilTableFactory = Far::StencilTableFactoryReal<float>;

void add_detail_filter(const RefinerLevel& refined, WaveletTransform transform,
                       SubdivisionLevel& level) {
  switch (transform) {
    case WaveletTransform::loop_quadrature_mirror:
      level.details = quadrature_mirror_stencils(refined);
      return;
    case WaveletTransform::loop_local:
      level.local_details = local_filter(refined, level.edges);
      return;
  }
}

std::unique_ptr<const StencilTable> subdivision_table(const Refiner& refiner) {
  StencilTableFactory::Options options;
  options.interpolationMode = StencilTableFactory::INTERPOLATE_VERTEX;
  options.generateOffsets = true;
  options.generateIntermediateLevels = true;
  // Each level's stencils refer to the level before it, whose details come in between.
  options.factorizeIntermediateLevels = false;
  return std::unique_ptr<const StencilTable>(StencilTableFactory::Create(refiner, options));
}

/// The rows `first_row` .. of the table that make `row_count` vertices of one level.
SubdivisionStencils slice(const StencilTable& table, std::size_t first_row, std::size_t row_count) {
  const auto first = static_cast<std::ptrdiff_t>(first_row);
  const auto last = static_cast<std::ptrdiff_t>(first_row + row_count);
  SubdivisionStencils rows;
  rows.sizes.assign(table.GetSizes().begin() + first, table.GetSizes().begin() + last);
  rows.offsets.assign(table.GetOffsets().begin() + first, table.GetOffsets().begin() + last);
  const int begin = rows.offsets.front();
  const int end = rows.offsets.back() + rows.sizes.back();
  for (int& offset : rows.offsets) offset -= begin;
  const auto& indices = table.GetControlIndices();
  const auto& weights = table.GetWeights();
  rows.indices.assign(indices.begin() + begin, indices.begin() + end);
  rows.weights.assign(weights.begin() + begin, weights.begin() + end);
  return rows;
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const RefinerLevel& level) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(static_cast<std::size_t>(level.GetNumFaces()));
  for (int face = 0; face < level.GetNumFaces(); ++face) {
    const auto corners = level.GetFaceVertices(face);
    triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                         static_cast<std::uint32_t>(corners[1]),
                         static_cast<std::uint32_t>(corners[2])});
  }
  return triangles;
}

}  // namespace

SubdivisionHierarchy::SubdivisionHierarchy(const bitstream::BaseTopology& base, int levels,
                                           WaveletTransform transform)
    : base_(base), transform_(transform) {
  bitstream::BaseEdges numbered = bitstream::number_base_edges(base);
  if (!numbered.error.empty()) throw std::invalid_argument(numbered.error);
  base_edges_ = std::move(numbered.edges);
  const std::unique_ptr<Refiner> refiner = make_loop_refiner(base, base_edges_, levels);
  levels_.resize(static_cast<std::size_t>(levels) + 1);
  for (int number = 0; number <= levels; ++number) {
    const RefinerLevel& refined = refiner->GetLevel(number);
    SubdivisionLevel& level = levels_[static_cast<std::size_t>(number)];
    level.vertex_count = static_cast<std::uint32_t>(refined.GetNumVertices());
    level.edge_count = static_cast<std::uint32_t>(refined.GetNumEdges());
    level.triangles = triangles_of(refined);
    level.limit = limit_stencils(refined);
    if (number == levels) break;
    level.edges = number == 0 ? base_edge_level(refined, base_edges_)
                              : child_edge_level(
                                    refiner->GetLevel(number - 1),
                                    levels_[static_cast<std::size_t>(number) - 1].edges, refined);
    add_detail_filter(refined, transform, level);
  }
  if (levels == 0) return;
  const auto table = subdivision_table(*refiner);
  std::size_t first_row = 0;
  for (int number = 0; number < levels; ++number) {
    const std::size_t rows = levels_[static_cast<std::size_t>(number) + 1].vertex_count;
    levels_[static_cast<std::size_t>(number)].subdivision = slice(*table, first_row, rows);
    first_row += rows;
  }
}

}  // namespace zerotree::surface
