#include "surface/shared_stencils.h"

#include <algorithm>

namespace zerotree::surface {

void SharedStencilBuilder::reserve(std::size_t rows, std::size_t indices_per_row) {
  stencils_.row_begin.reserve(rows + 1);
  stencils_.mask_of_row.reserve(rows);
  stencils_.indices.reserve(rows * indices_per_row);
}

void SharedStencilBuilder::add_row(std::span<const std::uint32_t> indices,
                                   std::span<const float> weights) {
  stencils_.mask_of_row.push_back(mask_for(weights));
  stencils_.indices.insert(stencils_.indices.end(), indices.begin(), indices.end());
  stencils_.row_begin.push_back(static_cast<std::uint32_t>(stencils_.indices.size()));
}

std::uint32_t SharedStencilBuilder::mask_for(std::span<const float> weights) {
  // Neighbouring rows mostly have the regular mask.
  if (!last_.empty() && std::equal(weights.begin(), weights.end(), last_.begin(), last_.end()))
    return last_mask_;
  last_.assign(weights.begin(), weights.end());
  const auto next = static_cast<std::uint32_t>(stencils_.mask_begin.size() - 1);
  const auto [place, is_new] = masks_.try_emplace(last_, next);
  if (is_new) {
    stencils_.weights.insert(stencils_.weights.end(), weights.begin(), weights.end());
    stencils_.mask_begin.push_back(static_cast<std::uint32_t>(stencils_.weights.size()));
  }
  last_mask_ = place->second;
  return last_mask_;
}

}  // namespace zerotree::surface
